// The built-in scenes are what their closed forms say: the geometry is integrated here without any renderer.
#include <functional>
#include <string_view>

#include <glm/gtc/constants.hpp>

#include "LanternHost/BuiltinScenes.h"
#include "LanternHost/VertexPacking.h"
#include "Support/GltfTestTools.h"

namespace Lantern
{
namespace
{

FSceneDescription Build(const std::string& Name)
{
	FLoadResult Result = LoadScene(Name);
	EXPECT_TRUE(Result.Scene) << Result.Error;
	return Result.Scene ? std::move(*Result.Scene) : FSceneDescription();
}

using FTriangleVisitor = std::function<void(const FHostMaterial&, const glm::dvec3 (&)[3])>;

void ForEachTriangle(const FSceneDescription& Scene, const FTriangleVisitor& Visit)
{
	const FScenePose Pose = EvaluatePose(Scene, 0);
	for (size_t N = 0; N < Scene.Nodes.size(); ++N)
	{
		if (Scene.Nodes[N].Mesh < 0) { continue; }
		const FHostMesh& Mesh = Scene.Meshes[size_t(Scene.Nodes[N].Mesh)];
		for (const FHostSection& Section : Mesh.Sections)
		{
			for (uint32_t I = 0; I < Section.IndexCount; I += 3)
			{
				glm::dvec3 P[3];
				for (uint32_t C = 0; C < 3; ++C)
				{
					const glm::vec3& Local = Mesh.Positions[Mesh.Indices[Section.FirstIndex + I + C]];
					P[C] = glm::dvec3(Pose.World[N] * glm::dvec4(glm::dvec3(Local), 1));
				}
				Visit(Scene.Materials[size_t(Section.Material)], P);
			}
		}
	}
}

/// Irradiance at a point from all emitting triangles that face it: Lambert's polygon formula, E = L/2 · Σ Θᵢ (Γᵢ · n).
double ComputeIrradiance(const FSceneDescription& Scene, const glm::dvec3& Point, const glm::dvec3& Normal)
{
	double Sum = 0.0;
	ForEachTriangle(Scene, [&](const FHostMaterial& Material, const glm::dvec3(&P)[3]) {
		const glm::dvec3 Facing = glm::cross(P[1] - P[0], P[2] - P[0]);
		if (Material.Emissive.x <= 0 || glm::dot(Facing, Point - P[0]) <= 0) { return; }
		double Edges = 0.0;
		for (int I = 0; I < 3; ++I)
		{
			const glm::dvec3 A = glm::normalize(P[I] - Point), B = glm::normalize(P[(I + 1) % 3] - Point);
			const double Sin = glm::length(glm::cross(A, B));
			Edges += std::atan2(Sin, glm::dot(A, B)) * glm::dot(glm::cross(A, B) / Sin, Normal);
		}
		Sum += 0.5 * double(Material.Emissive.x) * std::abs(Edges);
	});
	return Sum;
}

struct FCameraView
{
	glm::dvec3 Origin, Forward, Right, Up;
	double TanHalf;
};

FCameraView GetCamera(const FSceneDescription& Scene)
{
	const FScenePose Pose = EvaluatePose(Scene, 0);
	for (size_t N = 0; N < Scene.Nodes.size(); ++N)
	{
		if (Scene.Nodes[N].Camera >= 0)
		{
			const glm::dmat4& W = Pose.World[N];
			return {glm::dvec3(W[3]), -glm::dvec3(W[2]), glm::dvec3(W[0]), glm::dvec3(W[1]),
			    std::tan(double(Scene.Cameras[size_t(Scene.Nodes[N].Camera)].FovY) / 2)};
		}
	}
	ADD_FAILURE() << "no camera";
	return {};
}

/// Where a ray through the picture (−1 … 1, y up, aspect 1) meets the floor.
glm::dvec3 HitFloor(const FCameraView& View, double X, double Y)
{
	const glm::dvec3 Direction = View.Forward + (View.Right * X + View.Up * Y) * View.TanHalf;
	return View.Origin - Direction * (View.Origin.y / Direction.y);
}

TEST(BuiltinScenes, EachIsValidAndHasACamera)
{
	for (const FBuiltinSceneInfo& Info : GetBuiltinScenes())
	{
		if (std::string_view(Info.Name) == "courtyard")
		{
			continue; // takes its time: CourtyardTests.cpp
		}
		const FSceneDescription Scene = Build(Info.Name);
		EXPECT_EQ(ValidateScene(Scene), "") << Info.Name;
		EXPECT_EQ(Scene.Cameras.size(), 1u) << Info.Name;
		EXPECT_TRUE(Scene.DefaultSun.has_value() && Scene.DefaultSky.has_value()) << Info.Name;
		EXPECT_TRUE(Scene.Warnings.empty());
	}
}

TEST(BuiltinScenes, WrongNamesAndParametersAreNamed)
{
	ExpectError(LoadScene("courtyart"), {"courtyart", "courtyard", "furnace"});
	ExpectError(LoadScene("furnace:grey"), {"ALBEDO", "grey", "0.99"});
	ExpectError(LoadScene("furnace:1.5"), {"ALBEDO", "1.5"});
	ExpectError(LoadScene("furnace:nan"), {"ALBEDO"});
	ExpectError(LoadScene("furnace:"), {"ALBEDO"});
	ExpectError(LoadScene("furnace:0.5:1"), {"too many"});
	EXPECT_TRUE(LoadScene("spherelight:3:60").Scene);
}

TEST(BuiltinScenes, FurnaceIsClosedAndUniform)
{
	const FSceneDescription Scene = Build("furnace:0.7");
	ForEachTriangle(Scene, [](const FHostMaterial& M, const glm::dvec3(&)[3]) {
		EXPECT_EQ(M.Emissive, glm::vec3(0.5f));
		EXPECT_EQ(M.BaseColor.r, 0.7f);
		EXPECT_TRUE(M.Metallic == 0 && M.Specular == 0);
	});
	// Closed: from a point inside the walls cover the whole sphere, so that E = π · 0.5 for any normal.
	const glm::dvec3 Inside(1.5, 2.6, 1.5);
	double Volume = 0.0;
	ForEachTriangle(Scene, [&](const FHostMaterial&, const glm::dvec3(&P)[3]) {
		Volume += glm::dot(P[0] - Inside, glm::cross(P[1] - Inside, P[2] - Inside)) / 6;
	});
	// Signed: the room inwards, the two boxes in it outwards.
	EXPECT_NEAR(Volume, -(4.0 * 3 * 4) + 1.0 * 1.6 * 1.0 + 0.8 * 0.8 * 0.8, 1e-4);
}

TEST(BuiltinScenes, SphereHasTheAreaAndFluxOfItsFormula)
{
	const FSceneDescription Scene = Build("sphere:0.5");
	double Area = 0.0;
	ForEachTriangle(Scene, [&](const FHostMaterial&, const glm::dvec3(&P)[3]) {
		const glm::dvec3 N = glm::cross(P[1] - P[0], P[2] - P[0]);
		Area += glm::length(N) / 2;
		EXPECT_LT(glm::dot(N, P[0]), 0); // inwards
	});
	EXPECT_NEAR(Area, 96.0, 96.0 * 1e-5);
	EXPECT_NEAR(double(Scene.Lights[0].Color.r) * 4 * glm::pi<double>(), 10000.0, 0.1);
}

TEST(BuiltinScenes, PolygonLightGivesThePublishedIrradiances)
{
	constexpr std::pair<const char*, double> Cases[] = {
	    {"0", .752275}, {"0.5", .566645}, {"1", .265005}, {"1.5", .104637}, {"2", .043743}, {"3", .010575}};
	for (const auto& [X, Expected] : Cases)
	{
		const FSceneDescription Scene = Build(std::string("polygonlight:") + X);
		const glm::dvec3 Seen = HitFloor(GetCamera(Scene), 0, 0);
		EXPECT_NEAR(Seen.x, std::stod(X), 1e-4);
		EXPECT_NEAR(ComputeIrradiance(Scene, Seen, {0, 1, 0}), Expected, 2e-5);
	}
}

TEST(BuiltinScenes, FormFactorsAreThePublishedOnesAndFillThePicture)
{
	for (const auto& [Name, Expected] : {std::pair("formfactors:0", .199825), std::pair("formfactors:1", .200044)})
	{
		const FSceneDescription Scene = Build(Name);
		const FCameraView View = GetCamera(Scene);
		EXPECT_NEAR(HitFloor(View, 1, 0).x, 0.5, 1e-5);
		EXPECT_NEAR(HitFloor(View, 0, 1).z, -0.5, 1e-5);
		double Mean = 0.0;
		constexpr int Count = 100;
		for (int Y = 0; Y < Count; ++Y)
		{
			for (int X = 0; X < Count; ++X)
			{
				const glm::dvec3 Point = HitFloor(View, (X + 0.5) * 2 / Count - 1, (Y + 0.5) * 2 / Count - 1);
				Mean += ComputeIrradiance(Scene, Point, {0, 1, 0}) / glm::pi<double>() / (Count * Count);
			}
		}
		EXPECT_NEAR(Mean, Expected, Expected * 5e-4) << Name;
	}
}

TEST(BuiltinScenes, DiskAndSphereLightFollowTheirFormulas)
{
	for (const double Height : {0.5, 1.0, 2.0})
	{
		const FSceneDescription Scene = Build("disk:" + std::to_string(Height));
		const double Expected = glm::pi<double>() / (1 + Height * Height);
		EXPECT_NEAR(ComputeIrradiance(Scene, HitFloor(GetCamera(Scene), 0, 0), {0, 1, 0}), Expected, Expected * 2e-4);
	}
	for (const double Angle : {0.0, 30.0, 60.0})
	{
		const FSceneDescription Scene = Build("spherelight:2:" + std::to_string(Angle));
		const double Expected = glm::pi<double>() * 0.0625 * std::cos(glm::radians(Angle));
		EXPECT_NEAR(ComputeIrradiance(Scene, HitFloor(GetCamera(Scene), 0, 0), {0, 1, 0}), Expected, Expected * 5e-4);
	}
}

TEST(BuiltinScenes, CamerasOfGgxAndPenumbraSeeWhatTheySay)
{
	const FCameraView Ggx = GetCamera(Build("ggx:0.3:0.25"));
	EXPECT_NEAR(-Ggx.Forward.y, 0.25, 1e-6);
	EXPECT_LT(glm::length(HitFloor(Ggx, 0, 0)), 1e-5);
	const FSceneDescription Scene = Build("penumbra:2");
	const FCameraView View = GetCamera(Scene);
	const double Width = 2 * 2.0 * std::tan(glm::radians(0.533) / 2); // 9.30 mm per metre
	EXPECT_NEAR(Width, 2 * 0.00930, 2e-5);
	EXPECT_NEAR(HitFloor(View, 1, 0).x, 2 * Width, 1e-6);
	EXPECT_NEAR(HitFloor(View, -1, 0).x, -2 * Width, 1e-6);
	EXPECT_NEAR(double(Scene.DefaultSun->w), glm::pi<double>(), 1e-6);
}

TEST(BuiltinScenes, PlanesFaceUpAndDown)
{
	const FSceneDescription Scene = Build("planes");
	int Up = 0, Down = 0, DoubleSided = 0;
	ForEachTriangle(Scene, [&](const FHostMaterial& M, const glm::dvec3(&P)[3]) {
		const bool bUp = glm::cross(P[1] - P[0], P[2] - P[0]).y > 0;
		Up += M.Name == "single-sided" && bUp ? 1 : 0;
		Down += M.Name == "single-sided" && !bUp ? 1 : 0;
		DoubleSided += M.bDoubleSided ? 1 : 0;
	});
	EXPECT_EQ(Up, 2);
	EXPECT_EQ(Down, 2);
	EXPECT_EQ(DoubleSided, 2);
}

} // namespace
} // namespace Lantern
