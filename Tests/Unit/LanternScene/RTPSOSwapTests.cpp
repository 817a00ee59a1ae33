// The RTPSO compiler on a device whose first frame with a new pipeline takes long. The tests count the swaps that many
// programs need, and the share of the time that swaps take. Time passes with the test's frames only, and one program is
// compiled in each, so that the figures are those of any machine.
#include <atomic>

#include <fmt/format.h>

#include "RTPSOTestTools.h"

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
		// A link that was asked for is there in the next frame, so that figures do not depend on how soon its thread runs.
		const auto AreLinked = [&] {
			return Device->CountAsked("RTPSO") == Device->Mock().CountCalls(ERTMockCall::CreateRayTracingPipeline, "RTPSO");
		};
		ASSERT_TRUE(WaitUntil("a link", AreLinked));
		Maker->Update(Wanted);
		double Ms = FrameMs;
		if (Maker->GetCurrent() != Last)
		{
			Last = Maker->GetCurrent();
			const double Cost = SwapMs + PerGroupMs * (Last->GetHitGroupCount() - Last->GetMissingCount());
			if (Swaps++ == 0) { FirstSwap = NowMs; }
			else { WorstShare = std::max(WorstShare, SwapTime / (NowMs - FirstSwap)); }
			SwapTime += Cost;
			Ms += Cost;
		}
		Maker->FrameSubmitted(++Number);
		NowMs = NowMs + Ms;
		Maker->FrameDone(Number, Ms);
	}
	void Settle()
	{
		const auto IsSettled = [&] { return Maker->GetCurrent() && !Maker->GetStats().bBusy; };
		ASSERT_TRUE(WaitUntil("the compiler to settle", IsSettled, [&] { Frame(), GiveWay(); }));
		Swaps = 0;
		SwapTime = WorstShare = 0.0;
	}

	/// Runs frames until Count new programs are in use. One is compiled in each frame. bStream: one is asked for in each frame,
	/// else all at once.
	void Arrive(uint32_t Count, bool bStream = false)
	{
		std::vector<FHitProgram> Arrived;
		const auto Ask = [&](uint32_t I) {
			Device->Close(NameOf(I));
			Arrived.push_back(Opaque(AddProgram(NameOf(I))));
		};
		for (uint32_t I = 0; I < Count && !bStream; ++I) { Ask(I); }
		for (uint32_t I = 0; I < Count; ++I)
		{
			if (bStream) { Ask(I); }
			const uint64_t Before = GetCompiled();
			Device->Open(NameOf(I));
			const auto IsCompiled = [&] { return GetCompiled() > Before; };
			ASSERT_TRUE(WaitUntil("a compile", IsCompiled, [&] { Maker->Update(Wanted), GiveWay(); }));
			ASSERT_NO_FATAL_FAILURE(Frame());
		}
		const auto AreReady = [&] { return std::all_of(Arrived.begin(), Arrived.end(), [&](FHitProgram P) { return IsReady(P); }); };
		ASSERT_TRUE(WaitUntil("all programs", AreReady, [&] { Frame(), GiveWay(); }));
	}
	/// A swap has just taken a minute: four more would pass until the next one may begin.
	void MakeDear()
	{
		SwapMs = 60'000.0;
		FrameMs = 1000.0;
		ASSERT_NO_FATAL_FAILURE(Settle());
		ASSERT_NO_FATAL_FAILURE(Arrive(1));
	}
	/// A program that is compiled, and would not be used for minutes. Time stands still.
	void Hold()
	{
		Held = AddProgram("Held");
		const auto IsHeld = [&] {
			const FRTPSOCompilerStats& Stats = Maker->GetStats();
			return Stats.Ready == Stats.Wanted && Stats.bBusy;
		};
		ASSERT_TRUE(WaitUntil("a compile", IsHeld, [&] { Maker->Update(Wanted), GiveWay(); }));
		for (int I = 0; I < 100; ++I)
		{
			Maker->Update(Wanted);
			ASSERT_FALSE(IsReady(Opaque(Held)));
		}
		EXPECT_TRUE(Maker->GetStats().bBusy) << "it is still to come";
	}
	static std::string NameOf(uint32_t Index) { return "Late" + std::to_string(1000 + Index); }
	uint64_t GetCompiled() { return Maker->GetStats().Compiled; }

	std::atomic<double> NowMs = 1000.0;
	double FrameMs = 16.0, SwapMs = 0.0, PerGroupMs = 0.0;
	std::shared_ptr<const FRTPSO> Last;
	uint64_t Number = 0; ///< of the frame
	uint32_t Held = 0;
	uint32_t Swaps = 0;
	double SwapTime = 0.0, FirstSwap = 0.0;
	/// When a swap began: what those before had taken of the time since the first one began.
	double WorstShare = 0.0;
};

TEST_F(FPipelineSwapTest, DearSwapsAreFewAndTakeAFifthOfTheTime)
{
	// 256 programs take 4 s to compile. Swaps are dear by themselves, by their size, and both.
	const std::pair<double, double> Costs[] = {{50.0, 0.0}, {1000.0, 0.0}, {0.0, 5.0}, {200.0, 20.0}};
	for (const auto& [Fixed, PerGroup] : Costs)
	{
		for (const bool bStream : {false, true})
		{
			SCOPED_TRACE(fmt::format("{} + {} ms, stream {}", Fixed, PerGroup, bStream));
			ASSERT_NO_FATAL_FAILURE(Restart());
			SwapMs = Fixed;
			PerGroupMs = PerGroup;
			ASSERT_NO_FATAL_FAILURE(Settle());
			ASSERT_NO_FATAL_FAILURE(Arrive(256, bStream));
			EXPECT_GE(Swaps, 1u);
			EXPECT_LE(Swaps, 10u) << "one for each doubling, the first and the last";
			EXPECT_LE(WorstShare, 0.2 + 0.01);
			fmt::print("[  figure  ] {} + {} ms a swap, {}: {} swaps, {:.3f} of the time before the last\n", Fixed, PerGroup,
			    bStream ? "one by one" : "at once", Swaps, WorstShare);
		}
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
		if (Expected == 0) { Expected = Swaps; }
	}
	EXPECT_GE(Expected, 15u);
	EXPECT_GE(Swaps * 10, Expected * 8);
}

TEST_F(FPipelineSwapTest, WhatASettingAsksForIsNotHeldBack)
{
	ASSERT_NO_FATAL_FAILURE(MakeDear());
	ASSERT_NO_FATAL_FAILURE(Hold());
	Wanted.RayGens.push_back(MakeShader("Another"));
	const auto HasRayGen = [&] { return Maker->GetCurrent()->FindRayGen(Wanted.RayGens[1]) != NoRayGen; };
	ASSERT_TRUE(WaitUntil("the ray generation shader", HasRayGen, [&] { Maker->Update(Wanted), GiveWay(); }));
	EXPECT_TRUE(IsReady(Opaque(Held))) << "what was held comes with it";
	UntilIdle();
}

TEST_F(FPipelineSwapTest, FinishWaitsForNothingElse)
{
	ASSERT_NO_FATAL_FAILURE(MakeDear());
	ASSERT_NO_FATAL_FAILURE(Hold());
	ASSERT_NO_FATAL_FAILURE(FinishWanted());
	EXPECT_TRUE(IsReady(Opaque(Held)));
	UntilIdle();
}

TEST_F(FPipelineSwapTest, NothingIsHeldWhereItWouldBeAHole)
{
	Set("r.RT.Pipeline.Fallback", "0");
	ASSERT_NO_FATAL_FAILURE(MakeDear());
	const uint32_t Program = AddProgram("Seen");
	ASSERT_TRUE(WaitUntil(
	    "the program", [&] { return IsReady(Opaque(Program)); }, [&] { Maker->Update(Wanted), GiveWay(); }));
}

TEST_F(FPipelineSwapTest, WhatNeverCompilesKeepsNobodyBusy)
{
	ASSERT_NO_FATAL_FAILURE(MakeDear());
	ASSERT_NO_FATAL_FAILURE(Hold());
	FLogCapture Log;
	Wanted.RayTypes[1].Miss = MakeShader("Broken.miss", "void main() { nonsense; }\n");
	const auto IsSettled = [&] { return Maker->GetStats().Failed > 0 && !Maker->GetStats().bBusy; };
	ASSERT_TRUE(WaitUntil("the failure", IsSettled, [&] { Maker->Update(Wanted), GiveWay(); }));
}

} // namespace
} // namespace Lantern
