// Indirect light in the air, against closed forms: a sky, half of one, what shines, a room of many bounces, and a dark one.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "FogFixture.h"

namespace Lantern
{

namespace
{
class FIndirectVolumeTest : public FFogTest
{
protected:
	static constexpr uint32_t Settled = 60; // frames

	void SetUp() override
	{
		FFogTest::SetUp();
		GetEngine().Signals.bFog = false;
		GetEngine().Signals.bIndirectVolume = true;
		SetVariable("r.RT.GI", "3");
		SetVariable("r.RT.GI.Denoise", "0");
		SetVariable("r.RT.Reflections", "0");
		SetVariable("r.RT.GI.Cells.Capacity", "65536");
		SetVariable("r.RT.GI.Cells.SizeAngle", "0.1");
		SetVariable("r.RT.GI.Cells.UpdatesPerSecond", "120000");
		SetVariable("r.RT.GI.Volume.PixelSize", "8");
		SetVariable("r.RT.GI.Volume.Slices", "16");
		SetVariable("r.RT.GI.Volume.Distance", "8");
		SetVariable("r.RT.GI.Volume.Samples", "4");
		SetVariable("r.RT.GI.Volume.HistorySeconds", "2");
	}

	struct FAir
	{
		glm::dvec3 Mean{0}, Moment{0};
		double Brightest = 0.0, Spread = 0.0; // Spread: standard deviation of froxels, of green
		uint32_t Froxels = 0;
	};
	/// Mean over the froxels whose centre Takes says.
	FAir FindAir(const FView& View, const std::function<bool(const glm::dvec3&)>& Takes, uint32_t Frames = Settled)
	{
		std::vector<glm::vec3> Moments;
		const FFogPicture Volume = RenderVolume(View, Frames, Moments);
		FAir Air;
		if (Volume.Light.empty()) { return Air; }
		Volume.ForEach([&](glm::uvec3 Froxel) {
			if (!Takes(FroxelToWorld(View, Volume.Grid, glm::dvec3(Froxel) + 0.5))) { return; }
			Air.Mean += glm::dvec3(Volume.GetLight(Froxel));
			Air.Moment += glm::dvec3(Moments[Volume.GetTexel(Froxel)]);
			Air.Brightest = std::max(Air.Brightest, double(Volume.GetLight(Froxel).y));
			Air.Spread += double(Volume.GetLight(Froxel).y) * double(Volume.GetLight(Froxel).y);
			++Air.Froxels;
		});
		Air.Mean /= std::max(Air.Froxels, 1u);
		Air.Moment /= std::max(Air.Froxels, 1u);
		Air.Spread = std::sqrt(std::max(Air.Spread / std::max(Air.Froxels, 1u) - Air.Mean.y * Air.Mean.y, 0.0));
		return Air;
	}

	/// A black floor under an even sky.
	void LoadHalfASky(const glm::vec3& Radiance)
	{
		FTestScene Scene("floor");
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0)), 1000.0f)}));
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.0, 0.0f, {0, -1, 0});
		SetSky(Radiance);
	}
	/// A closed box of side 4 around the origin.
	static FSceneDescription MakeBox(const glm::vec3& Albedo, const glm::vec3& Emission)
	{
		FTestScene Scene("box");
		const int32_t Wall = Scene.AddLambert(Albedo, Emission, true);
		FHostMesh Box;
		std::vector<FTestScene::FQuad> Quads = {{Wall, {{-2, -2, 2}, {2, -2, 2}, {2, -2, -2}, {-2, -2, -2}}},
		    {Wall, {{-2, 2, -2}, {2, 2, -2}, {2, 2, 2}, {-2, 2, 2}}}, {Wall, {{-2, -2, -2}, {2, -2, -2}, {2, 2, -2}, {-2, 2, -2}}},
		    {Wall, {{2, -2, 2}, {-2, -2, 2}, {-2, 2, 2}, {2, 2, 2}}}, {Wall, {{-2, -2, 2}, {-2, -2, -2}, {-2, 2, -2}, {-2, 2, 2}}},
		    {Wall, {{2, -2, -2}, {2, -2, 2}, {2, 2, 2}, {2, 2, -2}}}};
		Scene.AddNode(Scene.AddMesh(Quads));
		return std::move(Scene.Scene);
	}
	static bool IsInBox(const glm::dvec3& P) { return glm::all(glm::lessThan(glm::abs(P), glm::dvec3(1.5))); }
	static FView LookIntoBox() { return LookAt({0, 0, 1.9}, {0, 0, -2}, 1.0f, 64, 40); }
};

TEST_F(FIndirectVolumeTest, HalfOfTheSky)
{
	LoadHalfASky(glm::vec3(2, 1, 0.5));
	const FAir Air = FindAir(LookAt({0, 3, 4}, {0, 1, -4}, 0.8f, 64, 40), [](const glm::dvec3& P) { return P.y > 0.5 && P.y < 4.0; });
	ASSERT_GT(Air.Froxels, 100u);
	PrintFigure(fmt::format("half a sky of 2, 1, 0.5: mean {:.4f}, {:.4f}, {:.4f}; moment {:.4f}, {:.4f}, {:.4f}; spread {:.4f}",
	    Air.Mean.x, Air.Mean.y, Air.Mean.z, Air.Moment.x, Air.Moment.y, Air.Moment.z, Air.Spread));
	// Of directions above the floor alone: 1/2 of the light, and 1/2 · 1/2 of its luminance upwards.
	const double Luminance = 2.0 * 0.2126 + 0.7152 + 0.5 * 0.0722;
	for (int C = 0; C < 3; ++C) { EXPECT_NEAR(Air.Mean[C] / (0.5 * (C == 0 ? 2.0 : C == 1 ? 1.0 : 0.5)), 1.0, 0.01) << C; }
	EXPECT_NEAR(Air.Moment.y / (0.25 * Luminance), 1.0, 0.02);
	EXPECT_NEAR(Air.Moment.x / Luminance, 0.0, 0.005);
	EXPECT_NEAR(Air.Moment.z / Luminance, 0.0, 0.005);
	// 120 paths, all of which see the sky or not, would scatter by 0.046 if chance alone drew them.
	EXPECT_LT(Air.Spread, 0.03);
}

// Fog that hides all else, seen upwards and downwards.
TEST_F(FIndirectVolumeTest, FogTakesItsLightByDirection)
{
	LoadHalfASky(glm::vec3(1));
	SetVariable("r.Fog.Density", "2");
	SetVariable("r.Fog.HeightFalloff", "0");
	SetVariable("r.Fog.Albedo", "0.8");
	for (const double G : {0.5, -0.5})
	{
		SetVariable("r.Fog.Phase", fmt::format("{}", G).c_str());
		for (const double Up : {1.0, -1.0})
		{
			const FView View = LookAt({0, 5, 0}, {0, 5 + Up, 0.001}, 0.1f, 32, 32);
			for (uint32_t Frame = 0; Frame < Settled; ++Frame) { RenderLighting(View); }
			const double Seen = MeanGreen(RenderLighting(View)), Expected = 0.8 * (0.5 + 3.0 * G * 0.25 * Up);
			PrintFigure(fmt::format("fog under half a sky, g {}, {}: {:.4f} of {:.4f}", G, Up > 0.0 ? "up" : "down", Seen, Expected));
			EXPECT_NEAR(Seen, Expected, 0.02);
		}
	}
}

TEST_F(FIndirectVolumeTest, TheSameBitsAgainAtAnOddSize)
{
	const FView View = LookAt({0, 0, 1.9}, {0, 0, -2}, 1.0f, 131, 73);
	std::vector<glm::vec3> Lights[2], Moments[2];
	for (int Run = 0; Run < 2; ++Run)
	{
		ASSERT_TRUE(Load(MakeBox(glm::vec3(0.5f), glm::vec3(1.0f))));
		SetSun(0.0, 0.0f, {0, -1, 0});
		SetSky(glm::vec3(0));
		GetEngine().SetFrameIndex(0);
		Lights[Run] = RenderVolume(View, 6, Moments[Run]).Light;
	}
	ASSERT_FALSE(Lights[0].empty());
	EXPECT_TRUE(Lights[0] == Lights[1]);
	EXPECT_TRUE(Moments[0] == Moments[1]);
}

TEST_F(FIndirectVolumeTest, RoomThatShinesByManyBounces)
{
	ASSERT_TRUE(Load(MakeBox(glm::vec3(0.5f), glm::vec3(1.0f))));
	SetSun(0.0, 0.0f, {0, -1, 0});
	SetSky(glm::vec3(0));
	SetVariable("r.RT.GI.Volume.HistorySeconds", "0.5"); // the first frames know few bounces
	for (const bool bListed : {false, true})
	{
		SetVariable("r.RT.Lights.Emissive", bListed ? "1" : "0");
		const FAir Air = FindAir(LookIntoBox(), IsInBox, 2 * Settled);
		ASSERT_GT(Air.Froxels, 100u);
		PrintFigure(fmt::format(
		    "room of albedo 0.5 that shines 1, listed {}: mean {:.4f}, moment {:.4f}", bListed, Air.Mean.y, glm::length(Air.Moment)));
		EXPECT_NEAR(Air.Mean.y / 2.0, 1.0, 0.02) << "1 / (1 - albedo)";
		EXPECT_LT(glm::length(Air.Moment), 0.02);
	}
}

// Outside is as bright as day, and walls have no thickness.
TEST_F(FIndirectVolumeTest, DarkRoomStaysDark)
{
	ASSERT_TRUE(Load(MakeBox(glm::vec3(0.5f), glm::vec3(0.0f))));
	SetSun(0.53, 10.0f, {0.3, -1, 0.2});
	SetSky(glm::vec3(1));
	FAir Airs[2];
	for (const bool bFaulty : {false, true})
	{
		SetVariable("r.RT.Debug.Fog.Slice", bFaulty ? "0" : "1");
		Airs[bFaulty] = FindAir(
		    LookIntoBox(), [](const glm::dvec3& P) { return glm::all(glm::lessThan(glm::abs(P), glm::dvec3(2.0))); }, 12);
	}
	ASSERT_GT(Airs[0].Froxels, 100u);
	PrintFigure(fmt::format("dark room: mean {:.6f}, brightest {:.6f}; rays a slice too far: {:.4f}, {:.4f}", Airs[0].Mean.y,
	    Airs[0].Brightest, Airs[1].Mean.y, Airs[1].Brightest));
	EXPECT_LT(Airs[0].Brightest, 1.0e-3);
	EXPECT_GT(Airs[1].Brightest, 1.0e-3) << "the planted fault must be seen";
}

/// What a panel of 2 x 2 m at z = -6 brings to P, by a sum over its parts.
void AddPanel(const glm::dvec3& P, double Emission, double& Mean, glm::dvec3& Moment)
{
	constexpr int Parts = 16;
	for (int I = 0; I < Parts * Parts; ++I)
	{
		const glm::dvec3 At(2.0 * (I % Parts + 0.5) / Parts - 1.0, 2.0 * (I / Parts + 0.5) / Parts - 1.0, -6.0), To = At - P;
		const double Distance = glm::length(To), Solid = 4.0 / (Parts * Parts) * std::abs(To.z) / (Distance * Distance * Distance);
		const double Brought = Emission * Solid / (4.0 * glm::pi<double>());
		Mean += Brought;
		Moment += Brought * To / Distance;
	}
}

TEST_F(FIndirectVolumeTest, MomentPointsToWhatShines)
{
	FTestScene Scene("panel");
	const int32_t Panel = Scene.AddLambert(glm::vec3(0), glm::vec3(5.0f), true);
	Scene.AddNode(Scene.AddMesh({{Panel, {{-1, -1, -6}, {1, -1, -6}, {1, 1, -6}, {-1, 1, -6}}}}));
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.0, 0.0f, {0, -1, 0});
	SetSky(glm::vec3(0));
	for (const bool bFaulty : {false, true})
	{
		double Mean = 0.0;
		glm::dvec3 Moment(0);
		const auto Near = [&](const glm::dvec3& P) {
			const bool bTakes = P.z < -1.0 && P.z > -4.0;
			if (bTakes) { AddPanel(P, 5.0, Mean, Moment); }
			return bTakes;
		};
		SetVariable("r.RT.Debug.GI.VolumeMoment", bFaulty ? "0" : "1");
		const FAir Air = FindAir(LookAt({0, 0, 0}, {0, 0, -6}, 1.0f, 64, 40), Near);
		ASSERT_GT(Air.Froxels, 100u);
		Mean /= Air.Froxels;
		Moment /= Air.Froxels;
		PrintFigure(fmt::format(
		    "panel: mean {:.4f} of {:.4f}, moment {:.4f} of {:.4f}, faulty {}", Air.Mean.y, Mean, Air.Moment.z, Moment.z, bFaulty));
		EXPECT_NEAR(Air.Mean.y / Mean, 1.0, 0.03); // froxels have a size
		const double Off = glm::length(Air.Moment - Moment) / glm::length(Moment);
		if (bFaulty) { EXPECT_GT(Off, 0.05) << "the planted fault must be seen"; }
		else { EXPECT_LT(Off, 0.05); }
	}
}
} // namespace

} // namespace Lantern
