// The host's shadow map on the mock: what it costs, and that it costs nothing where there is none.
#include <cstring>

#include "HostShadowTypes.h"
#include "Support/RendererTestTools.h"
#include "TileTypes.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class FHostShadowTest : public FRendererTest
{
protected:
	/// Names of all that was made and run since the device was opened.
	std::vector<std::string> GetNames()
	{
		std::vector<std::string> Names = Mock().GetCreatedPipelines();
		for (const std::string& Name : Mock().GetCreatedBuffers()) { Names.push_back(Name); }
		for (const std::string& Name : Mock().GetCreatedTextures()) { Names.push_back(Name); }
		for (const std::string& Name : GetPasses()) { Names.push_back(Name); }
		return Names;
	}
	FTilesConstants GetTilesConstants()
	{
		FTilesConstants Constants{};
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::Dispatch))
		{
			if (Call.Name.rfind("Tiles/Tiles.comp", 0) == 0) { std::memcpy(&Constants, Call.Bytes.data(), sizeof(Constants)); }
		}
		return Constants;
	}
};

TEST_F(FHostShadowTest, WithoutAMapNothingIsThere)
{
	LoadAndRender({});
	for (const std::string& Name : GetNames())
	{
		EXPECT_THAT(Name, Not(HasSubstr("HostShadow")));
		EXPECT_THAT(Name, Not(HasSubstr("HAS_HOST_SHADOW")));
		EXPECT_THAT(Name, Not(HasSubstr("Pyramid")));
		EXPECT_THAT(Name, Not(HasSubstr("ShadowMap")));
	}
	EXPECT_EQ(GetTilesConstants().HostShadow, 0u);
	EXPECT_EQ(GetTilesConstants().SunMask, GetTilesConstants().LitMask);
}

TEST_F(FHostShadowTest, WithoutASunThereIsNoMap)
{
	Set("r.RT.HostShadow", "3");
	LoadAndRender({.bSun = false});
	for (const std::string& Name : GetNames()) { EXPECT_THAT(Name, Not(HasSubstr("HostShadow"))); }
}

// The raster of the map is the sample engine's. It runs if a pass of the plugin reads it.
TEST_F(FHostShadowTest, NobodyReadsTheMapOfShadowsThatAreOff)
{
	Set("r.RT.HostShadow", "3");
	Set("r.RT.Shadow", "0");
	LoadAndRender({});
	EXPECT_FALSE(HasPass("HostShadowMap"));
	EXPECT_FALSE(HasPass("HostShadowPyramid"));
}

TEST_F(FHostShadowTest, RaysLeaveCastersToTheMap)
{
	Set("r.RT.HostShadow.Resolution", "64");
	const std::pair<const char*, std::pair<uint32_t, uint32_t>> Cases[] = {{"1", {MASK_SUN_CASTERS, MASK_SUN_CASTERS}},
	    {"2", {MASK_SUN_CASTERS, MASK_SUN_MOVING | MASK_CHARACTER}}, {"3", {MASK_SUN_CASTERS, 0}},
	    {"4", {MASK_SUN_CASTERS, MASK_SUN_CASTERS}}};
	for (const auto& [Casters, Masks] : Cases)
	{
		Set("r.RT.HostShadow", Casters);
		Mock().ClearCalls();
		LoadAndRender({});
		if (*Casters == '1') { EXPECT_THAT(Mock().GetCreatedPipelines(), Contains(HasSubstr("HAS_HOST_SHADOW"))); }
		EXPECT_TRUE(HasPass("HostShadowPyramid")) << Casters;
		const FTilesConstants Constants = GetTilesConstants();
		EXPECT_NE(Constants.HostShadow, 0u) << Casters;
		EXPECT_EQ(Constants.SunMask, Masks.first) << Casters;
		EXPECT_EQ(Constants.LitMask, Masks.second) << Casters;
	}
}

// 64 texels: cells of 4, 8, 16, 32 and 64 texels, in each of four cascades.
TEST_F(FHostShadowTest, PyramidHasItsSize)
{
	Set("r.RT.HostShadow", "3");
	Set("r.RT.HostShadow.Resolution", "64");
	LoadAndRender({});
	uint64_t Bytes = 0;
	for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::CreateBuffer))
	{
		if (Call.Name == "HostShadowPyramid") { Bytes = Call.Numbers[0]; }
	}
	EXPECT_EQ(Bytes, 4 * (16 * 16 + 8 * 8 + 4 * 4 + 2 * 2 + 1) * sizeof(vec2));
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::Dispatch, "Tiles/Pyramid.comp"), 2u) << "four levels at a time";
	Set("r.RT.HostShadow.Cascades", "2");
	Render();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BeginMarker, "HostShadowMap"), 2u);
}

TEST_F(FHostShadowTest, PrecacheKnowsIt)
{
	Set("r.RT.HostShadow", "3");
	ASSERT_TRUE(Load({}));
	FConsoleVariables::Get().BeginFrame(); // as the engine does before it asks
	FFrameCapture Capture;
	Capture.Signals.Add(ESignal::SunShadow);
	ASSERT_TRUE(Engine->Precache(Capture, {}));
	EXPECT_THAT(Mock().GetCreatedPipelines(), Contains(HasSubstr("Tiles/Pyramid.comp")));
	EXPECT_THAT(Mock().GetCreatedPipelines(), Contains(HasSubstr("ShadowMap")));
}

} // namespace
} // namespace Lantern
