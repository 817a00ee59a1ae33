// Fog shadows on the mock: what a frame makes for them, and that it makes nothing where nothing has a use for them.
#include "Support/RendererTestTools.h"

#include "FogTypes.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class FFogShadowTest : public FRendererTest
{
protected:
	void SetUp() override
	{
		FRendererTest::SetUp();
		Set("r.RT.Shadow", "0");
		Set("r.RT.AO", "0");
		Set("r.RT.Lights", "0");
		Set("r.Fog.Density", "0.1");
	}
	FRTScene& GetWorld() { return Engine->GetScene().GetScene(); }
	FLightId AddLamp(bool bLightsFog, float Range = 0.0f)
	{
		FSceneLight Light;
		Light.Position = {0, 0, 1};
		Light.Color = glm::vec3(1);
		Light.Range = Range;
		Light.bLightsFog = bLightsFog;
		return GetWorld().AddLight(Light);
	}
	std::vector<std::string> GetFogPasses()
	{
		std::vector<std::string> Names = GetPasses();
		std::erase_if(Names, [](const std::string& Name) { return Name.rfind("FogShadow", 0) != 0; });
		return Names;
	}
	std::vector<FRTMockCall> GetTextures(const char* Begin)
	{
		std::vector<FRTMockCall> Calls = Mock().FindCalls(ERTMockCall::CreateTexture);
		std::erase_if(Calls, [=](const FRTMockCall& Call) { return Call.Name.rfind(Begin, 0) != 0; });
		return Calls;
	}
	/// Whether something of fog shadows was made since the device was opened.
	void ExpectNothing()
	{
		EXPECT_THAT(GetFogPasses(), ElementsAre());
		EXPECT_TRUE(GetTextures("Fog").empty());
		EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(HasSubstr("Fog/Fog"))));
	}
};

TEST_F(FFogShadowTest, ScenesWithoutUseForThemPayNothing)
{
	LoadAndRender({.bSun = false});
	ExpectNothing();
	EXPECT_TRUE(HasPass("HeightFog")) << "fog without light still dims";
	AddLamp(false);
	Render();
	ExpectNothing(); // the one lamp lights no fog
	AddLamp(true);
	Set("r.RT.Fog", "0");
	Render();
	ExpectNothing();
	Set("r.RT.Fog", "1");
	Set("r.RT.Enable", "0");
	Render();
	ExpectNothing();
	Set("r.RT.Enable", "1");
	Set("r.Fog.Density", "0");
	Render();
	ExpectNothing(); // nobody reads them
	EXPECT_FALSE(HasPass("HeightFog"));
	Set("r.Fog.Density", "0.1");
	Render();
	EXPECT_THAT(GetFogPasses(), ElementsAre("FogShadowColumns", "FogShadow", "FogShadowDepth"));
}

TEST_F(FFogShadowTest, FramesThatAreNotReadMakeNone)
{
	ASSERT_TRUE(Load({}));
	Mock().ClearCalls();
	ASSERT_TRUE(Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), 0.0, {}, nullptr));
	EXPECT_THAT(GetFogPasses(), ElementsAre());
}

TEST_F(FFogShadowTest, EachLightHasItsOwnAtlas)
{
	LoadAndRender({});
	EXPECT_FALSE(GetTextures("FogShadowVisibility").empty());
	EXPECT_TRUE(GetTextures("FogShadowLight").empty()) << "there are no lamps";
	EXPECT_FALSE(HasPass("LightCells"));
	Open();
	ASSERT_TRUE(Load({.bSun = false}));
	AddLamp(true);
	Mock().ClearCalls();
	Render();
	EXPECT_TRUE(GetTextures("FogShadowVisibility").empty()) << "there is no sun";
	EXPECT_FALSE(GetTextures("FogShadowLight").empty());
}

TEST_F(FFogShadowTest, AtlasesTakeWhatTheFroxelsTake)
{
	LoadAndRender({});
	// 40 x 24 pixels: 3 x 2 columns of 16, 8 x 8 slices.
	for (const FRTMockCall& Call : GetTextures("FogShadowVisibility"))
	{
		EXPECT_EQ(Call.Numbers[0], 24u);
		EXPECT_EQ(Call.Numbers[1], 16u);
	}
	EXPECT_EQ(GetTextures("FogShadowVisibility").size(), 2u) << "this frame's and the last one's";
	Mock().ClearCalls();
	Set("r.RT.Fog.Slices", "10");
	Set("r.RT.Fog.PixelSize", "7");
	Render();
	for (const FRTMockCall& Call : GetTextures("FogShadowVisibility"))
	{
		EXPECT_EQ(Call.Numbers[0], 24u); // 6 columns, 4 slices
		EXPECT_EQ(Call.Numbers[1], 12u); // 4 rows, 3 rows of slices
	}
}

TEST_F(FFogShadowTest, TheyComeBeforeTheRaster)
{
	LoadAndRender({});
	const std::vector<std::string> Passes = GetPasses();
	const auto Find = [&](const char* Name) { return std::find(Passes.begin(), Passes.end(), Name) - Passes.begin(); };
	EXPECT_LT(Find("FogShadow"), Find("GBuffer"));
	EXPECT_GT(Find("FogShadowDepth"), Find("GBuffer"));
	EXPECT_LT(Find("GBuffer"), std::ptrdiff_t(Passes.size()));
}

// With many lamps, froxels look them up, and pixels need not have asked for cells.
TEST_F(FFogShadowTest, ManyLampsAreLookedUp)
{
	Set("r.RT.Lights.Cells.Least", "1");
	Set("r.RT.LocalLights", "0");
	ASSERT_TRUE(Load({.bSun = false}));
	AddLamp(true, 3.0f);
	for (int Frame = 0; Frame < 3; ++Frame)
	{
		Mock().ClearCalls();
		Render();
		EXPECT_TRUE(HasPass("FogShadow"));
		EXPECT_TRUE(HasPass("LightCells"));
		EXPECT_TRUE(HasPass("LightCellsCount"));
	}
}

TEST_F(FFogShadowTest, DevicesWithEitherKindOfRays)
{
	for (const bool bPipeline : {false, true})
	{
		FRTMockDesc Desc;
		Desc.Rung = bPipeline ? ERTRung::Pipeline : ERTRung::RayQuery;
		Desc.bRayQuery = !bPipeline;
		Open(Desc);
		LoadAndRender({});
		EXPECT_TRUE(HasPass("FogShadow"));
		EXPECT_EQ(Mock().CountCalls(ERTMockCall::TraceRays) > 0, bPipeline);
	}
}

} // namespace
} // namespace Lantern
