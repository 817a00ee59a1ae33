// Water that scatters light: the reference against closed forms and against a simulation of its own, and frames against both.
#include <cmath>

#include "SignalFixture.h"
#include "TransmissionFixture.h"
#include "WaterOracle.h"

namespace Lantern
{

namespace
{
constexpr double Index = 1.333;
constexpr float Wide = 300.0f; ///< half the edge of pools: paths that leave aside are lost

struct FPool
{
	float Depth = 1.0f;  ///< metres; the extinction is 1 for each
	float Albedo = 0.5f; ///< of green; others differ
	float Anisotropy = 0.0f;
	glm::vec3 Bed{0};
};

class FScatteringTest : public FSignalTest
{
protected:
	static FHostMaterial MakeWater(const FPool& Pool)
	{
		FHostMaterial Water = MakeGlass(true, float(Index));
		Water.Extinction = {0.5f, 1.0f, 2.0f};
		Water.ScatterAlbedo = {0.5f * Pool.Albedo, Pool.Albedo, 0.25f * Pool.Albedo};
		Water.ScatterAnisotropy = Pool.Anisotropy;
		return Water;
	}
	void LoadPool(const FPool& Pool)
	{
		FTestScene Scene("pool");
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddMaterial(MakeWater(Pool)), Wide)}));
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(Pool.Bed), Wide, -Pool.Depth)}));
		ASSERT_TRUE(Load(Scene.Scene));
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(0));
	}
	/// Looks down at 45 degrees, so narrowly that all rays are parallel.
	static FView LookAtPool(uint32_t Size = 16) { return LookAt({0, 3, 3}, {0, 0, 0}, glm::radians(0.5f), Size, Size); }
	static double ViewCosine() { return std::sqrt(0.5); }
	/// Settled frames, whose paths end in radiance cells.
	double MeasureFrames(const FView& View)
	{
		SetVariable("r.RT.GI", "3");
		SetVariable("r.RT.Reflections", "1");
		SetVariable("r.RT.GI.Cells.UpdatesPerSecond", "300000"); // small pictures have few cells, and updates would be most of their time
		GetEngine().SetFrameIndex(0);
		constexpr int Frames = 40, Last = 10;
		double Sum = 0.0;
		for (int Frame = 0; Frame < Frames; ++Frame)
		{
			const double Mean = MeanGreen(RenderLighting(View));
			Sum += Frame >= Frames - Last ? Mean / Last : 0.0;
		}
		return Sum;
	}
};

/// Under an even sky, all that is white has the sky's radiance: a bed under water as well, and water that absorbs nothing. The bed's light
/// sampling finds the sky behind the surface, and must find no more of it than paths do.
TEST_F(FScatteringTest, FurnaceUnderWater)
{
	const auto Measure = [&](float Extinction) {
		FTestScene Scene("furnace");
		FHostMaterial Water = MakeGlass(true, float(Index));
		Water.Extinction = glm::vec3(Extinction);
		Water.ScatterAlbedo = glm::vec3(1.0f);
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddMaterial(Water), Wide)}));
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(1)), Wide, -1.0f)}));
		if (!Load(Scene.Scene)) { return FEstimate{}; }
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(1));
		return EstimateMean(LookAtPool(), 48);
	};
	ExpectClosedForm("a white bed under water", Measure(0.0f), 1.0, 0.005);
	ExpectClosedForm("a white bed under water that scatters", Measure(1.0f), 1.0, 0.005);
}

/// One scattering of the sun's light, against the closed form.
TEST_F(FScatteringTest, SunIsScatteredOnce)
{
	for (const float G : {0.0f, 0.7f})
	{
		LoadPool({.Depth = 0.8f, .Albedo = 0.6f, .Anisotropy = G});
		const double SunCosine = 0.6;
		SetSun(0.0, 3.0f, {0.8, -SunCosine, 0.0}); // across the view
		const double Mu = BendCosine(Index, ViewCosine()), Below = BendCosine(Index, SunCosine), Way = 1.0 + Mu / Below;
		const double Cosine = -SunCosine * Mu; // of the ray against the direction to the sun, straight on
		const double Phase = (1.0 - G * G) / (4.0 * Pi * std::pow(1.0 + G * G - 2.0 * G * Cosine, 1.5));
		const double Let = (1.0 - WaterReflectance(Index, ViewCosine())) * (1.0 - WaterReflectance(Index, SunCosine)) / (Index * Index);
		const double Horizontal = 3.0 * SunCosine;
		const double Expected = Let * 0.6 * Phase * Horizontal / Below * (1.0 - std::exp(-0.8 / Mu * Way)) / Way;
		ExpectClosedForm(G > 0.0f ? "forward" : "even", EstimateMean(LookAtPool(), 192, 1), Expected, 0.005);
	}
}

/// Any number of scatterings, against the simulation.
TEST_F(FScatteringTest, ReferenceAgreesWithASimulation)
{
	const FPool Pools[] = {{.Depth = 1.0f, .Albedo = 0.5f}, {.Depth = 3.0f, .Albedo = 0.9f, .Anisotropy = 0.7f}};
	for (const FPool& Pool : Pools)
	{
		const FWaterLight Light = SimulateWater({Pool.Depth, Pool.Albedo, Pool.Anisotropy, Index}, ViewCosine(), 0.6, 400'000);
		LoadPool(Pool);
		SetSun(0.0, 1.0f / 0.6f, {0.8, -0.6, 0.0});
		const std::string Name = fmt::format("albedo {}, anisotropy {}", Pool.Albedo, Pool.Anisotropy);
		ExpectClosedForm((Name + ", sun").c_str(), EstimateMean(LookAtPool(), 160), Light.OfSun, 0.015);
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(1));
		const double Reflected = WaterReflectance(Index, ViewCosine());
		ExpectClosedForm((Name + ", sky").c_str(), EstimateMean(LookAtPool(), 160), Reflected + Light.OfSky, 0.015);
	}
}
/// The closed form of frames is within 10 % RMS of simulations, and has its greatest errors where light is scattered forward.
TEST_F(FScatteringTest, FramesAgreeWithTheSimulation)
{
	constexpr double Tolerance = 0.08;
	const FPool Pools[] = {
	    {.Depth = 1.0f, .Albedo = 0.5f}, {.Depth = 3.0f, .Albedo = 0.9f}, {.Depth = 3.0f, .Albedo = 0.9f, .Anisotropy = 0.5f}};
	const FView View = LookAtPool();
	for (const FPool& Pool : Pools)
	{
		const FWaterLight Light = SimulateWater({Pool.Depth, Pool.Albedo, Pool.Anisotropy, Index}, ViewCosine(), 0.6, 100'000);
		const double Reflected = WaterReflectance(Index, ViewCosine());
		LoadPool(Pool);
		SetSun(0.0, 1.0f / 0.6f, {0.8, -0.6, 0.0});
		const double OfSun = MeasureFrames(View) / Light.OfSun;
		SetVariable("r.RT.Transmission.Path", "2"); // ray queries
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(1));
		const double OfSky = (MeasureFrames(View) - Reflected) / Light.OfSky;
		SetVariable("r.RT.Transmission.Path", "1");
		PrintFigure(
		    fmt::format("albedo {}, anisotropy {}: sun {:.3f}, sky {:.3f} of the simulation", Pool.Albedo, Pool.Anisotropy, OfSun, OfSky));
		EXPECT_NEAR(OfSun, 1.0, Tolerance);
		EXPECT_NEAR(OfSky, 1.0, Tolerance);
	}
	SetVariable("r.RT.Debug.Transmission.Scattering", "0");
	LoadPool(Pools[0]);
	SetSun(0.0, 1.0f / 0.6f, {0.8, -0.6, 0.0});
	const FWaterLight Light = SimulateWater({1.0, 0.5, 0.0, Index}, ViewCosine(), 0.6, 100'000);
	EXPECT_GT(MeasureFrames(View) / Light.OfSun, 1.0 + 2.0 * Tolerance) << "the planted fault shows";
	SetVariable("r.RT.Debug.Transmission.Scattering", "1");
	SetVariable("r.RT.Transmission.Scattering", "0");
	EXPECT_LT(MeasureFrames(View) / Light.OfSun, 0.01) << "what does not scatter absorbs";
}

/// A mirror that stands on the pool shows its water: design, "water in a mirror".
TEST_F(FScatteringTest, MirrorsShowWater)
{
	const FPool Pool{.Depth = 1.0f, .Albedo = 0.2f};
	FTestScene Scene("pool and mirror");
	FHostMaterial Mirror;
	Mirror.Roughness = 0.0f;
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddMaterial(MakeWater(Pool)), Wide)}));
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0)), Wide, -Pool.Depth)}));
	Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddMaterial(Mirror), 8.0f, -1.0f)}));
	ASSERT_TRUE(Load(Scene.Scene));
	SetSky(glm::vec3(0));
	SetSun(0.0, 1.0f / 0.6f, {0.8, -0.6, 0.0});
	const FView View = LookAt({0, 3, 1}, {0, 2, -1}, glm::radians(0.5f), 16, 16);
	const FWaterLight Light = SimulateWater({Pool.Depth, Pool.Albedo, Pool.Anisotropy, Index}, 1.0 / std::sqrt(5.0), 0.6, 400'000);
	const double Reference = EstimateMean(View, 128).Mean / Light.OfSun, Frames = MeasureFrames(View) / Light.OfSun;
	PrintFigure(fmt::format("water in a mirror over the simulation: reference {:.4f}, frames {:.4f}", Reference, Frames));
	EXPECT_NEAR(Reference, 1.0, 0.02);
	EXPECT_NEAR(Frames, 1.0, 0.02);
}
} // namespace

} // namespace Lantern
