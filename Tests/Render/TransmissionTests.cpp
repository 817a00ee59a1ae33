// Light that shines through surfaces: closed forms of the reference path tracer.
//
// A sheet or a slab of R at each interface passes (1 − R) / (1 + R) straight on. With absorption the slab passes
// (1 − R)² A / (1 − R² A²), where A is what is left of light after one crossing. Water bends by Snell's law.
#include <cmath>

#include "Support/RenderFixture.h"
#include "TransmissionFixture.h"

namespace Lantern
{

namespace
{
constexpr double Tolerance = 0.005;
constexpr double R = GlassR;

/// A wall of 1 nit at z = −10, and what stands before it.
class FTransmissionTest : public FRenderTest
{
protected:
	static FTestScene MakeScene()
	{
		FTestScene Scene("Transmission");
		Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddLambert(glm::vec3(0), glm::vec3(1)), 4.0f, -10.0f)}));
		return Scene;
	}
	/// Looks straight at the wall, so narrowly that all rays are parallel.
	static FView LookAtWall() { return LookAt({0, 0, 10}, {0, 0, -10}, glm::radians(0.05f), 32, 32); }
	FEstimate EstimateThrough(const FTestScene& Scene, uint32_t Samples = 64)
	{
		if (!Load(Scene.Scene)) { return {}; }
		SetSky(glm::vec3(0));
		return EstimateMean(LookAtWall(), Samples, 1);
	}
	static void AddSlab(FTestScene& Scene, const FHostMaterial& Material, float Thickness)
	{
		const int32_t Index = Scene.AddMaterial(Material);
		FTestScene::FQuad Back = MakeWall(Index, 4.0f, -Thickness);
		std::swap(Back.P[1], Back.P[3]); // its outside is away from the camera
		Scene.AddNode(Scene.AddMesh({MakeWall(Index, 4.0f, 0.0f), Back}));
	}
};

TEST_F(FTransmissionTest, SheetPassesWhatItDoesNotReflect)
{
	FTestScene Scene = MakeScene();
	Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddMaterial(MakeGlass()), 4.0f, 0.0f)}));
	const FEstimate Sheet = EstimateThrough(Scene);
	ExpectClosedForm("sheet", Sheet, (1.0 - R) / (1.0 + R), Tolerance);
	SetVariable("r.RT.Debug.Transmission.Sheet", "0");
	const FEstimate Faulty = EstimateThrough(Scene);
	EXPECT_GT(std::abs(Faulty.Mean / ((1.0 - R) / (1.0 + R)) - 1.0), 4.0 * Tolerance) << "the planted fault shows";
}

TEST_F(FTransmissionTest, SheetTintsByItsBaseColorAndShare)
{
	FTestScene Scene = MakeScene();
	FHostMaterial Glass = MakeGlass();
	Glass.BaseColor = {0.2f, 0.5f, 0.9f, 0.1f}; // opaque alphaMode: alpha does not count
	Glass.Transmission = 0.5f;
	Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddMaterial(Glass), 4.0f, 0.0f)}));
	// The other half is a dielectric that reflects nothing, since all else is black.
	ExpectClosedForm("half of a tinted sheet", EstimateThrough(Scene, 512), 0.5 * 0.5 * (1.0 - R) / (1.0 + R), Tolerance);
}

TEST_F(FTransmissionTest, SlabPassesAsASheet)
{
	FTestScene Scene = MakeScene();
	FHostMaterial Glass = MakeGlass();
	Glass.bSolid = true;
	AddSlab(Scene, Glass, 0.5f);
	ExpectClosedForm("slab", EstimateThrough(Scene), (1.0 - R) / (1.0 + R), Tolerance);
}

TEST_F(FTransmissionTest, SlabAbsorbs)
{
	FTestScene Scene = MakeScene();
	FHostMaterial Glass = MakeGlass();
	Glass.bSolid = true;
	Glass.Extinction = glm::vec3(0.5f, 2.0f, 8.0f);
	AddSlab(Scene, Glass, 0.5f);
	const double A = std::exp(-2.0 * 0.5);
	ExpectClosedForm("absorbing slab", EstimateThrough(Scene, 128), (1.0 - R) * (1.0 - R) * A / (1.0 - R * R * A * A), Tolerance);
}

TEST_F(FTransmissionTest, SmoothGlassShowsAnEvenSkyAsItIs)
{
	FTestScene Scene("Furnace");
	FHostMaterial Glass = MakeGlass();
	Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddMaterial(Glass), 4.0f, 0.0f)}));
	Glass.bSolid = true;
	AddSlab(Scene, Glass, 0.5f);
	ASSERT_TRUE(Load(Scene.Scene));
	SetSky(glm::vec3(1));
	FView View = LookAt({2, 1, 3}, {0, 0, 0}, glm::radians(20.0f), 32, 32);
	ExpectClosedForm("furnace", EstimateMean(View, 16, 1), 1.0, 1.0e-3);
}

/// A rough sheet scatters to either side as a metal does to one. What is shadowed twice is lost, as there.
TEST_F(FTransmissionTest, RoughSheetKeepsAsMuchAsAMetal)
{
	for (const float Roughness : {0.2f, 0.5f, 0.9f})
	{
		FHostMaterial Glass = MakeGlass(), Metal;
		Glass.Roughness = Metal.Roughness = Roughness;
		double Means[2] = {};
		for (const bool bMetal : {false, true})
		{
			FTestScene Scene("Furnace");
			Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddMaterial(bMetal ? Metal : Glass), 4.0f, 0.0f)}));
			ASSERT_TRUE(Load(Scene.Scene));
			SetSky(glm::vec3(1));
			const FEstimate Mean = EstimateMean(LookAtWall(), 64, 1);
			EXPECT_LT(Mean.StandardError, 0.002);
			Means[bMetal] = Mean.Mean;
		}
		PrintFigure(fmt::format("roughness {}: sheet {:.4f}, metal {:.4f}", Roughness, Means[0], Means[1]));
		EXPECT_NEAR(Means[0], Means[1], 0.01);
	}
}

/// What a rough slab refracts loses no more than that.
TEST_F(FTransmissionTest, RoughSlabLosesLittle)
{
	FTestScene Scene("Furnace");
	FHostMaterial Glass = MakeGlass();
	Glass.bSolid = true;
	Glass.Roughness = 0.3f;
	AddSlab(Scene, Glass, 0.5f);
	ASSERT_TRUE(Load(Scene.Scene));
	SetSky(glm::vec3(1));
	const FEstimate Mean = EstimateMean(LookAtWall(), 64, 1);
	PrintFigure(fmt::format("rough slab {:.4f}", Mean.Mean));
	EXPECT_LE(Mean.Mean, 1.0 + 3.0 * Mean.StandardError);
	EXPECT_GE(Mean.Mean, 0.97);
}

/// Looks down into water of one metre at 45 degrees. The bed shines where Snell's law says that the picture's middle lies.
TEST_F(FTransmissionTest, WaterBendsBySnellsLaw)
{
	const double Behind = std::tan(std::asin(std::sin(glm::radians(45.0)) / 1.333)); // metres along the bed for each of depth
	for (const double Off : {-0.02, 0.02})
	{
		FTestScene Scene("Water");
		FHostMaterial Water = MakeGlass();
		Water.Ior = 1.333f;
		Water.bSolid = true;
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddMaterial(Water), 4.0f)}));
		const int32_t Shining = Scene.AddLambert(glm::vec3(0), glm::vec3(1)), Dark = Scene.AddLambert(glm::vec3(0));
		const float Edge = -static_cast<float>(Behind + Off);
		const auto MakeBed = [](int32_t Material, float Near, float Far) {
			return FTestScene::FQuad{Material, {{-4, -1, Near}, {4, -1, Near}, {4, -1, Far}, {-4, -1, Far}}};
		};
		Scene.AddNode(Scene.AddMesh({MakeBed(Dark, 4.0f, Edge), MakeBed(Shining, Edge, -4.0f)}));
		ASSERT_TRUE(Load(Scene.Scene));
		SetSky(glm::vec3(0));
		const FView View = LookAt({0, 5, 5}, {0, 0, 0}, glm::radians(0.02f), 8, 8);
		const double Mean = EstimateMean(View, 64, 1).Mean;
		if (Off < 0.0) { EXPECT_GT(Mean, 0.9); }
		else { EXPECT_LT(Mean, 0.01); }
	}
}

/// The sun shines on a floor through a sheet: light sampling sees what the sheet leaves of it.
TEST_F(FTransmissionTest, ReferenceTintsShadows)
{
	const auto MakeFloorUnder = [](bool bSheet) {
		FTestScene Scene("Shadow");
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0.5f)), 4.0f)}));
		FHostMaterial Glass = MakeGlass();
		Glass.BaseColor = {0.2f, 0.5f, 0.9f, 1.0f};
		if (bSheet) { Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddMaterial(Glass), 4.0f, 3.0f)})); }
		return Scene;
	};
	double Means[2] = {};
	for (const bool bSheet : {false, true})
	{
		ASSERT_TRUE(Load(MakeFloorUnder(bSheet).Scene));
		SetSun(0.5, 4.0f, {0.0, -1.0, 0.0});
		SetSky(glm::vec3(0));
		const FView View = LookAt({0, 1, 1}, {0, 0, 0}, glm::radians(1.0f), 16, 16);
		Means[bSheet] = EstimateMean(View, 64, 1).Mean;
	}
	EXPECT_NEAR(Means[1] / Means[0], 0.5 * (1.0 - R) / (1.0 + R), Tolerance);
}
} // namespace

} // namespace Lantern
