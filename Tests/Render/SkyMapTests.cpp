// A sky that is a texture: the composite's ambient light and the reference against a closed form and against each other.
#include <glm/gtc/packing.hpp>

#include "LanternScene/Memory/Upload.h"
#include "LanternScene/Scene/TextureSlot.h"
#include "Support/OctahedralTexels.h"
#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{

class FSkyMapRenderTest : public FRenderTest
{
protected:
	static constexpr uint32_t MapSize = 128;
	static constexpr float Albedo = 0.5f;

	void TearDown() override
	{
		GetScene().GetScene().SetSkyMap({});
		(void)GetDevice().WaitIdle();
		Map.Reset();
		Sampler.Reset();
		FRenderTest::TearDown();
	}
	/// An octahedral map of GetRadiance(direction), and a wall that faces +x before it.
	template <class FGet>
	void SetMap(FGet GetRadiance)
	{
		const std::vector<glm::vec4> Texels = MakeOctahedralTexels(MapSize, GetRadiance);
		FUploader Uploader(GetDevice());
		const FRTTextureDesc Desc{
		    MapSize, MapSize, 1, 1, ERTFormat::RGBA32_FLOAT, ERTTextureUsage::Sampled | ERTTextureUsage::CopyDest, "SkyMap"};
		ASSERT_OK(Uploader.CreateTexture(Desc, Texels.data(), Map));
		ASSERT_OK(Uploader.Flush());
		FRTSamplerDesc SamplerDesc;
		SamplerDesc.U = SamplerDesc.V = ERTAddress::Clamp;
		ASSERT_OK(GetDevice().CreateSampler(SamplerDesc, Sampler.ReleaseAndGetAddress()));
		FSkyMap Sky;
		Sky.Kind = SKY_MAP_OCTAHEDRAL;
		ASSERT_TRUE(MakeTextureSlot(Map->GetSampledIndex(), Sampler->GetIndex(), Sky.Slot));
		GetScene().GetScene().SetSkyMap(Sky);
	}
	void LoadWall()
	{
		FTestScene Scene("wall");
		const int32_t Wall = Scene.AddLambert(glm::vec3(Albedo), glm::vec3(0), true);
		Scene.AddNode(Scene.AddMesh({{Wall, {{0, -9, 9}, {0, -9, -9}, {0, 9, -9}, {0, 9, 9}}}}));
		ASSERT_TRUE(Load(Scene.Scene));
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(0));
	}
	static FView MakeWallView() { return LookAt({3, 0, 0}, {0, 0, 0}, 0.8f, 24, 24); }
	TRTRef<IRTTexture> Map;
	TRTRef<IRTSampler> Sampler;
};

TEST_F(FSkyMapRenderTest, AmbientLightIsThatOfTheMap)
{
	ASSERT_NO_FATAL_FAILURE(LoadWall());
	// The irradiance of a + b · x on a surface that faces x is π (a + 2/3 b). Under a sky of 1, the wall shows its albedo, which an
	// 8-bit G-buffer has rounded.
	constexpr double Mean = 0.75, Slope = 0.5;
	SetSky(glm::vec3(1));
	const double Shown = MeanGreen(RenderLighting(MakeWallView()));
	ASSERT_NO_FATAL_FAILURE(SetMap([](glm::vec3 D) { return float(Mean + Slope * double(D.x)); }));
	const double Plugin = MeanGreen(RenderLighting(MakeWallView())) / Shown, Expected = Mean + Slope * 2.0 / 3.0;
	PrintFigure(fmt::format("plugin {:.5f}, closed form {:.5f}", Plugin, Expected));
	EXPECT_NEAR(Plugin, Expected, 2e-3 * Expected) << "three bands hold this sky, and 4,096 directions its sum";
	const double Reference = MeanGreen(TraceReference(MakeWallView(), 256)) / double(Albedo);
	PrintFigure(fmt::format("reference {:.5f}", Reference));
	EXPECT_NEAR(Reference, Expected, 1e-2 * Expected) << "noise of 256 samples in 576 pixels is 0.1 %; texels are 1° wide";
	// Seen from behind, the wall faces −x.
	const double Behind = MeanGreen(RenderLighting(LookAt({-3, 0, 0}, {0, 0, 0}, 0.8f, 24, 24)));
	EXPECT_NEAR(Behind / Shown, Mean - Slope * 2.0 / 3.0, 2e-3 * Expected);
}

TEST_F(FSkyMapRenderTest, AUniformMapIsAUniformSky)
{
	ASSERT_NO_FATAL_FAILURE(LoadWall());
	const FView View = LookAt({3, 0, 0}, {0, 0, 0}, 2.8f, 24, 24); // past the wall, too
	SetSky(glm::vec3(0.7f));
	const FImage Said = RenderLighting(View), SaidByPaths = TraceReference(View, 16);
	ASSERT_NO_FATAL_FAILURE(SetMap([](glm::vec3) { return 0.7f; }));
	EXPECT_LE(MaxDifference(Said, RenderLighting(View)), 1e-4) << "on 64 × 64 directions, harmonics are orthogonal to 5e-5";
	EXPECT_LE(MaxDifference(SaidByPaths, TraceReference(View, 16)), 1e-5);
}

} // namespace
} // namespace Lantern
