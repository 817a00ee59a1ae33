// The half frame on the mock: what it adds, and that signals share it. It adds nothing where no signal is of half the resolution.
#include "Support/RendererTestTools.h"
#include "Support/WaitTools.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class FHalfFrameMockTest : public FRendererTest
{
protected:
	void SetUp() override
	{
		FRendererTest::SetUp();
		Set("r.RT.AO", "0");
	}
	size_t CountPass(const char* Name)
	{
		const std::vector<std::string> Names = GetPasses();
		return static_cast<size_t>(std::count(Names.begin(), Names.end(), Name));
	}
};

TEST_F(FHalfFrameMockTest, WithoutASignalOfItsThereIsNone)
{
	Set("r.RT.GI", "3");
	LoadAndRender({.bLights = true, .bSky = true});
	EXPECT_FALSE(HasPass("HalfFrame"));
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(HasSubstr("HalfFrame/"))));
	Set("r.RT.Lights.HalfResolution", "1");
	Set("r.RT.Lights", "0");
	Render();
	EXPECT_FALSE(HasPass("HalfFrame")) << "there are no lamps' shadows";
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(HasSubstr("HalfFrame/"))));
	Open();
	Set("r.RT.Lights", "1");
	LoadAndRender({.bSky = true});
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(HasSubstr("HalfFrame/")))) << "there are no lamps";
}

TEST_F(FHalfFrameMockTest, LampsHaveAQueueOfTheirOwn)
{
	Set("r.RT.Lights.HalfResolution", "1");
	LoadAndRender({.bLights = true});
	for (const char* const Pass : {"HalfFrame", "ShadowHalfLights", "ShadowHalfRays", "ShadowLightsUpsample"})
	{
		EXPECT_EQ(CountPass(Pass), 1u) << Pass;
	}
	EXPECT_TRUE(HasPass("ShadowTiles")) << "the sun has all pixels";
	EXPECT_TRUE(HasPass("ShadowRays"));
	EXPECT_FALSE(HasPass("ShadowLights"));
	Set("r.RT.Lights.HalfResolution", "0");
	Render();
	EXPECT_FALSE(HasPass("HalfFrame"));
	EXPECT_TRUE(HasPass("ShadowLights"));
}

TEST_F(FHalfFrameMockTest, SignalsShareIt)
{
	Set("r.RT.Lights.HalfResolution", "1");
	Set("r.RT.GI.HalfResolution", "1");
	Set("r.RT.GI", "3");
	LoadAndRender({.bLights = true, .bSky = true});
	for (const char* const Pass : {"HalfFrame", "ShadowLightsUpsample", "DiffuseGIUpsample", "RadianceCellsCommit"})
	{
		EXPECT_EQ(CountPass(Pass), 1u) << Pass;
	}
	Set("r.RT.GI", "2"); // probes are few by themselves
	Render();
	EXPECT_TRUE(HasPass("HalfFrame"));
	EXPECT_FALSE(HasPass("DiffuseGIUpsample"));
	EXPECT_TRUE(HasPass("DiffuseGI"));
}

// The display has all pixels: Render says so.
TEST_F(FHalfFrameMockTest, ItsDebugPicturesAreEnlarged)
{
	Set("r.RT.Lights.HalfResolution", "1");
	for (const char* const View : {"LocalDiffuse.confidence", "LocalSpecular.change", "lamp_rays", "local_diffuse"})
	{
		Set("r.RT.Debug.View", View);
		ASSERT_NO_FATAL_FAILURE(LoadAndRender({.bLights = true})) << View;
		EXPECT_TRUE(HasPass("DebugView")) << View;
	}
}

TEST_F(FHalfFrameMockTest, ALightMaskNeedsAllPixels)
{
	Set("r.RT.Lights.HalfResolution", "1");
	Engine->Signals.bLightMask = true;
	LoadAndRender({.bLights = true});
	EXPECT_FALSE(HasPass("HalfFrame"));
	EXPECT_TRUE(HasPass("ShadowLights"));
}

TEST_F(FHalfFrameMockTest, ItsHistoriesAreFreedWithThoseOfTheView)
{
	Set("r.RT.Shadow", "0");
	Set("r.RT.Lights.HalfResolution", "1");
	LoadAndRender({.bLights = true});
	FRenderer& Renderer = Engine->GetRenderer();
	const uint64_t Half = Renderer.GetHistoryBytes();
	EXPECT_GT(Half, 0u);
	ASSERT_TRUE(Renderer.WaitForAll());
	Renderer.ClearHistories();
	EXPECT_EQ(Renderer.GetHistoryBytes(), 0u);
	Set("r.RT.Lights.HalfResolution", "0");
	Render();
	EXPECT_GT(Renderer.GetHistoryBytes(), 2 * Half) << "those of all pixels are larger";
}

// A picture keeps its indirect light of all pixels while shaders of the half frame are compiled.
TEST_F(FHalfFrameMockTest, TheWholeFrameServesUntilItsShadersAreReady)
{
	Set("r.RT.GI", "3");
	LoadAndRender({.bLights = true, .bSky = true});
	Engine->bRealTime = true;
	Mock().HoldCompiles("HalfFrame");
	Set("r.RT.GI.HalfResolution", "1");
	Set("r.RT.Lights.HalfResolution", "1");
	const auto Frame = [&] {
		ASSERT_NO_FATAL_FAILURE(Render());
		EXPECT_TRUE(HasPass("DiffuseGI"));
		EXPECT_NE(HasPass("ShadowLights"), HasPass("ShadowHalfLights"));
		GiveWay();
	};
	{
		const FHangGuard Guard("frames while shaders are compiled", [&] { Mock().ClearCompileFaults(); });
		ASSERT_TRUE(WaitUntil(
		    "a compile in the driver", [&] { return Mock().GetCompilesInDriver() > 0; }, Frame));
		for (int I = 0; I < 3; ++I) { ASSERT_NO_FATAL_FAILURE(Frame()); }
		EXPECT_FALSE(HasPass("HalfFrame"));
	}
	Mock().ClearCompileFaults();
	ASSERT_TRUE(WaitUntil(
	    "the half frame", [&] { return HasPass("DiffuseGIUpsample") && HasPass("ShadowHalfLights"); }, Frame));
}

} // namespace
} // namespace Lantern
