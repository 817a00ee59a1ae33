// Signals of the half frame (r.RT.Lights.HalfResolution, r.RT.GI.HalfResolution) against those of all pixels. Views, edges, odd sizes, motion,
// paths that agree, poison, and planted faults.
#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "HalfFrame/HalfFrame.h"
#include "SignalFixture.h"

namespace Lantern
{

namespace
{
class FHalfFrameTest : public FSignalTest
{
protected:
	void SetUp() override
	{
		FSignalTest::SetUp();
		SetVariable("r.RT.Lights.Denoise", "0");
		SetVariable("r.RT.Shadow", "0");
		SetVariable("r.RT.AO", "0");
	}
	static void SetHalf(bool bHalf)
	{
		for (const char* const Name : {"r.RT.Lights.HalfResolution", "r.RT.GI.HalfResolution"}) { SetVariable(Name, bHalf ? "1" : "0"); }
	}
	/// A floor behind posts, lit from one side: the posts' fronts are dark. Radius: of the lamps; 0: points.
	void LoadPosts(float Radius)
	{
		FTestScene Scene("posts");
		FHostMaterial Glossy;
		Glossy.BaseColor = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
		Glossy.Metallic = 0.0f;
		Glossy.Roughness = 0.6f;
		const int32_t Paint = Scene.AddMaterial(Glossy), Both = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Paint, 8.0f)}));
		const int32_t Post = Scene.AddMesh({{Both, {{-0.15f, 0, 0}, {0.15f, 0, 0}, {0.15f, 1.0f, 0}, {-0.15f, 1.0f, 0}}}});
		for (int I = 0; I < 6; ++I)
		{
			Scene.AddNode(Post, glm::translate(glm::dmat4(1), glm::dvec3(-1.9 + 0.75 * I, 0, I % 2 == 0 ? 0.3 : -0.7)));
		}
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(0));
		for (const double X : {-1.0, 0.2, 1.5}) { GetScene().GetScene().AddLight(MakeLamp({X, 1.2, -2.5}, glm::vec3(4.0f), Radius)); }
	}
	/// A floor, seen from above, under a white sky.
	void LoadOpenFloor()
	{
		FTestScene Scene("floor");
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0.5f)), 50.0f)}));
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(1));
		SetVariable("r.RT.GI", "3");
		SetVariable("r.RT.GI.Cells.Capacity", "65536");
		SetVariable("r.RT.Reflections", "0");
	}
	static FView LookAtPosts(uint32_t Width, uint32_t Height, double Aside = 0.0)
	{
		return LookAt({Aside, 2.2, 3.6}, {Aside, 0.2, 0}, 0.9f, Width, Height);
	}
	/// Share of pixels that differ by more than a fifth of the mean.
	static double CountOthers(const FImage& A, const FImage& B)
	{
		const double Limit = 0.2 * MeanGreen(B);
		size_t Others = 0;
		for (size_t I = 1; I < A.Pixels.size(); I += A.Channels)
		{
			Others += std::abs(double(A.Pixels[I]) - double(B.Pixels[I])) > Limit ? 1 : 0;
		}
		return double(Others) / double(A.GetPixelCount());
	}
	static double MeanSquareError(const FImage& A, const FImage& B)
	{
		double Sum = 0.0;
		for (size_t I = 1; I < A.Pixels.size(); I += A.Channels)
		{
			const double Off = double(A.Pixels[I]) - double(B.Pixels[I]);
			Sum += Off * Off;
		}
		return Sum / double(A.GetPixelCount());
	}
	/// The last of Count frames of a camera that moves aside by Step metres in each, and ends at LookAtPosts.
	FImage RenderMoving(ESignal Signal, uint32_t Width, uint32_t Height, double Step, uint32_t Count)
	{
		GetEngine().SetFrameIndex(0);
		FCapturedFrame Captured;
		for (uint32_t Frame = 0; Frame < Count; ++Frame)
		{
			FView View = LookAtPosts(Width, Height, Step * (double(Frame) - double(Count - 1)));
			View.bCut = Frame == 0;
			FFrameCapture Capture;
			Capture.Signals.Add(Signal);
			EXPECT_OK(GetEngine().RenderFrame(View, 0.0, Capture, &Captured));
		}
		return Captured.Get(Signal);
	}
};

TEST_F(FHalfFrameTest, ItsPixelsLookWhereTheirFirstOnesDo)
{
	for (const glm::uvec2 Size : {glm::uvec2(64, 36), glm::uvec2(131, 73), glm::uvec2(1, 1), glm::uvec2(2, 3)})
	{
		FView View = LookAt({1, 2, 3}, {4, 1, -2}, 0.8f, Size.x, Size.y);
		View.Window = FViewWindow{-0.7, 0.4, -0.2, 0.5, false};
		View.Jitter = {0.3f, -0.4f};
		const FView Half = MakeHalfView(View);
		EXPECT_EQ(glm::uvec2(Half.Width, Half.Height), (Size + 1u) / 2u);
		const FViewConstants Whole = MakeViewConstants(View, {}), Its = MakeViewConstants(Half, {});
		for (const glm::vec2 Pixel : {glm::vec2(0, 0), glm::vec2(Half.Width - 1, Half.Height - 1)})
		{
			const glm::vec2 Expected = (2.0f * Pixel + 0.5f) * Whole.RayScale + Whole.RayOffset;
			const glm::vec2 Found = (Pixel + 0.5f) * Its.RayScale + Its.RayOffset;
			EXPECT_NEAR(Found.x, Expected.x, 1e-5f) << Size.x;
			EXPECT_NEAR(Found.y, Expected.y, 1e-5f) << Size.y;
		}
	}
}

TEST_F(FHalfFrameTest, LampsAreThoseOfAllPixelsButAtEdges)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts(0.0f));
	const FView View = LookAtPosts(160, 90);
	for (const ESignal Lobe : {ESignal::LocalDiffuse, ESignal::LocalSpecular})
	{
		SetHalf(false);
		const FImage All = RenderSignal(Lobe, View);
		SetHalf(true);
		const FImage Half = RenderSignal(Lobe, View);
		SetVariable("r.RT.Debug.HalfFrame.Planes", "0");
		const FImage Broken = RenderSignal(Lobe, View);
		SetVariable("r.RT.Debug.HalfFrame.Planes", "1");
		const double Others = CountOthers(Half, All), BrokenOthers = CountOthers(Broken, All), Ratio = MeanGreen(Half) / MeanGreen(All);
		PrintFigure(fmt::format("{}: {:.2f} % of the pixels are others, {:.2f} % without planes; mean {:.4f}", GetSignalInfo(Lobe).Name,
		    100 * Others, 100 * BrokenOthers, Ratio));
		EXPECT_NEAR(Ratio, 1.0, 0.01);
		constexpr double AtShadows = 0.05; // of 18 shadows, whose edges lie up to a pixel aside
		EXPECT_LT(Others, AtShadows);
		EXPECT_GT(BrokenOthers, AtShadows);
	}
}

TEST_F(FHalfFrameTest, LampsAsTheReference)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts(0.12f));
	SetHalf(true);
	// Pixels at edges show what is beside them, as far as they are alone on their plane.
	ExpectUnbiased("lamps, half resolution", ESignal::LocalDiffuse, LookAtPosts(128, 72), 128, 256, 1, 0.01);
}

// The sky alone lights all of the floor alike, so nothing is left to chance.
TEST_F(FHalfFrameTest, EveryPixelOfAnySizeIsLit)
{
	ASSERT_NO_FATAL_FAILURE(LoadOpenFloor());
	SetHalf(true);
	for (const char* const Rate : {"0", "2"})
	{
		SetVariable("r.RT.GI.Rate", Rate);
		for (const glm::uvec2 Size : {glm::uvec2(64, 36), glm::uvec2(131, 73), glm::uvec2(17, 1), glm::uvec2(1, 1)})
		{
			const FImage Light = RenderSignal(ESignal::DiffuseGI, LookAt({0, 5, 0}, {0, 0, 1}, 0.9f, Size.x, Size.y), 1, 2);
			for (size_t I = 1; I < Light.Pixels.size(); I += Light.Channels)
			{
				// Paths, their weights and images have half floats, and what a pixel has of others has two roundings.
				ASSERT_NEAR(Light.Pixels[I], 1.0f, 0.005f)
				    << Size.x << " x " << Size.y << ", rate " << Rate << ", pixel " << I / Light.Channels;
			}
		}
	}
}

// Posts thinner than a pixel of the half frame, before the sky.
TEST_F(FHalfFrameTest, WiresBeforeTheSkyAreLit)
{
	FTestScene Scene("wires");
	const int32_t Both = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	const int32_t Wire = Scene.AddMesh({{Both, {{-0.01f, -2, 0}, {0.01f, -2, 0}, {0.01f, 2, 0}, {-0.01f, 2, 0}}}});
	for (int I = 0; I < 16; ++I) { Scene.AddNode(Wire, glm::translate(glm::dmat4(1), glm::dvec3(-2.0 + 0.253 * I, 0, 0))); }
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.0, 0.0f);
	SetSky(glm::vec3(1));
	SetVariable("r.RT.GI", "3");
	SetVariable("r.RT.GI.Cells.Capacity", "65536");
	const FView View = LookAt({0, 0, 4}, {0, 0, 0}, 0.9f, 160, 90);
	SetHalf(false);
	const FImage All = RenderSignal(ESignal::DiffuseGI, View, 1, 2);
	SetHalf(true);
	const FImage Half = RenderSignal(ESignal::DiffuseGI, View, 1, 2);
	size_t Shown = 0;
	for (size_t I = 1; I < All.Pixels.size(); I += All.Channels)
	{
		if (All.Pixels[I] < 0.5f) { continue; }
		++Shown;
		EXPECT_NEAR(Half.Pixels[I], All.Pixels[I], 0.1f) << "pixel " << I / All.Channels;
	}
	EXPECT_GT(Shown, 500u);
}

TEST_F(FHalfFrameTest, HistoriesFollowTheCamera)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts(0.3f));
	constexpr uint32_t Width = 160, Height = 90;
	FImage Truths[2]; // of all pixels, and of half the resolution
	for (int Which = 0; Which < 2; ++Which)
	{
		SetHalf(Which == 1);
		Truths[Which] = RenderSignal(ESignal::LocalDiffuse, LookAtPosts(Width, Height), 256);
	}
	const auto Measure = [&](bool bHalf, const char* Denoise) {
		SetHalf(bHalf);
		SetVariable("r.RT.Lights.Denoise", Denoise);
		return MeanSquareError(RenderMoving(ESignal::LocalDiffuse, Width, Height, 0.01, 24), Truths[bHalf ? 1 : 0]);
	};
	const double All = Measure(false, "1"), Half = Measure(true, "1"), Raw = Measure(true, "0");
	SetVariable("r.RT.Debug.Denoise.Validate", "0");
	const double Broken = Measure(true, "1");
	PrintFigure(
	    fmt::format("mean square error in motion: half {:.2e}, of all pixels {:.2e}, half without a filter {:.2e}, with histories of "
	                "whatever was there {:.2e}",
	        Half, All, Raw, Broken));
	EXPECT_LT(Half, 4.0 * All) << "a quarter of the rays leaves at most four times the variance";
	EXPECT_LT(Half, 0.5 * Raw);
	EXPECT_GT(Broken, 1.5 * Half);
}

TEST_F(FHalfFrameTest, PathsAgree)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts(0.12f));
	SetHalf(true);
	for (const char* const Exact : {"8", "1"})
	{
		SetVariable("r.RT.Lights.Exact", Exact);
		SetVariable("r.RT.Lights.GuideSeconds", "0");
		FImage Pictures[2];
		for (int Path = 0; Path < 2; ++Path)
		{
			SetVariable("r.RT.Shadow.Path", Path == 0 ? "1" : "2");
			Pictures[Path] = RenderSignal(ESignal::LocalDiffuse, LookAtPosts(65, 37), 1, 3);
		}
		EXPECT_GT(MeanGreen(Pictures[0]), 0.0);
		EXPECT_EQ(Pictures[0].Pixels, Pictures[1].Pixels) << Exact;
	}
}

TEST_F(FHalfFrameTest, ACutForgetsAndANewSizeStartsAnew)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts(0.3f));
	SetHalf(true);
	SetVariable("r.RT.Lights.Denoise", "1");
	SetVariable("r.RT.Lights.GuideSeconds", "0");
	SetVariable("r.RT.Lights.MoreRays", "0"); // which make up for histories that are not there
	constexpr uint32_t Before = 12;
	const auto Render = [&](const FView& View, uint32_t First, uint32_t Count) {
		FCapturedFrame Captured;
		GetEngine().SetFrameIndex(First);
		for (uint32_t Frame = 0; Frame < Count; ++Frame)
		{
			FView Next = View;
			Next.bCut = Frame == 0;
			FFrameCapture Capture;
			Capture.Signals.Add(ESignal::LocalDiffuse);
			EXPECT_OK(GetEngine().RenderFrame(Next, 0.0, Capture, &Captured));
		}
		return Captured.Get(ESignal::LocalDiffuse);
	};
	const FView There = LookAtPosts(96, 54, 1.5);
	const FImage Fresh = Render(There, Before, 1);
	(void)Render(LookAtPosts(96, 54), 0, Before);
	EXPECT_EQ(Render(There, Before, 1).Pixels, Fresh.Pixels) << "a cut";
	// What a history of another size is worth, by the error behind it over that of a picture that begins anew.
	const auto MeasureResize = [&](bool bHalf, glm::uvec2 Size) {
		constexpr uint32_t After = 3;
		SetHalf(bHalf);
		const FView View = LookAtPosts(Size.x, Size.y);
		const FImage Settled = Render(View, 0, 24), Anew = Render(View, 0, After);
		(void)Render(LookAtPosts(96, 54), 0, Before);
		FCapturedFrame Captured;
		FFrameCapture Capture;
		Capture.Signals.Add(ESignal::LocalDiffuse);
		for (uint32_t Frame = 0; Frame < After; ++Frame) { EXPECT_OK(GetEngine().RenderFrame(View, 0.0, Capture, &Captured)); }
		return MeanSquareError(Captured.Get(ESignal::LocalDiffuse), Settled) / MeanSquareError(Anew, Settled);
	};
	for (const glm::uvec2 Size : {glm::uvec2(97, 55), glm::uvec2(40, 24)})
	{
		const double All = MeasureResize(false, Size), Half = MeasureResize(true, Size);
		PrintFigure(
		    fmt::format("{} x {} behind another size: error {:.2f} of that begun anew, {:.2f} of all pixels", Size.x, Size.y, Half, All));
		// 0.55 and 0.07; 0.84 where motion is halved as if odd sizes were even ones. Fewer pixels have fewer borders.
		EXPECT_LT(Half, 0.7 * All);
	}
}

TEST_F(FHalfFrameTest, ToonStylesAreThoseOfAllPixels)
{
	ASSERT_TRUE(Load("toon"));
	SetVariable("r.RT.GI", "3");
	SetVariable("r.RT.GI.Denoise", "0");
	SetVariable("r.RT.GI.Cells.Capacity", "65536");
	const FView View = MakeView(128, 72);
	FImage Pictures[2];
	for (int Which = 0; Which < 2; ++Which)
	{
		SetHalf(Which == 1);
		Pictures[Which] = RenderSignal(ESignal::DiffuseGI, View, 16, 16);
	}
	const double Ratio = MeanGreen(Pictures[1]) / MeanGreen(Pictures[0]);
	PrintFigure(fmt::format("toon: mean {:.4f} of that of all pixels", Ratio));
	EXPECT_NEAR(Ratio, 1.0, 0.03);
}

TEST_F(FHalfFrameTest, PoisonEndsWithItsFrame)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts(0.12f));
	SetSky(glm::vec3(0.5f));
	SetHalf(true);
	SetVariable("r.RT.Lights.Denoise", "1");
	SetVariable("r.RT.GI", "3");
	SetVariable("r.RT.GI.Denoise", "1");
	SetVariable("r.RT.GI.Cells.Capacity", "65536");
	SetVariable("r.RT.Debug.PoisonHistory", "3");
	for (const ESignal Signal : {ESignal::LocalDiffuse, ESignal::LocalSpecular, ESignal::DiffuseGI, ESignal::RoughSpecular})
	{
		const FImage Picture = RenderSignal(Signal, LookAtPosts(65, 37), 8);
		EXPECT_TRUE(std::all_of(Picture.Pixels.begin(), Picture.Pixels.end(), [](float Value) { return std::isfinite(Value); }))
		    << GetSignalInfo(Signal).Name;
	}
}

} // namespace
} // namespace Lantern
