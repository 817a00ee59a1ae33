// Water that scatters light: the reference against closed forms and against a simulation of its own, and frames against both.
#include <cmath>
#include <numbers>

#include "SignalFixture.h"
#include "TransmissionFixture.h"
#include "WaterOracle.h"

namespace Lantern
{

namespace
{
constexpr double Pi = std::numbers::pi, Index = 1.333;
constexpr float Wide = 300.0f; ///< half the edge of pools: paths that leave aside are lost

struct FPool
{
	float Depth = 1.0f;      ///< metres; the extinction is 1 for each
	float Albedo = 0.5f;     ///< of green; others differ
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
	const FPool Pools[] = {{.Depth = 1.0f, .Albedo = 0.5f}, {.Depth = 3.0f, .Albedo = 0.9f}, {.Depth = 3.0f, .Albedo = 0.9f, .Anisotropy = 0.7f}};
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
} // namespace

} // namespace Lantern
