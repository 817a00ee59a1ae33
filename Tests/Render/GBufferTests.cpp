// Raster and path tracer see the same surfaces: where light is direct and nothing else, their pictures agree. What is
// left is the G-buffer's quantisation. Base colours have 8 bits, sRGB-encoded, half a step of which is 0.6 % of a middle
// grey, and drivers encode with approximations of their own; where that would hide errors, colours of the tests are
// what 8 bits hold, or it is measured and divided out. Normals have 16 bits, roughness 8.
//
// The raster is rendered finer and averaged, since a reference pixel is the mean over its area.
#include <cmath>

#include "LanternHost/SceneLoader.h"
#include "LanternImage/ImageStatistics.h"
#include "LanternImage/Metrics.h"
#include "Support/RenderFixture.h"
#include "Support/Srgb.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{

class FGBufferTest : public FRenderTest
{
protected:
	/// Scale: by what quantisation makes the raster brighter.
	static void ExpectAgreement(
	    const char* What, const FImage& Raster, const FImage& Reference, double MeanTolerance, double BlockTolerance, double Scale = 1.0)
	{
		FImage Scaled = Raster;
		for (float& Value : Scaled.Pixels) { Value /= static_cast<float>(Scale); }
		FImageMetrics Metrics;
		ASSERT_OK(CompareImages(Scaled, Reference, Metrics));
		PrintFigure(fmt::format("{}: mean ratio {:.5f} {:.5f} {:.5f}, block16 median {:.5f}, p95 {:.5f}", What, Metrics.MeanRatio[0],
		    Metrics.MeanRatio[1], Metrics.MeanRatio[2], Metrics.Block16Median, Metrics.Block16P95));
		for (const double Ratio : Metrics.MeanRatio) { EXPECT_NEAR(Ratio, 1.0, MeanTolerance) << What; }
		EXPECT_LE(Metrics.Block16Median, BlockTolerance) << What;
		EXPECT_EQ(Metrics.NonFinite[0] + Metrics.NonFinite[1], 0u) << What;
		EXPECT_GT(ComputeMeans(Reference).MaxLuminance, 0.05) << What << ": nothing to see";
	}

	/// How much brighter a Lambert of 0.5 becomes in the G-buffer of this driver.
	double MeasureGreyScale()
	{
		FTestScene Grey("grey");
		Grey.AddNode(Grey.AddMesh({FTestScene::MakeFloor(Grey.AddLambert(glm::vec3(0.5f)), 4.0f)}));
		EXPECT_TRUE(Load(std::move(Grey.Scene)));
		SetSun(0.0, 4.0f, {0, -1, 0});
		const double Scale = MeanGreen(RenderLighting(LookAt({0, 2, 1}, {0, 0, 0}, 0.5f, 16, 16))) / (4.0 * 0.5 / 3.14159265358979);
		EXPECT_NEAR(Scale, 1.0, 0.009) << "a step of sRGB and the driver's approximation of it";
		return Scale;
	}

	/// Loads a scene without what shines in it, which the raster does not let shine on others.
	bool LoadDark(const std::string& Name)
	{
		FLoadResult Result = LoadScene(Name);
		EXPECT_TRUE(Result.Scene.has_value()) << Result.Error;
		if (!Result.Scene) { return false; }
		for (FHostMaterial& Material : Result.Scene->Materials) { Material.Emissive = glm::vec3(0); }
		const bool bLoaded = Load(std::move(*Result.Scene));
		SetSun(0.0);
		SetSky(glm::vec3(0));
		GetScene().SetSceneLights(false);
		return bLoaded;
	}

	/// Sun alone, hard, each surface a Lambert of 0.5: visibility, shadows and normals, no textures.
	void ExpectSunAgreement(const char* What, const FView& View, double GreyScale)
	{
		SetVariable("r.RT.Material.Override", "2");
		const FImage Raster = RenderLightingFine(View, 4);
		const FImage Reference = TraceReference(View, 32, 1);
		// 0.4 % for the mean: normals of 16 bits, and shadow edges sampled 16 times against 32.
		ExpectAgreement(What, Raster, Reference, 0.004, 0.01, GreyScale);
	}
};

TEST_F(FGBufferTest, CourtyardUnderSun)
{
	const double GreyScale = MeasureGreyScale();
	ASSERT_TRUE(LoadDark("courtyard"));
	ExpectSunAgreement("courtyard, sun, Lambert 0.5", MakeView(160, 90), GreyScale);
}

TEST_F(FGBufferTest, SponzaUnderSun)
{
	REQUIRE_SCENE(Scene, "sponza/Sponza.gltf");
	const double GreyScale = MeasureGreyScale();
	ASSERT_TRUE(LoadDark(Scene));
	ExpectSunAgreement("sponza, sun, Lambert 0.5", LookAt({-9, 1.6, -0.4}, {10, 3.2, -1.2}, glm::radians(60.0f), 160, 90), GreyScale);
}

// With textures, normal maps, alpha tests and the full BRDF. The raster filters textures by mip maps, rays take the
// finest level: blocks differ by a little more.
TEST_F(FGBufferTest, CourtyardMaterialsUnderSun)
{
	ASSERT_TRUE(LoadDark("courtyard"));
	const FView View = MakeView(160, 90);
	ExpectAgreement("courtyard, sun, its materials", RenderLightingFine(View, 4), TraceReference(View, 32, 1), 0.02, 0.02);
}

// Punctual lights over a floor that nothing hides: the same formula in both.
TEST_F(FGBufferTest, PunctualLights)
{
	FTestScene Lights("lights");
	Lights.AddNode(Lights.AddMesh({FTestScene::MakeFloor(Lights.AddLambert(glm::vec3(MakeSrgb(190))), 8.0f)}));
	FHostLight Point;
	Point.Color = {30, 20, 10};
	Lights.AddLight(Point, glm::translate(glm::dmat4(1), {-2.0, 1.0, 0.0}));
	Point.Range = 3.0f;
	Point.Color = {5, 10, 30};
	Lights.AddLight(Point, glm::translate(glm::dmat4(1), {2.0, 1.5, 0.5}));
	FHostLight Spot;
	Spot.Color = {40, 40, 40};
	Spot.InnerCone = 0.2f;
	Spot.OuterCone = 0.5f;
	// Lights shine along −z: turned to shine down, and a little to the side.
	Lights.AddLight(Spot, glm::rotate(glm::translate(glm::dmat4(1), {0.0, 2.0, 1.0}), -1.3, glm::dvec3(1, 0, 0)));
	ASSERT_TRUE(Load(std::move(Lights.Scene)));
	const FView View = LookAt({0, 4, 5}, {0, 0, 0}, 0.9f, 96, 64);
	const FImage Raster = RenderLightingFine(View, 4), Reference = TraceReference(View, 256, 1);
	// 256 samples choose among three lights: 0.3 % of noise in a block.
	ExpectAgreement("punctual lights", Raster, Reference, 0.004, 0.006);
	SetVariable("r.RT.LocalLights", "0");
	EXPECT_EQ(ComputeMeans(RenderLighting(View)).MaxLuminance, 0.0);
}

// The two could be wrong together: light of each kind against its formula, at points of the floor seen from above.
TEST_F(FGBufferTest, LightsByFormula)
{
	SetVariable("r.RT.Lights.Denoise", "0"); // it smooths a spot's gradient
	FTestScene Lights("lights");
	const double Albedo = MakeSrgb(190);
	Lights.AddNode(Lights.AddMesh({FTestScene::MakeFloor(Lights.AddLambert(glm::vec3(MakeSrgb(190))), 8.0f)}));
	ASSERT_TRUE(Load(std::move(Lights.Scene)));
	const auto ExpectRadiance = [&](const char* What, double X, double Irradiance) {
		const FView View = LookAt({X, 6, 0}, {X, 0, 0}, 0.0005f, 8, 8);
		const double Expected = Irradiance * Albedo / 3.14159265358979;
		EXPECT_NEAR(MeanGreen(RenderLighting(View)), Expected, 0.002 * Expected + 1e-6) << What << ", raster, x = " << X;
		EXPECT_NEAR(MeanGreen(TraceReference(View, 1, 1)), Expected, 0.002 * Expected + 1e-6) << What << ", reference, x = " << X;
	};
	SetSun(0.0, 4.0f, {1, -2, 0});
	ExpectRadiance("sun", 0.0, 4.0 * 2.0 / std::sqrt(5.0));
	SetSun(0.0, 0.0f);
	// KHR_lights_punctual; the light is 2 m above the floor.
	FSceneLight Light{};
	Light.Position = {0, 2, 0};
	Light.Color = glm::vec3(30);
	const FLightId Id = GetScene().GetScene().AddLight(Light);
	for (const double Range : {0.0, 3.0})
	{
		Light.Range = static_cast<float>(Range);
		GetScene().GetScene().SetLight(Id, Light);
		for (const double X : {0.0, 1.5, 2.5})
		{
			const double Distance2 = X * X + 4.0;
			const double Window = Range > 0.0 ? std::clamp(1.0 - std::pow(Distance2 / (Range * Range), 2.0), 0.0, 1.0) : 1.0;
			ExpectRadiance("point", X, 30.0 * Window / Distance2 * 2.0 / std::sqrt(Distance2));
		}
	}
	Light.Range = 0.0f;
	Light.Direction = {0, -1, 0};
	const double Inner = 0.3, Outer = 0.7;
	Light.InnerCone = static_cast<float>(Inner);
	Light.OuterCone = static_cast<float>(Outer);
	GetScene().GetScene().SetLight(Id, Light);
	for (const double Angle : {0.0, 0.25, 0.4, 0.6, 0.75})
	{
		const double X = 2.0 * std::tan(Angle), Distance2 = X * X + 4.0;
		const double Cone = std::clamp((std::cos(Angle) - std::cos(Outer)) / (std::cos(Inner) - std::cos(Outer)), 0.0, 1.0);
		ExpectRadiance("spot", X, 30.0 * Cone * Cone / Distance2 * 2.0 / std::sqrt(Distance2));
	}
}

// Metal and dielectric at all roughnesses under a hard sun; every square shows another BRDF.
TEST_F(FGBufferTest, MaterialsUnderSun)
{
	FTestScene Grid("materials");
	std::vector<FTestScene::FQuad> Quads;
	for (int Column = 0; Column < 5; ++Column)
	{
		for (int Row = 0; Row < 3; ++Row)
		{
			FHostMaterial Material;
			Material.BaseColor = {MakeSrgb(230), MakeSrgb(188), MakeSrgb(124), 1};
			Material.Metallic = 0.5f * float(Row);
			Material.Roughness = 0.15f + 0.2f * float(Column);
			Material.Ior = 1.3f + 0.2f * float(Column);
			Quads.push_back(FTestScene::MakeFloor(Grid.AddMaterial(Material), 0.5f, 0.0f, {float(Column) - 2, float(Row) - 1}));
		}
	}
	Grid.AddNode(Grid.AddMesh(Quads));
	ASSERT_TRUE(Load(std::move(Grid.Scene)));
	SetSun(0.0, 4.0f, {0, -1, -1});
	const FView View = LookAt({0, 3.5, 3.2}, {0, 0, 0}, 0.8f, 160, 96);
	const FImage Raster = RenderLightingFine(View, 4), Reference = TraceReference(View, 64, 1);
	ExpectAgreement("materials under sun", Raster, Reference, 0.01, 0.01);
}

TEST_F(FGBufferTest, RoughnessSceneUnderSun)
{
	REQUIRE_SCENE(Scene, "roughness/scene.gltf");
	ASSERT_TRUE(LoadDark(Scene));
	const FView View = MakeView(160, 90);
	ExpectAgreement("roughness spheres, sun", RenderLightingFine(View, 4), TraceReference(View, 64, 1), 0.02, 0.02);
}

// What shines by itself is seen as bright, in raster and reference.
TEST_F(FGBufferTest, Emission)
{
	FTestScene Glow("glow");
	Glow.AddNode(Glow.AddMesh({FTestScene::MakeFloor(Glow.AddLambert(glm::vec3(0.5f), {3, 200, 0.02}), 1.0f)}));
	ASSERT_TRUE(Load(std::move(Glow.Scene)));
	const FView View = LookAt({0, 2, 1}, {0, 0, 0}, 1.2f, 96, 64);
	const FImage Raster = RenderLightingFine(View, 4), Reference = TraceReference(View, 64, 0);
	ExpectAgreement("emission", Raster, Reference, 0.005, 0.005);
	const FImage Centre = RenderLighting(View);
	EXPECT_NEAR(Centre.At(48, 32, 1), 200.0, 0.2);
}

} // namespace
} // namespace Lantern
