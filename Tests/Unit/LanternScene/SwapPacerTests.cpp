// The rule for when pipelines are swapped, in a time of the test's own.
#include "Pipelines/SwapPacer.h"

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

using namespace std::chrono_literals;

class FSwapPacerTest : public ::testing::Test
{
protected:
	void SetUp() override { Pacer.SetLimits(0.2, 100ms); }
	void Pass(FSwapPacer::FSeconds Duration) { Now += std::chrono::duration_cast<std::chrono::steady_clock::duration>(Duration); }
	void Submit() { Pacer.FrameSubmitted(++Submitted); }
	void Finish(FSwapPacer::FSeconds Duration)
	{
		Pass(Duration);
		Pacer.FrameDone(++Done, Duration, Now);
	}
	void Frame(FSwapPacer::FSeconds Duration)
	{
		Submit();
		Finish(Duration);
	}
	void Swap(FSwapPacer::FSeconds Duration)
	{
		Pacer.Swapped();
		Frame(Duration);
		Frame(10ms);
	}
	/// Seconds from now until a link may begin; programs are asked for all the time, or no more.
	double GetWait(bool bDoubles, bool bAsked)
	{
		const FSwapPacer::FSwap Swap = bDoubles ? Doubles : Few;
		FSwapPacer Copy = Pacer;
		for (int Ms = 0; Ms < 1'000'000; ++Ms)
		{
			const auto Then = Now + std::chrono::milliseconds(Ms);
			if (bAsked) { Copy.ProgramsAsked(Then); }
			if (Copy.MayLink(Then, Swap)) { return 1e-3 * Ms; }
		}
		return -1.0;
	}

	static constexpr FSwapPacer::FSwap Doubles{10, 10, false}, Few{10, 1, false};
	FSwapPacer Pacer;
	FSwapPacer::FTime Now{};
	uint64_t Submitted = 0, Done = 0;
};

TEST_F(FSwapPacerTest, NothingIsHeldBackWhereNoDurationIsKnown)
{
	Pacer.Swapped();
	EXPECT_TRUE(Pacer.MayLink(Now, Few));
	Submit();
	EXPECT_TRUE(Pacer.MayLink(Now, Few));
}

TEST_F(FSwapPacerTest, CostIsWhatTheFirstFrameTakesBeyondThoseAroundIt)
{
	for (int I = 0; I < 5; ++I) { Frame(10ms); }
	Swap(510ms);
	EXPECT_NEAR(Pacer.GetCost().count(), 0.5, 1e-9);
	// Frames that become longer for good are no cost of a swap.
	Pacer.Swapped();
	Frame(300ms);
	Frame(250ms);
	EXPECT_NEAR(Pacer.GetCost().count(), 0.05, 1e-9);
}

TEST_F(FSwapPacerTest, FirstPipelineOfAllIsASwapToo)
{
	Swap(10s);
	EXPECT_NEAR(Pacer.GetCost().count(), 9.99, 1e-9);
	Swap(10s);
	EXPECT_NEAR(Pacer.GetCost().count(), 9.99, 1e-9) << "what the first one took counts as a usual frame";
}

TEST_F(FSwapPacerTest, SwapsTakeTheirShareOfTheTime)
{
	Frame(10ms);
	Swap(1010ms);
	EXPECT_NEAR(GetWait(true, true), 4.0 - 0.01, 2e-3) << "four fifths of the time are other frames'";
	Pacer.SetLimits(0.5, 100ms);
	EXPECT_NEAR(GetWait(true, true), 1.0 - 0.01, 2e-3);
	Pacer.SetLimits(1.0, 100ms);
	EXPECT_EQ(GetWait(false, true), 0.0);
}

TEST_F(FSwapPacerTest, NothingBeginsWhileACostIsBeingLearned)
{
	Frame(10ms);
	Pacer.Swapped();
	EXPECT_FALSE(Pacer.MayLink(Now + 1h, Doubles)) << "the frame with the new pipeline has not begun";
	Submit();
	EXPECT_FALSE(Pacer.MayLink(Now + 1h, Doubles)) << "it is not done";
	// A second one follows before the first is done.
	Pacer.Swapped();
	Submit();
	Finish(2s);
	EXPECT_FALSE(Pacer.MayLink(Now + 1h, Doubles)) << "the second is not done";
	Finish(3s);
	EXPECT_TRUE(Pacer.MayLink(Now + 1h, Doubles));
	EXPECT_NEAR(Pacer.GetCost().count(), 2.99, 1e-9);
}

TEST_F(FSwapPacerTest, FirstFrameWhoseDurationNeverComesIsForgotten)
{
	Frame(10ms);
	Pacer.Swapped();
	Submit();
	++Done;
	Frame(10ms);
	EXPECT_TRUE(Pacer.MayLink(Now, Doubles));
	EXPECT_EQ(Pacer.GetCost().count(), 0.0);
}

TEST_F(FSwapPacerTest, DearSwapsWaitUntilTheyDoubleOrNothingIsAskedFor)
{
	Frame(10ms);
	Swap(1010ms);
	EXPECT_NEAR(GetWait(true, true) + 0.01, 4.0, 2e-3);
	EXPECT_NEAR(GetWait(false, false) + 0.01, 4.0, 2e-3) << "nothing more is to come";
	EXPECT_NEAR(GetWait(false, true) + 0.01, 99.0, 2e-3) << "swaps are one hundredth of the time";
	Pacer.ProgramsAsked(Now + 3s);
	EXPECT_NEAR(GetWait(false, false), 7.0, 2e-3) << "as long as a wait after what was asked for last";
}

TEST_F(FSwapPacerTest, DearSwapsWaitForWhatIsBeingCompiledAsLongAsTheyTake)
{
	Frame(10ms);
	Swap(1010ms);
	Pass(1h);
	Pacer.ProgramsAsked(Now);
	Pass(500ms);
	Pacer.ProgramsAsked(Now);
	EXPECT_TRUE(Pacer.MayLink(Now, {10, 30, false}));
	EXPECT_FALSE(Pacer.MayLink(Now + 3400ms, {10, 30, true})) << "four times as many programs: 4 s";
	EXPECT_TRUE(Pacer.MayLink(Now + 3600ms, {10, 30, true}));
	EXPECT_TRUE(Pacer.MayLink(Now + 15600ms, {1, 300, true})) << "16 s at most";
	Pacer.LinkStarted();
	Pacer.ProgramsAsked(Now + 1h);
	EXPECT_FALSE(Pacer.MayLink(Now + 1h + 3900ms, {10, 30, true})) << "counted from what was asked for first since then";
}

TEST_F(FSwapPacerTest, CheapSwapsWaitForLessThanAFrame)
{
	Frame(10ms);
	for (int I = 0; I < 8; ++I)
	{
		Swap(11ms);
		EXPECT_LE(GetWait(false, true), 0.004);
	}
}

} // namespace
} // namespace Lantern
