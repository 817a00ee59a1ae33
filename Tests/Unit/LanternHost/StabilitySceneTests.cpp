// The scenes of `lantern stability` for methods to come have what their cases need: counted, measured, and looked into
// with rays on the CPU.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include "LanternHost/BuiltinScenes.h"
#include "LanternHost/SceneLoader.h"

namespace Lantern
{
namespace
{

FSceneDescription Build(const std::string& Name)
{
	FLoadResult Result = LoadScene(Name);
	EXPECT_TRUE(Result.Scene) << Result.Error;
	FSceneDescription Scene = Result.Scene ? std::move(*Result.Scene) : FSceneDescription();
	EXPECT_EQ(ValidateScene(Scene), "") << Name;
	return Scene;
}

constexpr double Nothing = 1e30;

/// All triangles of one moment, in the world.
class FTriangles
{
public:
	explicit FTriangles(const FSceneDescription& Scene, double Time = 0.0)
	{
		const FScenePose Pose = EvaluatePose(Scene, Time);
		for (size_t Node = 0; Node < Scene.Nodes.size(); ++Node)
		{
			if (Scene.Nodes[Node].Mesh < 0) { continue; }
			const FHostMesh& Mesh = Scene.Meshes[size_t(Scene.Nodes[Node].Mesh)];
			for (const uint32_t Index : Mesh.Indices)
			{
				Corners.emplace_back(Pose.World[Node] * glm::dvec4(glm::dvec3(Mesh.Positions[Index]), 1));
			}
		}
	}

	/// Distance to what is hit first from either side; Nothing where nothing is. Möller and Trumbore 1997.
	double Trace(const glm::dvec3& Origin, const glm::dvec3& Direction) const
	{
		double Nearest = Nothing;
		for (size_t I = 0; I < Corners.size(); I += 3)
		{
			const glm::dvec3 E1 = Corners[I + 1] - Corners[I], E2 = Corners[I + 2] - Corners[I];
			const glm::dvec3 P = glm::cross(Direction, E2), T = Origin - Corners[I], Q = glm::cross(T, E1);
			const double Inverse = 1.0 / glm::dot(E1, P);
			const double U = glm::dot(T, P) * Inverse, V = glm::dot(Direction, Q) * Inverse;
			const double Distance = glm::dot(E2, Q) * Inverse;
			// A little larger than they are: no ray slips through between two.
			if (U >= -1e-9 && V >= -1e-9 && U + V <= 1 + 1e-9 && Distance > 1e-6) { Nearest = std::min(Nearest, Distance); }
		}
		return Nearest;
	}

	/// Where Count rays in all directions end (Fibonacci's spiral); very far away where nothing is.
	std::vector<glm::dvec3> LookAround(const glm::dvec3& Origin, int Count) const
	{
		std::vector<glm::dvec3> Points;
		for (int I = 0; I < Count; ++I)
		{
			const double Y = 1.0 - 2.0 * (I + 0.5) / Count, Angle = 2.39996322972865 * I, R = std::sqrt(1.0 - Y * Y);
			const glm::dvec3 Direction(R * std::cos(Angle), Y, R * std::sin(Angle));
			Points.push_back(Origin + Trace(Origin, Direction) * Direction);
		}
		return Points;
	}

	double FindFarthest(const glm::dvec3& Origin, int Count) const
	{
		double Farthest = 0.0;
		for (const glm::dvec3& Point : LookAround(Origin, Count)) { Farthest = std::max(Farthest, glm::length(Point - Origin)); }
		return Farthest;
	}

	bool IsInSun(const FSceneDescription& Scene, const glm::dvec3& Point) const
	{
		return Trace(Point, -glm::normalize(glm::dvec3(*Scene.DefaultSun))) == Nothing;
	}

private:
	std::vector<glm::dvec3> Corners;
};

struct FCameraPose
{
	glm::dvec3 Position, Right, Up, Forward;
	double TanHalf = 0.0;
};

FCameraPose GetCamera(const FSceneDescription& Scene, double Time = 0.0)
{
	const FScenePose Pose = EvaluatePose(Scene, Time);
	for (size_t Node = 0; Node < Scene.Nodes.size(); ++Node)
	{
		if (Scene.Nodes[Node].Camera >= 0)
		{
			const glm::dmat4& World = Pose.World[Node];
			return {glm::dvec3(World[3]), glm::dvec3(World[0]), glm::dvec3(World[1]), -glm::dvec3(World[2]),
			    std::tan(0.5 * double(Scene.Cameras[size_t(Scene.Nodes[Node].Camera)].FovY))};
		}
	}
	ADD_FAILURE() << "no camera";
	return {};
}

int32_t FindNode(const FSceneDescription& Scene, std::string_view Name)
{
	for (size_t Node = 0; Node < Scene.Nodes.size(); ++Node)
	{
		if (Scene.Nodes[Node].Name == Name) { return int32_t(Node); }
	}
	ADD_FAILURE() << "no node " << Name;
	return 0;
}

const FHostMesh& GetMesh(const FSceneDescription& Scene, std::string_view Node)
{
	return Scene.Meshes[size_t(Scene.Nodes[size_t(FindNode(Scene, Node))].Mesh)];
}

glm::dvec3 GetPlace(const FSceneDescription& Scene, std::string_view Node, double Time)
{
	return glm::dvec3(EvaluatePose(Scene, Time).World[size_t(FindNode(Scene, Node))][3]);
}

bool IsDark(const FSceneDescription& Scene) { return Scene.DefaultSun->w == 0.0f && *Scene.DefaultSky == glm::vec3(0); }

/// A sealed room around the camera that has no light but its lamps, all of which are inside.
void ExpectSealed(const FSceneDescription& Scene, double Size)
{
	const FTriangles Triangles(Scene);
	EXPECT_LT(Triangles.FindFarthest(GetCamera(Scene).Position, 2000), Size);
	EXPECT_TRUE(IsDark(Scene));
	glm::dvec3 Min, Max;
	const FScenePose Pose = EvaluatePose(Scene, 0);
	ASSERT_TRUE(GetSceneBounds(Scene, Pose, Min, Max));
	for (size_t Node = 0; Node < Scene.Nodes.size(); ++Node)
	{
		const glm::dvec3 At(Pose.World[Node][3]);
		const bool bInside = glm::all(glm::greaterThan(At, Min + 0.2)) && glm::all(glm::lessThan(At, Max - 0.2));
		EXPECT_TRUE(Scene.Nodes[Node].Light < 0 || bInside);
	}
}

TEST(StabilityScenes, EdgeShowsBothSidesFromEveryDistance)
{
	for (const char* Name : {"stability-edge:0.5", "stability-edge", "stability-edge:60"})
	{
		const FSceneDescription Scene = Build(Name);
		const FTriangles Triangles(Scene);
		const FCameraPose Camera = GetCamera(Scene);
		// Just before the front, and just below the underside.
		const glm::dvec3 Front(0.05, 0.02, 1e-4), Under(0.05, -1e-4, -0.02);
		for (const glm::dvec3& Point : {Front, Under})
		{
			const glm::dvec3 Way = Point - Camera.Position;
			EXPECT_GT(Triangles.Trace(Camera.Position, glm::normalize(Way)), glm::length(Way)) << Name << ": hidden";
		}
		EXPECT_TRUE(Triangles.IsInSun(Scene, Front));
		EXPECT_FALSE(Triangles.IsInSun(Scene, Under));
		EXPECT_LT(glm::length(glm::normalize(Camera.Position) - glm::normalize(glm::dvec3(0.15, -0.27, 1))), 1e-6);
	}
	EXPECT_NEAR(glm::length(GetCamera(Build("stability-edge:60")).Position), 60.0, 1e-4);
}

TEST(StabilityScenes, LampsSwitchAndFlicker)
{
	const FSceneDescription Switch = Build("stability-switch");
	ExpectSealed(Switch, 10.0);
	ASSERT_EQ(Switch.Lights.size(), 1u);
	for (const auto& [Time, bOn] : {std::pair(0.0, true), {1.999, true}, {2.0, false}, {3.999, false}, {4.0, true}, {-0.5, false}})
	{
		EXPECT_EQ(IsLightOn(Switch.Lights[0], Time), bOn) << Time;
	}
	// The lamp is hidden from the far half by the partition.
	const FTriangles Triangles(Switch);
	const glm::dvec3 Far(2.3, 1.0, -1.0), Way = GetPlace(Switch, "lamp", 0) - Far;
	EXPECT_LT(Triangles.Trace(Far, glm::normalize(Way)), glm::length(Way));

	const FSceneDescription Flicker = Build("stability-flicker");
	ExpectSealed(Flicker, 20.0);
	ASSERT_EQ(Flicker.Lights.size(), 32u);
	std::set<float> Phases;
	for (const FHostLight& Light : Flicker.Lights)
	{
		Phases.insert(Light.FlickerPhase);
		int On = 0, Switches = 0;
		for (int Frame = 0; Frame < 600; ++Frame)
		{
			On += IsLightOn(Light, Frame / 600.0);
			Switches += IsLightOn(Light, Frame / 600.0) != IsLightOn(Light, (Frame + 1) / 600.0);
		}
		EXPECT_EQ(On, 300) << "half of the time";
		EXPECT_EQ(Switches, int(2 * Light.FlickerHz));
	}
	EXPECT_EQ(std::count_if(Flicker.Lights.begin(), Flicker.Lights.end(), [](const FHostLight& L) { return L.FlickerHz == 5; }), 16);
	EXPECT_EQ(std::count_if(Flicker.Lights.begin(), Flicker.Lights.end(), [](const FHostLight& L) { return L.FlickerHz == 15; }), 16);
	EXPECT_EQ(Phases.size(), 8u);
}

TEST(StabilityScenes, FlickeringThatNoLightCanIsRefused)
{
	FSceneDescription Scene = Build("stability-switch");
	for (const float Bad : {-1.0f, NAN, INFINITY})
	{
		Scene.Lights[0].FlickerHz = Bad;
		EXPECT_NE(ValidateScene(Scene), "") << Bad;
	}
	Scene.Lights[0].FlickerHz = 5.0f;
	Scene.Lights[0].FlickerDuty = 1.5f;
	EXPECT_NE(ValidateScene(Scene), "");
	Scene.Lights[0].FlickerDuty = 0.5f;
	Scene.Lights[0].Type = LIGHT_DIRECTIONAL;
	EXPECT_NE(ValidateScene(Scene), "");
}

TEST(StabilityScenes, LightsAreAsManyAsTheCasesSay)
{
	const FSceneDescription Boiling = Build("stability-boiling");
	ExpectSealed(Boiling, 45.0);
	EXPECT_EQ(Boiling.Lights.size(), 640u);
	EXPECT_TRUE(Boiling.Animations.empty()) << "nothing moves";

	const FSceneDescription Grid = Build("stability-lightgrid");
	EXPECT_EQ(Grid.Lights.size(), 640u);
	EXPECT_TRUE(IsDark(Grid));
	for (const FHostLight& Light : Grid.Lights)
	{
		EXPECT_EQ(Light.Color, Grid.Lights[0].Color);
		EXPECT_EQ(Light.Range, 0.0f) << "an end of their range would be a step of its own";
	}
}

TEST(StabilityScenes, ThingsMove)
{
	const FSceneDescription Mirror = Build("stability-mirror");
	EXPECT_NEAR(GetPlace(Mirror, "mover", 0.75).x, 0.0, 1e-4);
	EXPECT_NEAR(glm::length(GetPlace(Mirror, "mover", 1.0) - GetPlace(Mirror, "mover", 0.5)), 2.0, 1e-4);
	int Mirrors = 0;
	for (const FHostMaterial& Material : Mirror.Materials) { Mirrors += Material.Metallic == 1.0f && Material.Roughness == 0.0f; }
	EXPECT_EQ(Mirrors, 1) << "of both mirrors";

	const FSceneDescription Hash = Build("stability-hash");
	const glm::dvec3 Way = GetCamera(Hash, 4.5).Position - GetCamera(Hash, 4.0).Position;
	EXPECT_NEAR(glm::length(Way), 100.0, 1e-2) << "200 m/s";
	const FTriangles Street(Hash);
	EXPECT_GT(Street.Trace(GetCamera(Hash).Position, {0, 0, -1}), 2100.0) << "the way is free to its end";
	EXPECT_GT(Hash.Nodes.size(), 330u) << "blocks along all of it";
}

TEST(StabilityScenes, RailingIsOnePixelWide)
{
	for (const int Rows : {180, 1080})
	{
		const FSceneDescription Scene = Build("stability-railing:" + std::to_string(Rows));
		const FHostMesh& Railing = GetMesh(Scene, "railing");
		const FHostMaterial& Steel = Scene.Materials[size_t(Railing.Sections[0].Material)];
		EXPECT_FLOAT_EQ(Steel.Roughness, 0.15f);
		EXPECT_FLOAT_EQ(Steel.Metallic, 1.0f);
		// The bars lie in z = 0: their depth is their width.
		const double Pixel = 2.0 * 6.0 * GetCamera(Scene).TanHalf / Rows;
		EXPECT_NEAR(double(Railing.BoundsMax.z - Railing.BoundsMin.z), Pixel, 0.05 * Pixel);
	}
}

TEST(StabilityScenes, OneMeshIsHugeAndTwoThousandAreSmall)
{
	const FSceneDescription Scene = Build("stability-hugemesh");
	const FHostMesh& Land = GetMesh(Scene, "land");
	EXPECT_NEAR(double(Land.BoundsMax.x - Land.BoundsMin.x), 2000.0, 1e-3);
	EXPECT_NEAR(double(Land.BoundsMax.z - Land.BoundsMin.z), 2000.0, 1e-3);
	int Small = 0, Close = 0;
	for (const FHostNode& Node : Scene.Nodes)
	{
		if (Node.Name != "thing") { continue; }
		const FHostMesh& Mesh = Scene.Meshes[size_t(Node.Mesh)];
		Small += glm::length(Mesh.BoundsMax - Mesh.BoundsMin) * Node.Scale.x < 8.0f;
		Close += glm::length(glm::dvec2(Node.Translation.x, Node.Translation.z)) < 50.0;
	}
	EXPECT_EQ(Small, 2000);
	EXPECT_GT(Close, 120);
	const glm::dvec3 Camera = GetCamera(Scene).Position;
	EXPECT_NEAR(FTriangles(Scene).Trace(Camera, {0, -1, 0}), 3.5, 0.3) << "it stands on the land, in no thing";
}

TEST(StabilityScenes, CausticsFallOnAWallThatTheSunDoesNotReach)
{
	const FSceneDescription Scene = Build("stability-caustics");
	const FTriangles Triangles(Scene);
	for (const double Y : {1.0, 1.5, 2.0, 2.8}) { EXPECT_FALSE(Triangles.IsInSun(Scene, {0.3, Y, -1.19})) << Y; }
	const glm::dvec3 Sun = glm::normalize(glm::dvec3(*Scene.DefaultSun));
	for (const double Z : {0.1, 0.5, 0.9})
	{
		const glm::dvec3 Pool(0.3, 0.05, Z);
		EXPECT_TRUE(Triangles.IsInSun(Scene, Pool)) << Z;
		const double Y = Pool.y + (Z + 1.2) * -Sun.y / -Sun.z;
		EXPECT_TRUE(Y > 0.3 && Y < 3.0) << "a still surface reflects it to the wall at " << Y;
	}
	// The wave ends where it began, and at every moment covers the pool but not the rim.
	const FHostMesh& Waves = GetMesh(Scene, "waves");
	const glm::dvec3 Travel = GetPlace(Scene, "waves", 1.4999) - GetPlace(Scene, "waves", 0.0);
	EXPECT_NEAR(Travel.x, 1.2, 1e-3);
	EXPECT_NEAR(Travel.z, 1.2, 1e-3);
	for (const double Time : {0.0, 0.5, 1.4999})
	{
		const glm::dvec3 At = GetPlace(Scene, "waves", Time);
		EXPECT_LE(At.x + double(Waves.BoundsMin.x), -1.5);
		EXPECT_GE(At.x + double(Waves.BoundsMax.x), 1.5);
		EXPECT_LE(At.x + double(Waves.BoundsMax.x), 4.0) << "beyond the rim";
	}
	EXPECT_LT(Waves.BoundsMax.y, 0.06f);
}

TEST(StabilityScenes, ToonSeesNoDirectLight)
{
	const FSceneDescription Scene = Build("stability-toon");
	const FTriangles Triangles(Scene);
	const FCameraPose Camera = GetCamera(Scene);
	int InSun = 0, Lost = 0;
	for (int Y = 0; Y < 27; ++Y)
	{
		for (int X = 0; X < 48; ++X)
		{
			const double U = ((X + 0.5) / 24 - 1) * 16 / 9 * Camera.TanHalf, V = ((Y + 0.5) / 13.5 - 1) * Camera.TanHalf;
			const glm::dvec3 Direction = glm::normalize(Camera.Forward + U * Camera.Right + V * Camera.Up);
			const double Distance = Triangles.Trace(Camera.Position, Direction);
			Lost += Distance == Nothing;
			InSun += Triangles.IsInSun(Scene, Camera.Position + (Distance - 1e-4) * Direction);
		}
	}
	EXPECT_EQ(Lost, 0);
	EXPECT_EQ(InSun, 0);
	EXPECT_TRUE(Triangles.IsInSun(Scene, {-1.6, 0.5, 2.4})) << "the window lets the sun in";
	EXPECT_TRUE(Scene.Animations.empty() && Scene.Lights.empty());
}

TEST(StabilityScenes, FogHasAShaftABoardAndASealedChamber)
{
	const FSceneDescription Scene = Build("stability-fog");
	const glm::dvec3 InShaft(-1.5, 2.9, 5.0), InChamber(2.9, 2.0, 0.0);
	EXPECT_TRUE(FTriangles(Scene).IsInSun(Scene, InShaft));
	EXPECT_FALSE(FTriangles(Scene, 0.5).IsInSun(Scene, InShaft)) << "the board is before the window";
	EXPECT_TRUE(FTriangles(Scene, 0.95).IsInSun(Scene, InShaft)) << "and past it";
	const FTriangles Triangles(Scene);
	for (const glm::dvec3& Point : Triangles.LookAround(InChamber, 4000))
	{
		EXPECT_TRUE(Point.x > 1.79 && Point.x < 4.01) << "light could come in at " << Point.y << ", " << Point.z;
	}
	EXPECT_NEAR(Triangles.Trace(InChamber, {-1, 0, 0}), 1.1, 1e-6) << "its own wall";
	EXPECT_GT(Triangles.FindFarthest({-1.5, 3.5, 4.0}, 4000), 1e9) << "the hall has a window";
}

} // namespace
} // namespace Lantern
