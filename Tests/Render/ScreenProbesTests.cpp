// Diffuse GI by screen probes: closed forms, short rays of pixels against brute force, sizes that do not fit, poison, and the same bits again.
#include <algorithm>
#include <cmath>

#include "CachedGIFixture.h"
#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{

class FScreenProbesTest : public FCachedGITest
{
protected:
	void SetUp() override
	{
		FSignalTest::SetUp();
		SetRoute("2");
		SetVariable("r.RT.GI.Probes.Spacing", "8"); // pictures here are small
	}
};

// Le / (1 − ρ) from everywhere. Probes of other walls stand in near the edges of the room, and lack what they cannot see.
TEST_F(FScreenProbesTest, FurnaceOfAllBounces)
{
	ASSERT_TRUE(Load("furnace:0.5"));
	SetVariable("r.RT.Lights.Emissive", "0"); // local lights would have the walls' own light
	const double Mean = MeanGreen(RenderSettled(MakeView(96, 96)));
	PrintFigure(fmt::format("furnace through screen probes {:.4f}", Mean));
	EXPECT_NEAR(Mean, 1.0, 0.02);
}

// Φ/S ρ / (1 − ρ) / π. Faces of the sphere bend away from those of their probes. With the planted fault, what a probe does not see is dark.
TEST_F(FScreenProbesTest, SphereOfAllBounces)
{
	const double Expected = 10000.0 / 96.0 / Pi; // ρ / (1 − ρ) is 1
	double Ratios[2];
	for (const bool bUnseen : {true, false})
	{
		ASSERT_TRUE(Load("sphere:0.5"));
		SetVariable("r.RT.Debug.GI.Unseen", bUnseen ? "1" : "0");
		SetVariable("r.RT.GI.Probes.Near", "0"); // short rays would find what is missing
		Ratios[bUnseen] = MeanGreen(RenderSettled(MakeView(96, 96))) / Expected;
		PrintFigure(fmt::format("sphere through screen probes, what is not seen stood in for {}: {:.4f}", bUnseen, Ratios[bUnseen]));
	}
	EXPECT_NEAR(Ratios[1], 1.0, 0.02);
	EXPECT_LT(Ratios[0], Ratios[1] - 0.005) << "the planted fault must be seen";
}

// A square that shines on another is a few texels wide: half the form factor. The planted fault weighs texels alike.
TEST_F(FScreenProbesTest, FormFactorOfASquare)
{
	double Ratios[2];
	for (const bool bSolidAngle : {true, false})
	{
		ASSERT_TRUE(Load("formfactors"));
		SetVariable("r.RT.Lights.Emissive", "0");
		SetVariable("r.RT.Debug.GI.SolidAngle", bSolidAngle ? "1" : "0");
		const FView View = MakeView(96, 96);
		const double Reference = MeanGreen(TraceSignal(ESignal::DiffuseGI, View, 64, 3));
		Ratios[bSolidAngle] = MeanGreen(RenderSettled(View)) / Reference;
		PrintFigure(
		    fmt::format("square through screen probes, solid angles {}: mean / reference {:.4f}", bSolidAngle, Ratios[bSolidAngle]));
	}
	EXPECT_NEAR(Ratios[1], 1.0, 0.06) << "a texel is 0.4 rad wide, and the square 0.8";
	EXPECT_GT(Ratios[0], 1.1) << "the planted fault must be seen";
}

// Under a table, pixels are darker than the probes around them know.
TEST_F(FScreenProbesTest, ShortRaysBringContactShadowsBack)
{
	FTestScene Scene("table");
	const int32_t White = Scene.AddLambert(glm::vec3(0.6f));
	const auto Board = [&](float Height) {
		return FTestScene::FQuad{White, {{-0.3, Height, 0.3}, {0.3, Height, 0.3}, {0.3, Height, -0.3}, {-0.3, Height, -0.3}}};
	};
	FTestScene::FQuad Below = Board(0.1f);
	std::reverse(std::begin(Below.P), std::end(Below.P));
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(White, 8.0f), Board(0.12f), Below}));
	double Errors[2];
	for (const bool bNear : {true, false})
	{
		ASSERT_TRUE(Load(FSceneDescription(Scene.Scene)));
		SetSky(glm::vec3(1));
		SetVariable("r.RT.GI.Probes.Spacing", "16");
		SetVariable("r.RT.GI.Probes.Near", bNear ? "4" : "0");
		const FView View = LookAt({0, 1.2, 2.4}, {0, 0, 0}, 0.5f, 128, 72);
		const FImage Reference = TraceSignal(ESignal::DiffuseGI, View, 512, 5);
		const std::vector<double> Ours = ComputeBlockMeans(RenderSettled(View, 64), 4), Theirs = ComputeBlockMeans(Reference, 4);
		double Sum = 0.0;
		for (size_t Block = 0; Block < Ours.size(); ++Block) { Sum += std::abs(Ours[Block] - Theirs[Block]); }
		Errors[bNear] = Sum / double(Ours.size());
		PrintFigure(fmt::format("table on a floor, short rays {}: mean error of blocks {:.4f}", bNear, Errors[bNear]));
	}
	EXPECT_LT(Errors[1], 0.75 * Errors[0]);
}

TEST_F(FScreenProbesTest, AnySizeAndSpacing)
{
	ASSERT_TRUE(Load("sphere:0.5"));
	for (const auto& [Width, Height] : {std::pair(1u, 1u), std::pair(131u, 73u), std::pair(16u, 300u)})
	{
		for (const char* const Spacing : {"8", "17", "32"})
		{
			for (const char* const Path : {"1", "2"}) // pipeline, queries
			{
				SetVariable("r.RT.GI.Probes.Spacing", Spacing);
				SetVariable("r.RT.GI.Path", Path);
				const FImage Picture = RenderSettled(MakeView(Width, Height), 1, 24);
				EXPECT_EQ(CountNonFinitePixels(Picture), 0u) << Width << " x " << Height << ", " << Spacing;
				EXPECT_GT(MeanGreen(Picture), 0.0) << Width << " x " << Height << ", " << Spacing;
			}
		}
	}
}

TEST_F(FScreenProbesTest, PoisonIsGoneAndReachesNoPicture)
{
	ASSERT_TRUE(Load("sphere:0.5"));
	const FView View = MakeView(48, 48);
	RenderSettled(View, 1);
	GetEngine().GetRenderer().GetGraphResources().PoisonHistory("ScreenProbes");
	const FImage Picture = RenderSignal(ESignal::DiffuseGI, View, 1, WarmFrames + 1);
	EXPECT_EQ(CountNonFinitePixels(Picture), 0u);
	EXPECT_NEAR(MeanGreen(Picture) / (10000.0 / 96.0 / Pi), 1.0, 0.03);
}

TEST_F(FScreenProbesTest, TheSameBitsAgain)
{
	REQUIRE_SCENE(Scene, "cornell/cornell.gltf");
	const FView View = LookAt({0, 1, 3.4}, {0, 1, 0}, 0.7f, 64, 64);
	ExpectTheSameBitsAgain(Scene, View);
}

} // namespace

} // namespace Lantern
