// The RTPSO compiler on a device whose first frame with a new pipeline takes long: how many swaps many programs need, and how
// much of the time they take. Time passes with the test's frames only, and a program is compiled in each, so that the figures
// are those of any machine.
#include <atomic>

#include "PipelineTestTools.h"

namespace Lantern
{
namespace
{

class FPipelineSwapTest : public FPipelineTest
{
protected:
	void SetUp() override
	{
		FPipelineTest::SetUp();
		Set("r.RT.Pipeline.Threads", "1");
		Set("r.RT.Pipeline.RoundMs", "100");
		Restart();
	}
	void TearDown() override
	{
		Last.reset();
		FPipelineTest::TearDown();
	}
	void Restart()
	{
		Last.reset();
		Start({});
		Maker = std::make_unique<FRTPSOCompiler>(*Device, *Compiler, *Programs, [this] { return GetTime(); });
	}
	std::chrono::steady_clock::time_point GetTime() const
	{
		return std::chrono::steady_clock::time_point(std::chrono::nanoseconds(static_cast<int64_t>(NowMs * 1e6)));
	}

	/// The first that uses a pipeline takes SwapMs, and PerGroupMs for each of its hit groups, longer.
	void Frame()
	{
		Maker->Update(Wanted);
		double Ms = FrameMs;
		if (Maker->GetCurrent() != Last)
		{
			Last = Maker->GetCurrent();
			const double Cost = SwapMs + PerGroupMs * (Last->GetHitGroupCount() - Last->GetMissingCount());
			if (Swaps++ == 0)
			{
				FirstSwap = NowMs;
			}
			else
			{
				WorstShare = std::max(WorstShare, SwapTime / (NowMs - FirstSwap));
			}
			SwapTime += Cost;
			Ms += Cost;
		}
		Maker->FrameSubmitted(++Fence);
		NowMs = NowMs + Ms;
		Maker->FramesDone(Fence, true);
	}
	void Settle()
	{
		const auto IsSettled = [&] { return Maker->GetCurrent() && !Maker->GetStats().bBusy; };
		ASSERT_TRUE(WaitUntil("the compiler to settle", IsSettled, [&] { Frame(), GiveWay(); }));
		Swaps = 0;
		SwapTime = WorstShare = 0.0;
	}

	/// Count programs, of which one is compiled in each frame, until all are in use.
	void Arrive(uint32_t Count)
	{
		std::vector<std::string> Names;
		std::vector<FHitProgram> Arrived;
		for (uint32_t I = 0; I < Count; ++I)
		{
			Names.push_back("Late" + std::to_string(1000 + I));
			Arrived.push_back(Opaque(AddProgram(Names.back())));
			Device->Close(Names.back());
		}
		for (const std::string& Name : Names)
		{
			const uint64_t Before = GetCompiled();
			Device->Open(Name);
			ASSERT_TRUE(WaitUntil(
			    "a compile", [&] { return GetCompiled() > Before; }, [&] { Maker->Update(Wanted), GiveWay(); }));
			Frame();
		}
		const auto AreReady = [&]
		{ return std::all_of(Arrived.begin(), Arrived.end(), [&](FHitProgram P) { return IsReady(P); }); };
		ASSERT_TRUE(WaitUntil("all programs", AreReady, [&] { Frame(), GiveWay(); }));
	}
	uint64_t GetCompiled() { return Maker->GetStats().Compiled; }

	std::atomic<double> NowMs = 1000.0;
	double FrameMs = 16.0, SwapMs = 0.0, PerGroupMs = 0.0;
	std::shared_ptr<const FRTPSO> Last;
	FRTFence Fence = 0;
	uint32_t Swaps = 0;
	double SwapTime = 0.0, FirstSwap = 0.0;
	/// When a swap began: what those before had taken of the time since the first one began.
	double WorstShare = 0.0;
};

TEST_F(FPipelineSwapTest, DearSwapsAreFewAndTakeAFifthOfTheTime)
{
	// 256 programs take 4 s to compile. Each time: a swap that is dear by itself, one that is dear by its size, and both.
	const std::pair<double, double> Costs[] = {{50.0, 0.0}, {1000.0, 0.0}, {0.0, 5.0}, {200.0, 20.0}};
	for (const auto& [Fixed, PerGroup] : Costs)
	{
		SCOPED_TRACE(std::to_string(Fixed) + " + " + std::to_string(PerGroup) + " ms");
		ASSERT_NO_FATAL_FAILURE(Restart());
		SwapMs = Fixed;
		PerGroupMs = PerGroup;
		ASSERT_NO_FATAL_FAILURE(Settle());
		ASSERT_NO_FATAL_FAILURE(Arrive(256));
		EXPECT_GE(Swaps, 1u);
		EXPECT_LE(Swaps, 9u) << "one for each doubling, and the last";
		EXPECT_LE(WorstShare, 0.2 + 0.01);
		std::printf("[  figure  ] %.0f + %.0f ms a swap: %u swaps, %.3f of the time before the last\n", Fixed, PerGroup,
		            Swaps, WorstShare);
	}
}

TEST_F(FPipelineSwapTest, WithoutALimitEveryRoundIsASwap)
{
	// What the test above would see if nothing were held back: a fault that it must notice.
	Set("r.RT.Pipeline.SwapShare", "1");
	SwapMs = 50.0;
	ASSERT_NO_FATAL_FAILURE(Settle());
	ASSERT_NO_FATAL_FAILURE(Arrive(256));
	EXPECT_GE(Swaps, 20u);
	EXPECT_GT(WorstShare, 0.25);
}

TEST_F(FPipelineSwapTest, CheapSwapsAreNotHeldBack)
{
	uint32_t Expected = 0;
	for (const char* Share : {"1", "0.2"})
	{
		ASSERT_NO_FATAL_FAILURE(Restart());
		Set("r.RT.Pipeline.SwapShare", Share);
		SwapMs = 1.1;
		ASSERT_NO_FATAL_FAILURE(Settle());
		ASSERT_NO_FATAL_FAILURE(Arrive(128));
		if (Expected == 0)
		{
			Expected = Swaps;
		}
	}
	EXPECT_GE(Expected, 15u);
	EXPECT_GE(Swaps * 10, Expected * 8);
}

TEST_F(FPipelineSwapTest, WhatASettingAsksForIsNotHeldBack)
{
	SwapMs = 60'000.0;
	FrameMs = 1000.0;
	ASSERT_NO_FATAL_FAILURE(Settle());
	ASSERT_NO_FATAL_FAILURE(Arrive(1));
	// Four minutes would pass until another program may come.
	const double Before = NowMs;
	const uint32_t Program = AddProgram("Held");
	for (int I = 0; I < 50; ++I)
	{
		Frame(), GiveWay();
	}
	ASSERT_TRUE(WaitUntil(
	    "a compile", [&] { return Maker->GetStats().Ready == Maker->GetStats().Wanted; }, [&] { Frame(), GiveWay(); }));
	EXPECT_FALSE(IsReady(Opaque(Program)));
	EXPECT_TRUE(Maker->GetStats().bBusy) << "it is still to come";
	SwapMs = 0.0;
	Wanted.RayGens.push_back(MakeShader("Another"));
	const auto HasRayGen = [&] { return Maker->GetCurrent()->FindRayGen(Wanted.RayGens[1]) != NoRayGen; };
	ASSERT_TRUE(WaitUntil("the ray generation shader", HasRayGen, [&] { Maker->Update(Wanted), GiveWay(); }));
	EXPECT_LT(NowMs - Before, 200'000.0);
	EXPECT_TRUE(IsReady(Opaque(Program))) << "and what was held comes with it";
}

TEST_F(FPipelineSwapTest, FinishWaitsForNothingElse)
{
	SwapMs = 60'000.0;
	ASSERT_NO_FATAL_FAILURE(Settle());
	const uint32_t Program = AddProgram("Now");
	ASSERT_NO_FATAL_FAILURE(FinishWanted());
	EXPECT_TRUE(IsReady(Opaque(Program)));
}

} // namespace
} // namespace Lantern
