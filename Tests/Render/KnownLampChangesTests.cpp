// Where the filter of local lights looks for changes (r.RT.Lights.KnownChanges): noise at rest, and what moves.
#include <algorithm>
#include <cmath>

#include "LocalLightsFixture.h"

namespace Lantern
{

namespace
{
constexpr uint32_t Width = 64, Height = 48;

class FKnownLampChangesTest : public FLocalLightsFixture
{
protected:
	void SetUp() override
	{
		FLocalLightsFixture::SetUp();
		for (const auto& [Name, Value] : {std::pair("r.RT.Shadow", "0"), {"r.RT.AO", "0"}, {"r.RT.GI", "0"}, {"r.RT.Reflections", "0"},
		         {"r.RT.Lights.HalfResolution", "0"}})
		{
			SetVariable(Name, Value);
		}
	}
	/// Bars of metal, about a pixel wide, whose neighbours say nothing of them.
	void LoadRailing()
	{
		FTestScene Scene("railing");
		FHostMaterial Metal;
		Metal.BaseColor = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
		Metal.Metallic = 1.0f;
		Metal.Roughness = 0.3f;
		Metal.bDoubleSided = true;
		const int32_t Bar =
		    Scene.AddMesh({{Scene.AddMaterial(Metal), {{-0.04f, 0, 0}, {0.04f, 0, 0}, {0.04f, 1.6f, 0}, {-0.04f, 1.6f, 0}}}});
		for (int I = -8; I <= 8; ++I) { Scene.AddNode(Bar, glm::translate(glm::dmat4(1), glm::dvec3(0.27 * I, 0, 0.05 * (I % 3)))); }
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(0));
	}
	/// Pictures of highlights, of which the first knows nothing of those before. X: of the camera, by frame.
	template <class FPlace>
	std::vector<FImage> Play(uint32_t Count, const FPlace& X, uint32_t FirstFrame = 0)
	{
		std::vector<FImage> Frames;
		GetEngine().SetFrameIndex(FirstFrame);
		for (uint32_t Frame = 0; Frame < Count; ++Frame)
		{
			FView View = LookAt({X(Frame), 3.0, 4.5}, {X(Frame), 0.2, 0}, 0.9f, Width, Height);
			View.bCut = Frame == 0;
			FFrameCapture Capture;
			Capture.Signals.Add(ESignal::LocalSpecular);
			FCapturedFrame Captured;
			EXPECT_OK(GetEngine().RenderFrame(View, 0.0, Capture, &Captured));
			Frames.push_back(Captured.Get(ESignal::LocalSpecular));
		}
		return Frames;
	}
	/// Mean over pixels of the standard deviation over the last 16 frames, over the mean of all.
	double MeasureNoise(const char* Known)
	{
		SetVariable("r.RT.Lights.KnownChanges", Known);
		const std::vector<FImage> Frames = Play(56, [](uint32_t) { return 0.0; });
		double Sigma = 0.0, Mean = 0.0;
		for (size_t I = 0; I < Frames[0].Pixels.size(); ++I)
		{
			double Sum = 0.0, Squares = 0.0;
			for (size_t F = 40; F < Frames.size(); ++F)
			{
				Sum += double(Frames[F].Pixels[I]) / 16.0;
				Squares += double(Frames[F].Pixels[I]) * double(Frames[F].Pixels[I]) / 16.0;
			}
			Sigma += std::sqrt(std::max(Squares - Sum * Sum, 0.0));
			Mean += Sum;
		}
		return Sigma / Mean;
	}
	/// The mean of all from the given one on.
	static FImage Average(const std::vector<FImage>& Images, size_t First)
	{
		FImage Mean = Images[First];
		for (size_t I = First + 1; I < Images.size(); ++I)
		{
			for (size_t P = 0; P < Mean.Pixels.size(); ++P)
			{
				Mean.Pixels[P] += (Images[I].Pixels[P] - Mean.Pixels[P]) / static_cast<float>(I - First + 1);
			}
		}
		return Mean;
	}
	static double Difference(const FImage& A, const FImage& B)
	{
		double Sum = 0.0, All = 0.0;
		for (size_t I = 0; I < A.Pixels.size(); ++I)
		{
			Sum += std::abs(double(A.Pixels[I]) - double(B.Pixels[I]));
			All += double(B.Pixels[I]);
		}
		return Sum / All;
	}
};

TEST_F(FKnownLampChangesTest, HighlightsAtRestHaveLessNoise)
{
	ASSERT_NO_FATAL_FAILURE(LoadRailing());
	(void)AddLamps(24);
	const double Known = MeasureNoise("1"), Guessed = MeasureNoise("0");
	PrintFigure(fmt::format("noise of highlights {:.4f}, of the mean; {:.4f} if the picture is searched for changes", Known, Guessed));
	EXPECT_LT(Known, 0.75 * Guessed);
}

// Highlights of a camera that strafes move over surfaces. With the planted fault nobody looks for that.
TEST_F(FKnownLampChangesTest, HighlightsFollowTheCamera)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	(void)AddLamps(24);
	const auto Strafe = [](uint32_t Frame) { return 0.04 * std::max(int(Frame) - 24, 0); };
	const auto Stay = [&](uint32_t) { return Strafe(48); };
	const FImage Truth = Average(Play(240, Stay, 100), 60);
	const auto Measure = [&](const char* Eye) {
		SetVariable("r.RT.Debug.Lights.Eye", Eye);
		std::vector<FImage> Ends;
		for (uint32_t Run = 0; Run < 8; ++Run) { Ends.push_back(Play(49, Strafe, 1000 * (Run + 1)).back()); }
		return Difference(Average(Ends, 0), Truth);
	};
	const double Told = Measure("1"), Untold = Measure("0");
	PrintFigure(fmt::format("highlights in motion are off by {:.4f}, and by {:.4f} if the filter is not told", Told, Untold));
	EXPECT_LT(Told, 0.8 * Untold);
}

} // namespace
} // namespace Lantern
