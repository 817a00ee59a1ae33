// What is accumulated while the picture itself changes: its resolution, and the jitter of its frames.
#include "DenoiseFixture.h"
#include "SignalFixture.h"

namespace Lantern
{
namespace
{

class FViewHistoryTest : public FDenoiseTest
{
protected:
	static FView MakeFrame(uint32_t Width, uint32_t Height)
	{
		FView View = LookAt({0, 4, 0.01}, {0, 0, 0}, 0.9f, Width, Height);
		View.DeltaSeconds = 1.0f / 60.0f;
		return View;
	}
	/// The penumbra of an edge, seen from above.
	[[nodiscard]] bool LoadPenumbra()
	{
		if (!Load("penumbra:1")) { return false; }
		SetSun(20.0, 4.0f, {0, -1, 0});
		return true;
	}
};

TEST_F(FViewHistoryTest, HistorySurvivesAChangeOfResolution)
{
	ASSERT_TRUE(LoadPenumbra());
	constexpr uint32_t Change = 24;
	const auto Camera = [](uint32_t Frame) { return Frame < Change ? MakeFrame(96, 64) : MakeFrame(144, 96); };
	const FImage Truth = RenderTruth(Camera(Change), 16);
	UseFilter();
	FSequence Sequence;
	Sequence.Camera = Camera;
	Sequence.Frames = Change + 1;
	const double Carried = ComputeMeanSquare(RenderSequence(Sequence).back(), Truth);
	Sequence.Camera = [](uint32_t) { return MakeFrame(144, 96); };
	Sequence.Frames = 1;
	Sequence.FirstIndex = Change;
	const double Fresh = ComputeMeanSquare(RenderSequence(Sequence).back(), Truth);
	Sequence.Frames = Change + 1;
	Sequence.FirstIndex = 0;
	const double Settled = ComputeMeanSquare(RenderSequence(Sequence).back(), Truth);
	PrintFigure(fmt::format("mean square error: carried over {:.3g}, started anew {:.3g}, settled {:.3g}", Carried, Fresh, Settled));
	EXPECT_LT(Carried, 0.5 * Fresh);
	EXPECT_GT(Fresh, 2.0 * Settled) << "the test could not fail";
}

// A jittered camera that stands still accumulates as one without jitter: its history is not resampled.
TEST_F(FViewHistoryTest, JitteredFramesAccumulateAsThoseWithoutJitter)
{
	ASSERT_TRUE(LoadPenumbra());
	const FView Still = MakeFrame(96, 64);
	const FImage Truth = RenderTruth(Still, 16);
	UseFilter();
	FSequence Sequence;
	Sequence.Frames = 32;
	const auto Measure = [&](float Amount) {
		Sequence.Camera = [&, Amount](uint32_t Frame) {
			FView View = Still;
			View.Jitter = Amount * glm::vec2(float(Frame * 5 % 8) / 7.0f - 0.5f, float(Frame * 3 % 8) / 7.0f - 0.5f);
			return View;
		};
		return ComputeMeanSquare(RenderSequence(Sequence).back(), Truth);
	};
	// Further rays of the first frame all start at one jittered place, whose light then weighs as that of nine frames.
	SetVariable("r.RT.Shadow.MoreRays", "0");
	Measure(0.0f); // what came with the scene has been there for a while
	const double Without = Measure(0.0f), With = Measure(0.9f);
	PrintFigure(fmt::format("mean square error: without jitter {:.3g}, with {:.3g}", Without, With));
	EXPECT_LT(With, 1.5 * Without);
}

class FColorHistoryTest : public FSignalTest
{
protected:
	static constexpr uint32_t Before = 32, After = 4;
	static constexpr double LitSeconds = 1.0; // the lamp shines

	/// The last frame of Count, of a size each.
	static FImage RenderLast(const std::vector<glm::uvec2>& Sizes)
	{
		FCapturedFrame Captured;
		FFrameCapture Capture;
		Capture.Signals.Add(ESignal::LocalDiffuse);
		const uint32_t First = Before + After - static_cast<uint32_t>(Sizes.size());
		GetEngine().SetFrameIndex(First);
		for (size_t I = 0; I < Sizes.size(); ++I)
		{
			// The camera moves behind the change: where histories lie must be right as well.
			const double X = 0.5 + 0.01 * std::max(double(First + I) - double(Before), 0.0);
			FView View = LookAt({X, 1.7, 2.4}, {X - 0.05, 0.8, -1.5}, 1.2f, Sizes[I].x, Sizes[I].y);
			View.DeltaSeconds = 1.0f / 60.0f;
			View.bCut = I == 0;
			EXPECT_OK(GetEngine().RenderFrame(View, LitSeconds, Capture, &Captured));
		}
		return Captured.Get(ESignal::LocalDiffuse);
	}
};

// Colours follow another size without blocks. Where little is noisy, their picture is about as good as one that begins anew. When texels were
// taken as they are, its error was ten and fourteen times as large. A lamp's light shows steps at once, and so do borders of its shadows.
TEST_F(FColorHistoryTest, AnotherSizeShowsNoBlocks)
{
	ASSERT_TRUE(Load("stability-switch:1000"));
	for (const char* const Name : {"r.RT.Lights", "r.RT.Lights.Denoise"}) { SetVariable(Name, "1"); }
	SetVariable("r.RT.Lights.HalfResolution", "0");
	for (const glm::uvec2 Size : {glm::uvec2(144, 81), glm::uvec2(64, 36)})
	{
		std::vector<glm::uvec2> Sizes(Before, glm::uvec2(96, 54));
		Sizes.resize(Before + After, Size);
		const FImage Settled = RenderLast(std::vector<glm::uvec2>(Before + After, Size)),
		             Anew = RenderLast(std::vector<glm::uvec2>(After, Size));
		const double Carried = ComputeMeanSquare(RenderLast(Sizes), Settled), Fresh = ComputeMeanSquare(Anew, Settled);
		PrintFigure(fmt::format("{} x {} behind 96 x 54: error {:.3f} of that of a picture begun anew", Size.x, Size.y, Carried / Fresh));
		EXPECT_GT(Fresh, 0.0);
		EXPECT_LT(Carried, 1.5 * Fresh) << "2.1 if places are taken to lie off their centres for longer than the one frame";
	}
}

} // namespace
} // namespace Lantern
