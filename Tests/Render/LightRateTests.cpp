// Local lights at fewer rays (r.RT.Lights.Rate): bias, rays, edges and noise against every pixel's own rays, and a planted fault.
#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "LanternImage/ImageStatistics.h"
#include "SignalFixture.h"

namespace Lantern
{

namespace
{
class FLightRateTest : public FSignalTest
{
protected:
	void SetUp() override
	{
		FSignalTest::SetUp();
		SetVariable("r.RT.Lights.Denoise", "0"); // what rays say, and nothing else
		SetVariable("r.RT.Rays.Count", "1");
		SetVariable("r.RT.Shadow", "0"); // lamps alone ask for rays
		SetVariable("r.RT.AO", "0");
		SetVariable("r.RT.Rays.QueuePerPixel", "8"); // all that are asked for
	}
	/// A floor, a wall and six posts between lamps. Spheres: share of the lamps that have an extent, one of so many; 0: none.
	void LoadPosts(uint32_t Lamps, uint32_t Spheres)
	{
		FTestScene Scene("posts");
		const int32_t Paint = Scene.AddLambert(glm::vec3(0.5f)), Both = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Paint, 8.0f)}));
		const int32_t Post = Scene.AddMesh({{Both, {{-0.15f, 0, 0}, {0.15f, 0, 0}, {0.15f, 1.0f, 0}, {-0.15f, 1.0f, 0}}}});
		for (int I = 0; I < 6; ++I)
		{
			const glm::dvec3 At(-1.9 + 0.75 * I, 0, I % 2 == 0 ? 0.3 : -0.7);
			Scene.AddNode(Post, glm::rotate(glm::translate(glm::dmat4(1), At), 0.4 * I, glm::dvec3(0, 1, 0)));
		}
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(0));
		for (uint32_t I = 0; I < Lamps; ++I)
		{
			const double Angle = 0.5 + 2.4 * I, Far = 2.6 * std::sqrt((I + 0.5) / Lamps);
			const glm::dvec3 Position(Far * std::cos(Angle), 0.8 + 0.11 * (I % 7), Far * std::sin(Angle));
			const glm::vec3 Intensity = glm::vec3(2.0f, 1.5f, 1.0f + 0.3f * float(I % 4)) * (4.0f / float(Lamps));
			GetScene().GetScene().AddLight(MakeLamp(Position, Intensity, Spheres > 0 && I % Spheres == 0 ? 0.12f : 0.0f));
		}
	}
	static FView LookAtPosts(uint32_t Width, uint32_t Height, double Aside = 0.0)
	{
		return LookAt({Aside, 2.2, 3.6}, {Aside, 0.2, 0}, 0.9f, Width, Height);
	}
	struct FPlayed
	{
		std::vector<FImage> Frames;
		double RaysPerPixel = 0.0;
	};
	/// Step: by which the camera moves in a frame, metres.
	FPlayed Play(const char* Rate, const FView& View, double Step, uint32_t Count)
	{
		SetVariable("r.RT.Lights.Rate", Rate);
		FRenderer& Renderer = GetEngine().GetRenderer();
		FPlayed Played;
		GetEngine().SetFrameIndex(0);
		uint64_t Before = 0;
		for (uint32_t Frame = 0; Frame < Count; ++Frame)
		{
			if (Frame == 0)
			{
				EXPECT_OK(Renderer.WaitForAll());
				Before = Renderer.GetRayCounts().Total;
			}
			FView Moved = View;
			Moved.Position.x += Step * Frame;
			Moved.bCut = Frame == 0;
			Moved.DeltaSeconds = 1.0f / 60.0f;
			FFrameCapture Capture;
			Capture.Signals.Add(ESignal::LocalDiffuse);
			FCapturedFrame Captured;
			EXPECT_OK(GetEngine().RenderFrame(Moved, 0.0, Capture, &Captured));
			Played.Frames.push_back(Captured.Get(ESignal::LocalDiffuse));
			EXPECT_EQ(Played.Frames.back().Width, View.Width);
		}
		EXPECT_OK(Renderer.WaitForAll());
		Played.RaysPerPixel = double(Renderer.GetRayCounts().Total - Before) / (double(View.Width) * View.Height * Count);
		return Played;
	}
	/// Mean square of the difference over the mean of B.
	static double CompareFrames(const std::vector<FImage>& A, const std::vector<FImage>& B)
	{
		double Sum = 0.0, Mean = 0.0;
		size_t Count = 0;
		for (size_t Frame = 0; Frame < A.size(); ++Frame)
		{
			for (size_t I = 1; I < A[Frame].Pixels.size(); I += A[Frame].Channels, ++Count)
			{
				const double Difference = double(A[Frame].Pixels[I]) - double(B[Frame].Pixels[I]);
				Sum += Difference * Difference;
				Mean += double(B[Frame].Pixels[I]);
			}
		}
		return Sum / double(Count) / (Mean * Mean / (double(Count) * double(Count)));
	}
	/// By how much pixels that have their turn stand out from those around them more than the others do, over the mean: at borders of
	/// shadows, where there is something to stand out from.
	static double MeasureCheckers(const std::vector<FImage>& Frames)
	{
		double Steps[2] = {}, Mean = 0.0;
		size_t Counts[2] = {}, Count = 0;
		for (size_t Frame = 0; Frame < Frames.size(); ++Frame)
		{
			const FImage& F = Frames[Frame];
			const double Whole = ComputeMeans(F).Luminance;
			for (uint32_t Y = 1; Y + 1 < F.Height; ++Y)
			{
				for (uint32_t X = 1; X + 1 < F.Width; ++X)
				{
					const double Around = 0.25 * (double(GetLuminance(F, X - 1, Y)) + GetLuminance(F, X + 1, Y) +
					                                 GetLuminance(F, X, Y - 1) + GetLuminance(F, X, Y + 1));
					float Low = GetLuminance(F, X, Y), High = Low;
					for (uint32_t I = 0; I < 9; ++I)
					{
						Low = std::min(Low, GetLuminance(F, X + I % 3 - 1, Y + I / 3 - 1));
						High = std::max(High, GetLuminance(F, X + I % 3 - 1, Y + I / 3 - 1));
					}
					if (double(High - Low) < 0.2 * Whole) { continue; }
					const size_t Turn = (X + Y + Frame) % 2;
					Steps[Turn] += std::abs(double(GetLuminance(F, X, Y)) - Around);
					++Counts[Turn];
					Mean += Around;
					++Count;
				}
			}
		}
		return std::abs(Steps[0] / double(Counts[0]) - Steps[1] / double(Counts[1])) / (Mean / double(Count));
	}
	/// Mean over pixels of the standard deviation over frames, over the mean.
	static double MeasureSigma(const std::vector<FImage>& Frames)
	{
		double Deviation = 0.0, Mean = 0.0;
		const double N = double(Frames.size());
		for (size_t I = 1; I < Frames[0].Pixels.size(); I += Frames[0].Channels)
		{
			double Sum = 0.0, Squares = 0.0;
			for (const FImage& Frame : Frames)
			{
				Sum += double(Frame.Pixels[I]);
				Squares += double(Frame.Pixels[I]) * double(Frame.Pixels[I]);
			}
			Deviation += std::sqrt(std::max(0.0, (Squares - Sum * Sum / N) / (N - 1.0)));
			Mean += Sum / N;
		}
		return Deviation / Mean;
	}
};

TEST_F(FLightRateTest, AsTheReference)
{
	for (const auto& [Lamps, Exact] : {std::pair{4u, "4"}, {12u, "4"}})
	{
		ASSERT_NO_FATAL_FAILURE(LoadPosts(Lamps, 2));
		SetVariable("r.RT.Lights.Exact", Exact);
		for (const char* const Rate : {"1", "2"})
		{
			SetVariable("r.RT.Lights.Rate", Rate);
			const std::string Name = fmt::format("{} lamps, rate {}", Lamps, Rate);
			ExpectUnbiased(Name.c_str(), ESignal::LocalDiffuse, LookAtPosts(64, 36), 128, 512, 1, 0.005);
		}
	}
}

TEST_F(FLightRateTest, FewerRays)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts(4, 0));
	for (const double Step : {0.0, 0.01})
	{
		const double All = Play("0", LookAtPosts(160, 90), Step, 8).RaysPerPixel,
		             Half = Play("1", LookAtPosts(160, 90), Step, 8).RaysPerPixel,
		             Quarter = Play("2", LookAtPosts(160, 90), Step, 8).RaysPerPixel;
		PrintFigure(
		    fmt::format("4 lamps, {} m a frame: {:.3f} rays per pixel; every other one {:.3f} ({:.3f}), one of four {:.3f} ({:.3f})", Step,
		        All, Half, Half / All, Quarter, Quarter / All));
		EXPECT_LE(Half, 0.65 * All);
		EXPECT_LE(Quarter, 0.45 * All);
		EXPECT_GT(Quarter, 0.25 * All);
	}
}

// In motion: what a pixel takes from others, or asks for, is what its own ray would have said, and its place in the checkers is not seen.
TEST_F(FLightRateTest, EdgesAsOfAllRays)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts(4, 0));
	const FView View = LookAtPosts(160, 90);
	const FPlayed All = Play("0", View, 0.01, 8);
	for (const char* const Rate : {"1", "2"})
	{
		const FPlayed Few = Play(Rate, View, 0.01, 8);
		SetVariable("r.RT.Debug.Lights.SecondRay", "0");
		const FPlayed Broken = Play(Rate, View, 0.01, 8);
		SetVariable("r.RT.Debug.Lights.SecondRay", "1");
		const double Error = CompareFrames(Few.Frames, All.Frames), BrokenError = CompareFrames(Broken.Frames, All.Frames);
		const double Step = MeasureCheckers(Few.Frames), BrokenStep = MeasureCheckers(Broken.Frames), AllStep = MeasureCheckers(All.Frames);
		PrintFigure(
		    fmt::format("rate {}: mean square off {:.2e}, without second rays {:.2e}; steps at checkers {:.4f}, without {:.4f}, of all "
		                "rays {:.4f}",
		        Rate, Error, BrokenError, Step, BrokenStep, AllStep));
		EXPECT_LT(3.0 * Error, BrokenError);
		EXPECT_LE(Step, 0.02);
		if (Rate[0] == '1') { EXPECT_GT(BrokenStep, 10.0 * std::max(Step, AllStep)); }
	}
}

TEST_F(FLightRateTest, NoiseAsOfAllRays)
{
	for (const auto& [Lamps, Spheres] : {std::pair{4u, 0u}, {4u, 1u}, {12u, 2u}})
	{
		ASSERT_NO_FATAL_FAILURE(LoadPosts(Lamps, Spheres));
		for (const char* const Filter : {"0", "1"})
		{
			SetVariable("r.RT.Lights.Denoise", Filter);
			const auto Measure = [&](const char* Rate) {
				std::vector<FImage> Frames = Play(Rate, LookAtPosts(96, 54), 0.0, 96).Frames;
				Frames.erase(Frames.begin(), Frames.begin() + 64);
				return MeasureSigma(Frames);
			};
			const double All = Measure("0"), Few = Measure("1");
			PrintFigure(fmt::format("{} lamps, {} with an extent, {}: sigma {:.4f}, of all rays {:.4f}", Lamps,
			    Spheres > 0 ? (Lamps + Spheres - 1) / Spheres : 0, Filter[0] == '1' ? "filtered" : "unfiltered", Few, All));
			EXPECT_LE(Few, 1.5 * All + 1e-3);
		}
	}
}

TEST_F(FLightRateTest, PathsAgree)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts(6, 2));
	SetVariable("r.RT.Lights.GuideSeconds", "0"); // frames depend on no others
	SetVariable("r.RT.Lights.Rate", "1");
	for (const char* const Exact : {"8", "1"})
	{
		SetVariable("r.RT.Lights.Exact", Exact);
		SetVariable("r.RT.Shadow.Path", "1");
		const FImage Pipeline = RenderSignal(ESignal::LocalDiffuse, LookAtPosts(64, 36), 1, 3);
		SetVariable("r.RT.Shadow.Path", "2");
		const FImage Query = RenderSignal(ESignal::LocalDiffuse, LookAtPosts(64, 36), 1, 3);
		EXPECT_GT(MeanGreen(Query), 0.0);
		EXPECT_EQ(Pipeline.Pixels, Query.Pixels) << Exact;
	}
}

} // namespace
} // namespace Lantern
