// Camera paths through scenes built by code: where they may go, and which frames are for what.
#include <cmath>

#include <gtest/gtest.h>

#include "LanternHost/BuiltinScenes.h"
#include "LanternImage/ImageEncode.h"
#include "LanternMeasure/MeasurePaths.h"

namespace Lantern
{
namespace
{

FSceneDescription Build(const char* Name)
{
	FLoadResult Loaded = BuildBuiltinScene(Name);
	EXPECT_TRUE(Loaded.Scene) << Loaded.Error;
	return std::move(*Loaded.Scene);
}

FView FindCamera(const FSceneDescription& Scene, const FScenePose& Pose)
{
	for (size_t Node = 0; Node < Scene.Nodes.size(); ++Node)
	{
		if (Scene.Nodes[Node].Camera < 0) { continue; }
		const glm::dmat4& World = Pose.World[Node];
		return LookAt(glm::dvec3(World[3]), glm::dvec3(World[3] - World[2]), Scene.Cameras[Scene.Nodes[Node].Camera].FovY, 320, 180);
	}
	ADD_FAILURE() << "no camera";
	return {};
}

TEST(MeasurePaths, RaysHitWhatIsThere)
{
	const FSceneDescription Scene = Build("furnace"); // a room from (−2, 0, −2) to (2, 3, 2)
	const FSceneRays Rays(Scene, EvaluatePose(Scene, 0.0));
	EXPECT_NEAR(Rays.Trace({1.5, 2.5, 1.5}, {0, 1, 0}), 0.5, 1e-6);
	EXPECT_NEAR(Rays.Trace({1.5, 2.5, 1.5}, {0, 2, 0}), 0.25, 1e-6);
	EXPECT_NEAR(Rays.Trace({1.5, 2.5, 1.5}, {0, -1, 0}), 2.5, 1e-6);
	EXPECT_NEAR(Rays.Trace({-0.7, 2.5, -0.9}, {0, -1, 0}), 0.9, 1e-6); // the box of 1.6 m
	EXPECT_TRUE(std::isinf(Rays.Trace({10, 1, 0}, {1, 0, 0})));
}

TEST(MeasurePaths, ViewsSeeSomethingAndPassThroughNothing)
{
	for (const char* Name : {"furnace", "penumbra", "planes", "disk"})
	{
		SCOPED_TRACE(Name);
		const FSceneDescription Scene = Build(Name);
		const FScenePose Pose = EvaluatePose(Scene, 1.0);
		const FMeasureViews Views = FindMeasureViews(Scene, Pose, FindCamera(Scene, Pose));
		const FSceneRays Rays(Scene, Pose);
		EXPECT_TRUE(Views.PanRadians != 0.0 || glm::length(Views.Travel) > 0.0);
		EXPECT_TRUE(Views.PanRadians != 0.0 || Rays.Trace(Views.Home.Position, Views.Travel) >= 1.999);
		const FView Start = Views.GetView(1.0), Home = Views.GetView(0.0);
		EXPECT_EQ(Home.Position, Views.Home.Position);
		EXPECT_NEAR(glm::distance(glm::normalize(Home.Forward), Views.Home.Forward), 0.0f, 1e-5f);
		EXPECT_TRUE(std::isfinite(Rays.Trace(Home.Position, glm::dvec3(Home.Forward))));
		EXPECT_TRUE(std::isfinite(Rays.Trace(Start.Position, glm::dvec3(Start.Forward))));
		EXPECT_GT(glm::distance(Start.Position, Home.Position) + glm::distance(Start.Forward, Home.Forward), 1e-3);
		EXPECT_GT(
		    glm::distance(Views.Cut.Position, Home.Position) + glm::distance(glm::normalize(Views.Cut.Forward), Views.Home.Forward), 0.1);
	}
}

class Scripts : public testing::Test
{
protected:
	void SetUp() override
	{
		Views.Home = LookAt({0, 1, 5}, {0, 1, 0}, 1.0f, 32, 18);
		Views.Focus = {0, 1, 0};
		Views.Travel = {2, 0, 0};
		Views.Cut = LookAt({5, 1, 0}, {0, 1, 0}, 1.0f, 32, 18);
	}
	FMeasureViews Views;
	FPathSettings Settings;
};

TEST_F(Scripts, EveryPathIsJudgedFromHomeAtOneTime)
{
	for (size_t I = 0; I < static_cast<size_t>(EMeasurePath::Count); ++I)
	{
		const FPathScript Path = MakePathScript(static_cast<EMeasurePath>(I), Views, Settings, nullptr);
		SCOPED_TRACE(GetPathName(static_cast<EMeasurePath>(I)));
		EXPECT_GE(Path.TimedCount, 20u);
		EXPECT_GE(Path.FirstTimed, 10u);
		EXPECT_LE(Path.FirstTimed + Path.TimedCount, Path.Script.size());
		ASSERT_FALSE(Path.ErrorFrames.empty());
		EXPECT_EQ(Path.PictureFrame, Path.ErrorFrames.back());
		for (const uint32_t Frame : Path.ErrorFrames)
		{
			EXPECT_EQ(Path.Script[Frame].View.Position, Views.Home.Position);
			EXPECT_EQ(Path.Script[Frame].Time, Settings.Time);
			EXPECT_TRUE(Path.Script[Frame].bCapture);
			EXPECT_GE(Frame, Path.FirstTimed);
		}
		for (const FScriptFrame& Frame : Path.Script)
		{
			EXPECT_GE(Frame.Time, 0.0);
			EXPECT_EQ(Frame.View.DeltaSeconds, Settings.DeltaSeconds);
		}
	}
}

TEST_F(Scripts, FastIsTenTimesAsFastAsSlow)
{
	const FPathScript Slow = MakePathScript(EMeasurePath::Slow, Views, Settings, nullptr),
	                  Fast = MakePathScript(EMeasurePath::Fast, Views, Settings, nullptr);
	const auto GetStep = [](const FPathScript& Path) { return glm::distance(Path.Script[0].View.Position, Path.Script[1].View.Position); };
	EXPECT_NEAR(GetStep(Fast), 10.0 * GetStep(Slow), 1e-9);
	EXPECT_NEAR(GetStep(Fast), 2.0 / 36.0, 1e-6); // all of the way in 0.6 s
	EXPECT_FALSE(Slow.GhostFrame);
	// Still in motion where a ghost would come from, still when it is looked for.
	EXPECT_NE(Fast.Script[*Fast.BeforeFrame].View.Position, Views.Home.Position);
	EXPECT_EQ(Fast.Script[*Fast.GhostFrame].View.Position, Views.Home.Position);
	EXPECT_EQ(*Fast.GhostFrame - Fast.PictureFrame, FPathScript::SettleFrames);
}

TEST_F(Scripts, CutIsToldAndOnlyThere)
{
	const FPathScript Cut = MakePathScript(EMeasurePath::Cut, Views, Settings, nullptr);
	uint32_t Cuts = 0;
	for (const FScriptFrame& Frame : Cut.Script) { Cuts += Frame.View.bCut ? 1 : 0; }
	EXPECT_EQ(Cuts, 1u);
	EXPECT_TRUE(Cut.Script[Cut.ErrorFrames.front()].View.bCut);
	EXPECT_EQ(Cut.Script[*Cut.BeforeFrame].View.Position, Views.Cut.Position);
	EXPECT_EQ(*Cut.GhostFrame - *Cut.BeforeFrame, FPathScript::SettleFrames);
}

TEST(ImageEncode, Base64)
{
	// RFC 4648, 10
	EXPECT_EQ(EncodeBase64(""), "");
	EXPECT_EQ(EncodeBase64("f"), "Zg==");
	EXPECT_EQ(EncodeBase64("fo"), "Zm8=");
	EXPECT_EQ(EncodeBase64("foo"), "Zm9v");
	EXPECT_EQ(EncodeBase64("foobar"), "Zm9vYmFy");
	EXPECT_EQ(EncodeBase64("\xff\xfe"), "//4=");
}

TEST(ImageEncode, PicturesHaveTheirFormat)
{
	FImage Image(5, 3, 1);
	Image.Pixels[3] = NAN;
	EXPECT_EQ(EncodeJpeg(Image).substr(0, 3), "\xff\xd8\xff");
	EXPECT_EQ(EncodePng(Image).substr(0, 4), "\x89PNG");
	EXPECT_EQ(EncodeJpeg(FImage()), "");
}

TEST(ImageEncode, ShrinkingTakesMeans)
{
	FImage Image(4, 2, 1);
	for (uint32_t I = 0; I < 8; ++I) { Image.Pixels[I] = float(I); }
	const FImage Small = ShrinkImage(Image, 2);
	ASSERT_EQ(Small.Width, 2u);
	ASSERT_EQ(Small.Height, 1u);
	EXPECT_EQ(Small.Pixels[0], 2.5f); // 0 1 4 5
	EXPECT_EQ(Small.Pixels[1], 4.5f);
	EXPECT_EQ(ShrinkImage(Image, 4).Width, 4u);
}

} // namespace
} // namespace Lantern
