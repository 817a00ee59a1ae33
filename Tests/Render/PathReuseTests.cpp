// Paths of diffuse GI that light the pixels around: against pictures whose paths light their own pixels alone, closed forms, sizes that do not
// fit, poison, and the same bits again.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "CachedGIFixture.h"
#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
class FPathReuseTest : public FCachedGITest
{
protected:
	void SetUp() override
	{
		FSignalTest::SetUp();
		SetRoute("3");
		SetVariable("r.RT.GI.Rate", "2");
	}

	/// A floor of ridges, 4 degrees to either side, and a wall beside it.
	static FSceneDescription MakeRidges()
	{
		constexpr int Strips = 96;
		constexpr double Width = 0.04, Height = 0.0028, Half = 2.0;
		FTestScene Scene("ridges");
		const int32_t White = Scene.AddLambert(glm::vec3(0.8f));
		std::vector<FTestScene::FQuad> Quads{{White, {{-2.2, 0, 3}, {-2.2, 0, -3}, {-2.2, 1, -3}, {-2.2, 1, 3}}}};
		for (int Strip = 0; Strip < Strips; ++Strip)
		{
			const double X = (Strip - Strips / 2) * Width, Left = Strip % 2 ? Height : 0.0, Right = Height - Left;
			Quads.push_back({White, {{X, Left, Half}, {X + Width, Right, Half}, {X + Width, Right, -Half}, {X, Left, -Half}}});
		}
		Scene.AddNode(Scene.AddMesh(Quads));
		return FSceneDescription(Scene.Scene);
	}
};

// Le / (1 − ρ) from everywhere: what paths bring is the same for all pixels.
TEST_F(FPathReuseTest, FurnaceOfAllBounces)
{
	ASSERT_TRUE(Load("furnace:0.5"));
	SetVariable("r.RT.Lights.Emissive", "0"); // local lights would have the walls' own light
	const double Mean = MeanGreen(RenderSettled(MakeView(96, 96)));
	PrintFigure(fmt::format("furnace through paths of pixels around {:.4f}", Mean));
	EXPECT_NEAR(Mean, 1.0, 0.01);
}

// The courtyard has folds, edges and contacts. Both pictures have the mean of many frames: what differs is what sharing gets wrong.
TEST_F(FPathReuseTest, TheMeanIsThatOfPathsAlone)
{
	FImage Pictures[2];
	for (const bool bReuse : {false, true})
	{
		ASSERT_TRUE(Load("courtyard"));
		SetVariable("r.RT.GI.Reuse", bReuse ? "1" : "0");
		Pictures[bReuse] = RenderSettled(MakeView(192, 108), 48);
	}
	const double Ratio = MeanGreen(Pictures[1]) / MeanGreen(Pictures[0]);
	PrintFigure(fmt::format("courtyard: mean of shared paths over paths alone {:.4f}", Ratio));
	EXPECT_NEAR(Ratio, 1.0, 0.01);
}

// A frame of shared paths has less noise than one of a path for each pixel of four. The mean of many keeps the ridges. With the planted fault,
// paths light any normal as they light their own.
TEST_F(FPathReuseTest, NoiseFallsAndRidgesStay)
{
	const FView View = LookAt({0, 2, 0.01}, {0, 0, 0}, 0.5f, 96, 96);
	FImage Frames[2], Settled[3];
	FImage Reference;
	const char* const Settings[3][2] = {{"0", "1"}, {"1", "1"}, {"1", "0"}};
	for (int I = 0; I < 3; ++I)
	{
		ASSERT_TRUE(Load(MakeRidges()));
		SetSun(0.0, 10.0f, {-1, -0.4, 0}); // the wall shines on the ridges
		SetVariable("r.RT.GI.Reuse", Settings[I][0]);
		SetVariable("r.RT.Debug.GI.ReuseCosine", Settings[I][1]);
		if (I == 0) { Reference = TraceSignal(ESignal::DiffuseGI, View, 1024, 5); }
		Settled[I] = RenderSettled(View, 256);
		if (I < 2) { Frames[I] = RenderSignal(ESignal::DiffuseGI, View, 1, WarmFrames + 256); }
	}
	const double Alone = RelativeError(Frames[0], Reference), Shared = RelativeError(Frames[1], Reference);
	const double Kept = RelativeError(Settled[1], Reference), Fault = RelativeError(Settled[2], Reference);
	PrintFigure(fmt::format("ridges: error of a frame, paths alone {:.4f}, shared {:.4f}", Alone, Shared));
	PrintFigure(fmt::format("ridges: error of 256 frames, alone {:.4f}, shared {:.4f}, with the planted fault {:.4f}",
	    RelativeError(Settled[0], Reference), Kept, Fault));
	EXPECT_LT(Shared, 0.75 * Alone);
	EXPECT_LT(Kept, 0.6 * Fault) << "the planted fault must be seen";
}

TEST_F(FPathReuseTest, AnySizeAndRate)
{
	ASSERT_TRUE(Load("sphere:0.5"));
	for (const auto& [Width, Height] : {std::pair(1u, 1u), std::pair(131u, 73u), std::pair(16u, 300u)})
	{
		for (const char* const Rate : {"0", "1", "2"})
		{
			for (const char* const Path : {"1", "2"}) // pipeline, queries
			{
				// Queries differ in what launches them, not in the rate. Each pair is compiled by itself.
				if (*Path == '2' && *Rate != '2') { continue; }
				SetVariable("r.RT.GI.Rate", Rate);
				SetVariable("r.RT.GI.Path", Path);
				const FImage Picture = RenderSettled(MakeView(Width, Height), 1, 24);
				EXPECT_EQ(CountNonFinitePixels(Picture), 0u) << Width << " x " << Height << ", rate " << Rate;
				EXPECT_GT(MeanGreen(Picture), 0.0) << Width << " x " << Height << ", rate " << Rate;
			}
		}
	}
}

// What a filter keeps of colours, poisoned: their means, what is known of their noise, and where they lie.
TEST_F(FPathReuseTest, PoisonIsGoneAndReachesNoPicture)
{
	SetVariable("r.RT.GI.Denoise", "1");
	for (const char* const History : {"DiffuseGIHistory", "DiffuseGIMoments", "Surface", "Anchors"})
	{
		ASSERT_TRUE(Load("sphere:0.5"));
		const FView View = MakeView(48, 48);
		RenderSettled(View, 1);
		GetEngine().GetRenderer().GetGraphResources().PoisonHistory(History);
		const FImage Picture = RenderSignal(ESignal::DiffuseGI, View, 8, WarmFrames + 1);
		EXPECT_EQ(CountNonFinitePixels(Picture), 0u) << History;
		EXPECT_NEAR(MeanGreen(Picture) / (10000.0 / 96.0 / std::numbers::pi), 1.0, 0.05) << History;
	}
}

TEST_F(FPathReuseTest, TheSameBitsAgain)
{
	ASSERT_TRUE(Load("courtyard")); // which the view is of
	ExpectTheSameBitsAgain("courtyard", MakeView(64, 36));
}
} // namespace

} // namespace Lantern
