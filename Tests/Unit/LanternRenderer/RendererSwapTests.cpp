// What the renderer tells the compiler of pipelines about its frames, so that the compiler knows what swaps cost.
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

using FRendererSwapTest = FRendererTest;

TEST_F(FRendererSwapTest, CompilerLearnsWhatAFirstUseCosts)
{
	Set("r.RT.Shadow.Path", "1");
	Mock().SlowFirstUse(500);
	ASSERT_TRUE(Load({.bSun = true}));
	for (int Frame = 0; Frame < 4; ++Frame) { ASSERT_NO_FATAL_FAILURE(Render()); }
	EXPECT_NEAR(Engine->GetRenderer().GetRayCompiler().GetStats().LastSwapMs, 500.0, 1.0);
	// A frame that is not a first one costs nothing more; one that is does so again.
	Mock().SlowFirstUse(200);
	Set("r.RT.AO", "0");
	Set("r.RT.Shadow.Samples", "2");
	for (int Frame = 0; Frame < 4; ++Frame) { ASSERT_NO_FATAL_FAILURE(Render()); }
	EXPECT_NEAR(Engine->GetRenderer().GetRayCompiler().GetStats().LastSwapMs, 200.0, 1.0);
}

} // namespace
} // namespace Lantern
