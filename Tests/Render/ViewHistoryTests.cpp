// What is accumulated while the picture itself changes: its resolution, and the jitter of its frames.
#include "DenoiseFixture.h"

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

} // namespace
} // namespace Lantern
