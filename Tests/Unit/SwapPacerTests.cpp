// The rule for when pipelines are swapped, in a time of the test's own.
#include "SwapPacer.h"

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
	/// A frame that takes Duration, seen by whoever waits for it.
	void Frame(FSwapPacer::FSeconds Duration)
	{
		Pacer.FrameSubmitted(++Fence, Now);
		Pass(Duration);
		Pacer.FramesDone(Fence, Now, true);
	}
	void Pass(FSwapPacer::FSeconds Duration)
	{
		Now += std::chrono::duration_cast<std::chrono::steady_clock::duration>(Duration);
	}
	void Swap(FSwapPacer::FSeconds Duration)
	{
		Pacer.Swapped();
		Frame(Duration);
		Frame(10ms);
	}
	/// How long it is from now until a link may begin.
	double GetWait(bool bMore)
	{
		for (int Ms = 0; Ms < 1'000'000; ++Ms)
		{
			if (Pacer.MayLink(Now + std::chrono::milliseconds(Ms), bMore))
			{
				return 1e-3 * Ms;
			}
		}
		return -1.0;
	}

	FSwapPacer Pacer;
	FSwapPacer::FTime Now{};
	FRTFence Fence = 0;
};

TEST_F(FSwapPacerTest, NothingIsHeldBackWhereNoFrameIsReported)
{
	Pacer.Swapped();
	EXPECT_TRUE(Pacer.MayLink(Now, true));
}

TEST_F(FSwapPacerTest, CostIsWhatTheFirstFrameTakesBeyondThoseAroundIt)
{
	for (int I = 0; I < 5; ++I)
	{
		Frame(10ms);
	}
	Swap(510ms);
	EXPECT_NEAR(Pacer.GetCost().count(), 0.5, 1e-9);
	// Frames that become longer for good are no cost of a swap.
	Pacer.Swapped();
	Frame(300ms);
	Frame(250ms);
	EXPECT_NEAR(Pacer.GetCost().count(), 0.05, 1e-9);
}

TEST_F(FSwapPacerTest, SwapsTakeTheirShareOfTheTime)
{
	Frame(10ms);
	Swap(1010ms);
	EXPECT_NEAR(GetWait(false), 4.0 * 1.0 - 0.01, 2e-3) << "four fifths of the time are other frames'";
	Pacer.SetLimits(0.5, 100ms);
	EXPECT_NEAR(GetWait(false), 1.0 - 0.01, 2e-3);
	Pacer.SetLimits(1.0, 100ms);
	EXPECT_EQ(GetWait(false), 0.0);
}

TEST_F(FSwapPacerTest, NothingBeginsWhileACostIsBeingLearned)
{
	Frame(10ms);
	Pacer.Swapped();
	EXPECT_FALSE(Pacer.MayLink(Now + 1h, false)) << "the frame with the new pipeline has not begun";
	Pacer.FrameSubmitted(0, Now);
	EXPECT_FALSE(Pacer.MayLink(Now + 1h, false)) << "it was lost";
	Pacer.FrameSubmitted(++Fence, Now);
	EXPECT_FALSE(Pacer.MayLink(Now + 1h, false)) << "it is not done";
	Pacer.FramesDone(Fence, Now + 2s, true);
	EXPECT_TRUE(Pacer.MayLink(Now + 1h, false));
}

TEST_F(FSwapPacerTest, WaitsDoubleWhileMoreIsToComeUntilSwapsAreOneHundredth)
{
	Frame(10ms);
	double Expected = 4.0;
	for (int I = 0; I < 8; ++I)
	{
		Swap(1010ms);
		EXPECT_NEAR(GetWait(true) + 0.01, std::min(Expected, 99.0), 2e-3) << I;
		EXPECT_NEAR(GetWait(false) + 0.01, 4.0, 2e-3) << "the last one waits for its share only";
		Pacer.LinkStarted(true);
		Expected *= 2.0;
	}
	Pacer.LinkStarted(false);
	EXPECT_NEAR(GetWait(true) + 0.01, 4.0, 2e-3);
}

TEST_F(FSwapPacerTest, CheapSwapsWaitForLessThanAFrame)
{
	Frame(10ms);
	for (int I = 0; I < 8; ++I)
	{
		Swap(11ms);
		EXPECT_LE(GetWait(true), 0.004);
		Pacer.LinkStarted(true);
	}
}

TEST_F(FSwapPacerTest, FramesThatAreLookedAtLateCostNothing)
{
	// Two frames in flight, seen at the start of a frame 33 ms apart: how long each took is known to a frame only.
	for (int I = 0; I < 40; ++I)
	{
		if (I % 5 == 4)
		{
			Pacer.Swapped();
		}
		Pacer.FramesDone(Fence > 0 ? Fence - (I % 3 == 0 ? 1 : 0) : 0, Now, false);
		Pacer.FrameSubmitted(++Fence, Now);
		Pass(33ms);
	}
	EXPECT_EQ(Pacer.GetCost().count(), 0.0);
}

TEST_F(FSwapPacerTest, FrameBehindADearOneIsNotDear)
{
	Frame(10ms);
	Pacer.Swapped();
	Pacer.FrameSubmitted(1000, Now);
	Pacer.FrameSubmitted(1001, Now);
	Pass(2s);
	Pacer.FramesDone(1000, Now, true);
	Pass(10ms);
	Pacer.FramesDone(1001, Now, true);
	EXPECT_NEAR(Pacer.GetCost().count(), 1.99, 1e-6);
}

} // namespace
} // namespace Lantern
