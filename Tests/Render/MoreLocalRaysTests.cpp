// More rays to lamps with an extent where no history helps (r.RT.Lights.MoreRays): noise, mean, and who has them.
#include <algorithm>
#include <cmath>

#include "LanternImage/ImageStatistics.h"
#include "SignalFixture.h"

namespace Lantern
{

namespace
{
constexpr uint32_t Width = 64, Height = 48;

class FMoreLocalRaysTest : public FSignalTest
{
protected:
	void SetUp() override
	{
		FSignalTest::SetUp();
		for (const auto& [Name, Value] : {std::pair("r.RT.Rays.Count", "1"), {"r.RT.Shadow", "0"}, {"r.RT.AO", "0"},
		         {"r.RT.Lights.FilterPasses", "0"}, {"r.RT.Lights.HalfResolution", "0"}})
		{
			SetVariable(Name, Value);
		}
		LoadBoard();
	}
	/// A floor under a board.
	void LoadBoard()
	{
		FTestScene Scene("more_rays");
		const int32_t Paint = Scene.AddLambert(glm::vec3(0.5f)), Both = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Paint, 8.0f)}));
		Scene.AddNode(Scene.AddMesh({{Both, {{-0.6f, 0.3f, 0}, {0.6f, 0.3f, 0}, {0.6f, 1.0f, 0}, {-0.6f, 1.0f, 0}}}}));
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(0));
	}
	void AddLamp(double X, float Radius, bool bCastsShadow = true)
	{
		FSceneLight Light = MakeLamp({X, 1.6, 1.2}, glm::vec3(4), Radius);
		Light.bCastsShadow = bCastsShadow;
		GetScene().GetScene().AddLight(Light);
	}
	float DeltaSeconds = 1.0f / 60.0f;
	bool bSun = false; ///< frames have the sun's shadows as well
	struct FPlayed
	{
		std::vector<FImage> Frames;
		std::vector<double> Rays; ///< per pixel, of each frame
	};
	/// bCut: no frame knows of those before it. Step: by which the camera moves in a frame, metres.
	FPlayed Play(const char* MoreRays, uint32_t Count, bool bCut, double Step = 0.0, uint32_t FirstFrame = 0)
	{
		SetVariable("r.RT.Lights.MoreRays", MoreRays);
		FRenderer& Renderer = GetEngine().GetRenderer();
		FPlayed Played;
		GetEngine().SetFrameIndex(FirstFrame);
		for (uint32_t Frame = 0; Frame < Count; ++Frame)
		{
			EXPECT_OK(Renderer.WaitForAll());
			const uint64_t Before = Renderer.GetRayCounts().Total;
			FView View = LookAt({Step * Frame, 2.4, 2.6}, {Step * Frame, 0, -0.6}, 0.9f, Width, Height);
			View.bCut = bCut || Frame == 0;
			View.DeltaSeconds = DeltaSeconds;
			FFrameCapture Capture;
			Capture.Signals.Add(ESignal::LocalDiffuse);
			if (bSun) { Capture.Signals.Add(ESignal::SunShadow); }
			FCapturedFrame Captured;
			EXPECT_OK(GetEngine().RenderFrame(View, 0.0, Capture, &Captured));
			Played.Frames.push_back(Captured.Get(ESignal::LocalDiffuse));
			EXPECT_OK(Renderer.WaitForAll());
			Played.Rays.push_back(double(Renderer.GetRayCounts().Total - Before) / (double(Width) * Height));
		}
		return Played;
	}
};

struct FSpread
{
	double Mean = 0.0, MeanError = 0.0; ///< sum over pixels, and its standard error
	double Variance = 0.0;              ///< between frames, sum over pixels
};

/// Of pixels that Counts(X, Y) names.
template <class T>
FSpread MeasureSpread(const std::vector<FImage>& Frames, T&& Counts)
{
	FSpread Out;
	const double N = double(Frames.size());
	for (uint32_t Y = 0; Y < Height; ++Y)
	{
		for (uint32_t X = 0; X < Width; ++X)
		{
			if (!Counts(X, Y)) { continue; }
			double Sum = 0.0, Squares = 0.0;
			for (const FImage& Frame : Frames)
			{
				const double Value = GetLuminance(Frame, X, Y);
				Sum += Value;
				Squares += Value * Value;
			}
			Out.Mean += Sum / N;
			Out.Variance += std::max(0.0, (Squares - Sum * Sum / N) / (N - 1.0));
		}
	}
	Out.MeanError = std::sqrt(Out.Variance / N);
	return Out;
}

double MeanOfPixel(const std::vector<FImage>& Frames, uint32_t X, uint32_t Y)
{
	double Sum = 0.0;
	for (const FImage& Frame : Frames) { Sum += GetLuminance(Frame, X, Y); }
	return Sum / double(Frames.size());
}

TEST_F(FMoreLocalRaysTest, PenumbraeWithoutAHistoryHaveLessNoise)
{
	AddLamp(-0.3, 0.25f);
	AddLamp(0.4, 0.15f);
	const FPlayed One = Play("0", 64, true), More = Play("1", 64, true);
	const auto All = [](uint32_t, uint32_t) { return true; };
	const FSpread Before = MeasureSpread(One.Frames, All), Now = MeasureSpread(More.Frames, All);
	ASSERT_GT(Before.Variance, 0.0);
	std::printf("variance %.3f of one ray's, mean %.5f of it, rays %.3f and %.3f\n", Now.Variance / Before.Variance, Now.Mean / Before.Mean,
	    One.Rays[8], More.Rays[8]);
	// Four rays have a quarter of the variance, and four equal ones all of it. Tiles whose rays agree by chance keep theirs.
	EXPECT_LT(Now.Variance, 0.45 * Before.Variance);
	// Tiles stratify their pixels, so that errors of means are smaller than those of chance.
	EXPECT_NEAR(Now.Mean, Before.Mean, 3.0 * std::hypot(Before.MeanError, Now.MeanError));
	EXPECT_GT(More.Rays[8], One.Rays[8]);
	EXPECT_LT(More.Rays[8], 2.0 * One.Rays[8]); // tiles that are lit or dark as a whole have none
}

/// What few rays saw must not decide whether a pixel gets more: the rare answer would then ask more often, and weigh less. Where the eight
/// pixels around one decide, dark parts of a penumbra have 0.93 of their light, and bright ones 0.999.
TEST_F(FMoreLocalRaysTest, PenumbraeKeepTheirMean)
{
	AddLamp(-0.3, 0.25f, false);
	const FImage Lit = Play("0", 1, true).Frames[0];
	LoadBoard();
	AddLamp(-0.3, 0.25f);
	constexpr uint32_t Frames = 512;
	const FPlayed Chosen = Play("0", Frames, true, 0.0, 4096); // other frames than those that are measured: chance must not choose
	const FPlayed One = Play("0", Frames, true), More = Play("1", Frames, true);
	for (const auto& [Least, Most] : {std::pair(0.05, 0.4), {0.6, 0.95}})
	{
		const auto IsPenumbra = [&, Least = Least, Most = Most](uint32_t X, uint32_t Y) {
			const double Share = MeanOfPixel(Chosen.Frames, X, Y) / std::max(double(GetLuminance(Lit, X, Y)), 1e-6);
			return Share >= Least && Share <= Most;
		};
		const FSpread A = MeasureSpread(One.Frames, IsPenumbra), B = MeasureSpread(More.Frames, IsPenumbra);
		ASSERT_GT(A.Mean, 0.0);
		const double Error = std::hypot(A.MeanError, B.MeanError);
		std::printf("%.2f to %.2f: %.4f of one ray's light, standard error %.4f\n", Least, Most, B.Mean / A.Mean, Error / A.Mean);
		EXPECT_NEAR(B.Mean, A.Mean, 3.0 * Error);
	}
}

TEST_F(FMoreLocalRaysTest, AHistoryEndsThem)
{
	AddLamp(-0.3, 0.25f);
	const FPlayed One = Play("0", 24, false), More = Play("1", 24, false);
	EXPECT_GT(More.Rays[0], 1.05 * One.Rays[0]);
	EXPECT_GT(More.Rays[1], 1.05 * One.Rays[1]); // one frame of four rays is no history yet
	EXPECT_EQ(More.Rays[23], One.Rays[23]);
}

// Histories of slow frames are never worth 16 of them.
TEST_F(FMoreLocalRaysTest, AHistoryOfSlowFramesEndsThem)
{
	AddLamp(-0.3, 0.25f);
	for (const float Rate : {30.0f, 10.0f})
	{
		DeltaSeconds = 1.0f / Rate;
		const FPlayed One = Play("0", 32, false), More = Play("1", 32, false);
		EXPECT_GT(More.Rays[0], 1.05 * One.Rays[0]) << Rate;
		for (size_t Frame = 24; Frame < 32; ++Frame) { EXPECT_EQ(More.Rays[Frame], One.Rays[Frame]) << Rate << ", " << Frame; }
	}
}

TEST_F(FMoreLocalRaysTest, WhatComesIntoViewHasThem)
{
	AddLamp(-0.3, 0.25f);
	const FPlayed One = Play("0", 24, false, 0.02), More = Play("1", 24, false, 0.02);
	EXPECT_GT(More.Rays[23], One.Rays[23]);
	EXPECT_LT(More.Rays[23], 1.2 * One.Rays[23]);
}

TEST_F(FMoreLocalRaysTest, PointsHaveNone)
{
	AddLamp(-0.3, 0.0f);
	const FPlayed One = Play("0", 3, true), More = Play("1", 3, true);
	EXPECT_EQ(More.Rays[2], One.Rays[2]);
	EXPECT_EQ(More.Frames[2].Pixels, One.Frames[2].Pixels);
}

TEST_F(FMoreLocalRaysTest, TheSunTracesItsOwn)
{
	AddLamp(-0.3, 0.25f);
	SetSun(2.0, 2.0f);
	Play("1", 16, false); // for a while after a lamp has come, the filter looks for changes
	const FPlayed Alone = Play("1", 8, false, 0.02);
	bSun = true;
	SetVariable("r.RT.Shadow", "1");
	Play("1", 16, false);
	const FPlayed Both = Play("1", 8, false, 0.02);
	for (size_t Frame = 0; Frame < 8; ++Frame)
	{
		EXPECT_EQ(Both.Frames[Frame].Pixels, Alone.Frames[Frame].Pixels) << Frame;
		EXPECT_GT(Both.Rays[Frame], Alone.Rays[Frame] + 0.5) << Frame;
	}
}

TEST_F(FMoreLocalRaysTest, PathsAgree)
{
	AddLamp(-0.3, 0.25f);
	Play("1", 16, false); // for a while after a lamp has come, the filter looks for changes
	SetVariable("r.RT.Shadow.Path", "1");
	const FPlayed Pipeline = Play("1", 6, false, 0.02);
	SetVariable("r.RT.Shadow.Path", "2");
	const FPlayed Query = Play("1", 6, false, 0.02);
	EXPECT_GT(Query.Rays[5], 0.0);
	EXPECT_EQ(Pipeline.Rays, Query.Rays);
	EXPECT_EQ(Pipeline.Frames[5].Pixels, Query.Frames[5].Pixels);
}

} // namespace
} // namespace Lantern
