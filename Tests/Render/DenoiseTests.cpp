// What is accumulated while the camera stands still: it converges to what is right, forgets at cuts, and what is not a
// number does not live on. Each test is run a second time with what it is about switched off, and must notice.
#include <algorithm>
#include <cmath>

#include "DenoiseFixture.h"

namespace Lantern
{

namespace
{
class FDenoiseStillTest : public FDenoiseTest
{
protected:
	/// The built-in edge, its penumbra 16 pixels wide.
	void LoadPenumbra()
	{
		ASSERT_TRUE(Load("penumbra:1"));
		UseFilter();
		SetVariable("r.RT.Shadow.MoreRays", "0"); // what the filter alone makes of one ray
	}
	static FSequence MakeStill(uint32_t Frames, uint32_t Width = 64)
	{
		FSequence Sequence;
		Sequence.Frames = Frames;
		Sequence.Camera = [Width](uint32_t) { return MakeView(Width, Width); };
		return Sequence;
	}
	static FImage MakeMean(const std::vector<FImage>& Images, size_t First)
	{
		FImage Mean(Images[0].Width, Images[0].Height, 1);
		for (size_t I = First; I < Images.size(); ++I)
		{
			for (size_t P = 0; P < Mean.Pixels.size(); ++P) { Mean.Pixels[P] += Images[I].Pixels[P] / float(Images.size() - First); }
		}
		return Mean;
	}
	/// Largest difference of the means of columns: the picture is the same in every row.
	static double FindBias(const FImage& Mean, const FImage& Truth)
	{
		double Worst = 0.0;
		for (uint32_t X = 0; X < Mean.Width; ++X)
		{
			double Sum = 0.0;
			for (uint32_t Y = 0; Y < Mean.Height; ++Y) { Sum += Mean.At(X, Y, 0) - Truth.At(X, Y, 0); }
			Worst = std::max(Worst, std::abs(Sum) / Mean.Height);
		}
		return Worst;
	}
	static bool AllFinite(const FImage& Image)
	{
		return std::all_of(Image.Pixels.begin(), Image.Pixels.end(), [](float V) { return std::isfinite(V); });
	}
	/// Poisons what the next frame finds of its past.
	static void Poison(const char* Names) { GetEngine().GetRenderer().GetGraphResources().PoisonHistory(Names); }
};

TEST_F(FDenoiseStillTest, ConvergesToTheTruth)
{
	LoadPenumbra();
	const FImage Truth = RenderTruth(MakeView(64, 64), 4);
	const auto Measure = [&] {
		UseFilter();
		const std::vector<FImage> Images = RenderSequence(MakeStill(90));
		struct
		{
			double Bias, First, Eighth, Last;
		} Figures = {FindBias(MakeMean(Images, 45), Truth), std::sqrt(ComputeMeanSquare(Images[0], Truth)),
		    std::sqrt(ComputeMeanSquare(Images[7], Truth)), std::sqrt(ComputeMeanSquare(Images[89], Truth))};
		PrintFigure(fmt::format("still: worst column off by {:.4f}; error of frame 1 {:.4f}, 8 {:.4f}, 90 {:.4f}", Figures.Bias,
		    Figures.First, Figures.Eighth, Figures.Last));
		return Figures;
	};
	const auto Figures = Measure();
	EXPECT_LT(Figures.Bias, 0.03);
	EXPECT_LT(Figures.Eighth, 0.75 * Figures.First);
	EXPECT_LT(Figures.Last, 0.5 * Figures.First);
	UseRays(1);
	EXPECT_LT(Figures.First, 0.75 * std::sqrt(ComputeMeanSquare(RenderSequence(MakeStill(1))[0], Truth))) << "filtered in space alone";
	// Planted: what is accumulated is not used.
	SetVariable("r.RT.Shadow.HistorySeconds", "0");
	const auto Forgetful = Measure();
	EXPECT_GT(Forgetful.Last, 0.5 * Forgetful.First);
}

// A hard shadow has nothing to filter: no pass is added for it, and a soft one without noise stays as it is.
TEST_F(FDenoiseStillTest, LeavesAloneWhatHasNoNoise)
{
	LoadPenumbra();
	SetSun(0.001, 4.0f, {0, -1, 0}); // soft by name
	for (const FImage& Image : RenderSequence(MakeStill(8)))
	{
		for (uint32_t X = 0; X < 64; ++X) { ASSERT_EQ(Image.At(X, 20, 0), X < 32 ? 0.0f : 1.0f) << X; }
	}
	// Planted: where all variance is taken for noise, an edge is smoothed.
	SetSun(0.53, 4.0f, {0, -1, 0});
	const FImage Soft = RenderSequence(MakeStill(8)).back();
	EXPECT_GT(Soft.At(30, 20, 0), 0.0f);
}

// A cut and another scene begin as the very first frame does.
TEST_F(FDenoiseStillTest, ForgetsAtCuts)
{
	LoadPenumbra();
	const std::vector<FImage> First = RenderSequence(MakeStill(8));
	EXPECT_EQ(RenderSequence(MakeStill(1))[0].Pixels, First[0].Pixels) << "a sequence begins with a cut";
	(void)RenderSequence(MakeStill(3, 48));
	FSequence Sequence = MakeStill(1);
	EXPECT_EQ(RenderSequence(Sequence)[0].Pixels, First[0].Pixels) << "another size in between";
	(void)RenderSequence(MakeStill(8));
	FCapturedFrame Captured;
	FFrameCapture Capture;
	Capture.Signals.Add(ESignal::SunShadow);
	const auto RenderNext = [&](uint32_t Width) {
		GetEngine().SetFrameIndex(0);
		EXPECT_OK(GetEngine().RenderFrame(MakeView(Width, Width), 0.0, Capture, &Captured));
		return Captured.Get(ESignal::SunShadow).Pixels;
	};
	EXPECT_NE(RenderNext(64), First[0].Pixels) << "planted: no cut, and the past is seen";
	(void)RenderNext(48);
	EXPECT_NE(RenderNext(64), First[0].Pixels) << "a history survives another size; FViewHistoryTest says how well";
	(void)RenderSequence(MakeStill(8));
	SetVariable("r.RT.Shadow.Denoise", "0");
	(void)RenderNext(64);
	SetVariable("r.RT.Shadow.Denoise", "1");
	EXPECT_EQ(RenderNext(64), First[0].Pixels) << "it was off in between";
}

// Stability case 14: histories of nothing but not-a-number count as none: the frame is that of a cut, pixel by pixel, and the
// next go on from it.
TEST_F(FDenoiseStillTest, WhatIsNotANumberIsGoneAtOnce)
{
	LoadPenumbra();
	const auto RenderPoisoned = [&](const char* Names) {
		FSequence Sequence = MakeStill(12);
		Sequence.Change = [&](uint32_t Frame) {
			GetEngine().SetFrameIndex(Frame >= 8 ? Frame - 8 : Frame + 100);
			if (Frame == 8) { Poison(Names); }
		};
		return RenderSequence(Sequence);
	};
	RenderSequence(MakeStill(12)); // what came with the scene has been there for a while
	const std::vector<FImage> Fresh = RenderSequence(MakeStill(4));
	for (const char* Names : {"", "Surface", "SunShadow"})
	{
		const std::vector<FImage> Images = RenderPoisoned(Names);
		for (uint32_t Frame = 0; Frame < 12; ++Frame)
		{
			EXPECT_TRUE(AllFinite(Images[Frame])) << "frame " << Frame << ", poisoned: " << Names;
		}
		for (uint32_t Frame = 8; Frame < 12; ++Frame)
		{
			EXPECT_EQ(Images[Frame].Pixels, Fresh[Frame - 8].Pixels) << Frame << ", poisoned: " << Names;
		}
	}
	// Planted: unguarded, it stays.
	SetVariable("r.RT.Debug.Denoise.Guard", "0");
	SetVariable("r.RT.Debug.Denoise.Adapt", "0");
	const std::vector<FImage> Images = RenderPoisoned("SunShadow");
	EXPECT_FALSE(AllFinite(Images[8]) && AllFinite(Images[11]));
}

} // namespace
} // namespace Lantern
