// The rules of the RTPSO compiler without its threads: the test compiles and links what the scheduler hands out.
#include "Pipelines/RTPSOScheduler.h"

#include "RTPSOTestTools.h"

namespace Lantern
{
namespace
{

using namespace std::chrono_literals;

class FRTPSOSchedulerTest : public FPipelineTest
{
protected:
	void SetUp() override
	{
		FPipelineTest::SetUp();
		Capabilities.bPipelineLibraries = Capabilities.bLibraryOnlyPipelines = true;
		Scheduler = std::make_unique<FRTPSOScheduler>(
		    Capabilities, *Programs, [this] { return Now; }, [this] { ++Calls; });
	}
	void Frame()
	{
		Scheduler->BeginFrame(Wanted, Settings, false);
		Scheduler->Advance();
	}
	void Frames(int Count)
	{
		for (int I = 0; I < Count; ++I) { Frame(); }
	}
	void Compile(const FUnitTask& Task)
	{
		auto Build = std::make_shared<FPipelineBuild>();
		Build->Id = Task.Job.BuildId;
		Scheduler->StoreUnit(Task, {FRTStatus::Success(), std::move(Build), "key"});
	}
	void Fail(const FUnitTask& Task, ERTResult Result)
	{
		Scheduler->StoreUnit(Task, {FRTStatus::Error(Result, "%s: wrong", Task.Job.Unit.Name.c_str()), nullptr, "key"});
	}
	void CompileAll()
	{
		while (Scheduler->HasUnit()) { Compile(Scheduler->TakeUnit()); }
	}
	bool IsLinkAsked() const { return Scheduler->GetBackgroundWork() == EBackgroundWork::Link; }
	void Link(const FRTStatus& Status = FRTStatus::Success())
	{
		ASSERT_TRUE(IsLinkAsked());
		FLinkPlan Plan = Scheduler->TakeLink();
		Linked = Plan;
		Scheduler->StoreLink(Status, Status ? std::make_shared<const FRTPSO>() : nullptr, std::move(Plan), 1.0);
	}
	/// Everything that is wanted is compiled, linked and in use.
	void Settle()
	{
		Frame();
		CompileAll();
		Link();
		Frame();
		ASSERT_FALSE(IsLinkAsked());
		ASSERT_FALSE(Count().bBusy);
	}
	FRTPSOCompilerStats Count() const
	{
		FRTPSOCompilerStats Stats;
		Scheduler->Count(Stats);
		return Stats;
	}
	/// The state of Wanted.HitPrograms[Hit] in the newest link.
	ERTHitState GetLinkedState(size_t Hit) const { return Linked.Hits.at(Hit).State; }

	FRTCapabilities Capabilities;
	FRTPSOSettings Settings;
	std::chrono::steady_clock::time_point Now{1h};
	int Calls = 0; ///< for work
	FLinkPlan Linked;
	std::unique_ptr<FRTPSOScheduler> Scheduler;
};

TEST_F(FRTPSOSchedulerTest, AFrameStartsARoundAndItsEndStartsTheLink)
{
	Frame();
	EXPECT_EQ(Calls, 1);
	ASSERT_TRUE(Scheduler->HasUnit());
	EXPECT_TRUE(Count().bBusy);
	CompileAll();
	EXPECT_TRUE(IsLinkAsked()) << "without another frame";
	EXPECT_EQ(Calls, 2);
	Link();
	EXPECT_FALSE(Scheduler->GetCurrent()) << "a pipeline changes at the start of a frame only";
	EXPECT_EQ(Scheduler->GetResultCount(), 6u) << "five units and a link";
	Frame();
	EXPECT_TRUE(Scheduler->GetCurrent());
	EXPECT_EQ(Count().Links, 1u);
	EXPECT_FALSE(Count().bBusy);
	const auto Current = Scheduler->GetCurrent();
	Frames(3);
	EXPECT_EQ(Scheduler->GetCurrent(), Current);
	EXPECT_FALSE(Scheduler->HasUnit());
}

TEST_F(FRTPSOSchedulerTest, AUnitThatOutlivesItsRoundIsLinkedLater)
{
	ASSERT_NO_FATAL_FAILURE(Settle());
	AddProgram("Rust");
	AddProgram("Slow");
	Frame();
	const FUnitTask Rust = Scheduler->TakeUnit(), Slow = Scheduler->TakeUnit();
	Compile(Rust);
	EXPECT_FALSE(IsLinkAsked()) << "the round has time left";
	Now += Settings.RoundLength;
	Frame();
	ASSERT_NO_FATAL_FAILURE(Link());
	EXPECT_EQ(GetLinkedState(1), ERTHitState::Ready);
	EXPECT_EQ(GetLinkedState(2), ERTHitState::Missing);
	Frame();
	EXPECT_FALSE(Scheduler->HasUnit()) << "it is being compiled";
	Compile(Slow);
	Frame();
	ASSERT_NO_FATAL_FAILURE(Link());
	EXPECT_EQ(GetLinkedState(2), ERTHitState::Ready);
}

TEST_F(FRTPSOSchedulerTest, WhatARoundDidNotBeginComesBackInTheNext)
{
	ASSERT_NO_FATAL_FAILURE(Settle());
	AddProgram("Rust");
	AddProgram("Moss");
	Frame();
	const FUnitTask Rust = Scheduler->TakeUnit();
	Now += Settings.RoundLength;
	Compile(Rust); // ends the round: it is late
	EXPECT_FALSE(Scheduler->HasUnit());
	ASSERT_NO_FATAL_FAILURE(Link());
	Frame();
	ASSERT_TRUE(Scheduler->HasUnit());
	EXPECT_EQ(Scheduler->TakeUnit().Job.Unit.Name, "Moss MATERIAL opaque");
}

TEST_F(FRTPSOSchedulerTest, AnEditDuringACompileIsCompiledAgain)
{
	const uint32_t Rust = AddProgram("Rust");
	ASSERT_NO_FATAL_FAILURE(Settle());
	Programs->Edit(Rust, {.Name = "Rust", .Text = MakeText(77)});
	Frame();
	const FUnitTask Old = Scheduler->TakeUnit();
	Programs->Edit(Rust, {.Name = "Rust", .Text = MakeText(78)});
	Frame();
	EXPECT_FALSE(Scheduler->HasUnit()) << "not twice at once";
	Compile(Old);
	Frame();
	ASSERT_TRUE(Scheduler->HasUnit());
	const FUnitTask New = Scheduler->TakeUnit();
	EXPECT_GT(New.Job.Version, Old.Job.Version);
	EXPECT_EQ(New.Job.Unit.Program->Text, MakeText(78));
}

TEST_F(FRTPSOSchedulerTest, AFailureIsLoggedOnceAndNotTriedAgain)
{
	ASSERT_NO_FATAL_FAILURE(Settle());
	AddProgram("Rust");
	Frame();
	FLogCapture Log;
	Fail(Scheduler->TakeUnit(), ERTResult::CompileFailed);
	Frames(200);
	EXPECT_FALSE(Scheduler->HasUnit());
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), 1u);
	EXPECT_EQ(Count().Failures, 1u);
	EXPECT_EQ(Count().Failed, 1u);
	EXPECT_FALSE(Count().bBusy);
}

TEST_F(FRTPSOSchedulerTest, AShortageOfMemoryIsTriedAgainAfterSixtyFrames)
{
	ASSERT_NO_FATAL_FAILURE(Settle());
	AddProgram("Rust");
	Frame();
	FLogCapture Log;
	Fail(Scheduler->TakeUnit(), ERTResult::OutOfDeviceMemory);
	Frames(59);
	EXPECT_FALSE(Scheduler->HasUnit());
	Frame();
	ASSERT_TRUE(Scheduler->HasUnit());
	CompileAll();
	ASSERT_NO_FATAL_FAILURE(Link(FRTStatus::Error(ERTResult::OutOfDeviceMemory, "full")));
	Frames(59);
	EXPECT_FALSE(IsLinkAsked());
	Frame();
	EXPECT_TRUE(IsLinkAsked());
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), 0u);
}

TEST_F(FRTPSOSchedulerTest, ALinkThatTheDriverRefusesWaitsForAnotherPlan)
{
	ASSERT_NO_FATAL_FAILURE(Settle());
	const auto Before = Scheduler->GetCurrent();
	AddProgram("Rust");
	Frame();
	CompileAll();
	FLogCapture Log;
	ASSERT_NO_FATAL_FAILURE(Link(FRTStatus::Error(ERTResult::CompileFailed, "no")));
	Frames(200);
	EXPECT_FALSE(IsLinkAsked());
	EXPECT_EQ(Scheduler->GetCurrent(), Before);
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), 1u);
	AddProgram("Moss");
	Frame();
	CompileAll();
	EXPECT_TRUE(IsLinkAsked());
}

TEST_F(FRTPSOSchedulerTest, ALostDeviceGetsNoMoreWork)
{
	Frame();
	Fail(Scheduler->TakeUnit(), ERTResult::DeviceLost);
	EXPECT_TRUE(Scheduler->IsLost());
	EXPECT_FALSE(Scheduler->HasUnit());
	EXPECT_EQ(Scheduler->FindFatalError().Code, ERTResult::DeviceLost);
}

TEST_F(FRTPSOSchedulerTest, DearSwapsHoldProgramsBackAndNothingElse)
{
	ASSERT_NO_FATAL_FAILURE(Settle());
	Scheduler->GetPacer().FrameSubmitted(1);
	Scheduler->GetPacer().FrameDone(1, 10s, Now);
	Scheduler->GetPacer().FrameSubmitted(2);
	Scheduler->GetPacer().FrameDone(2, 10ms, Now);
	AddProgram("Rust");
	Frame();
	CompileAll();
	Frames(3);
	EXPECT_FALSE(IsLinkAsked());
	EXPECT_TRUE(Count().bBusy) << "it is still to come";
	Wanted.RayGens.push_back(MakeShader("Second"));
	Frame();
	CompileAll();
	ASSERT_NO_FATAL_FAILURE(Link());
	EXPECT_EQ(GetLinkedState(1), ERTHitState::Ready) << "it comes along";
}

TEST_F(FRTPSOSchedulerTest, WhatIsHeldBackComesWhenItsTimeIsOver)
{
	ASSERT_NO_FATAL_FAILURE(Settle());
	Scheduler->GetPacer().FrameSubmitted(1);
	Scheduler->GetPacer().FrameDone(1, 10s, Now);
	AddProgram("Rust");
	Frame();
	CompileAll();
	Frames(3);
	ASSERT_FALSE(IsLinkAsked());
	Now += 39s;
	Frames(3);
	EXPECT_FALSE(IsLinkAsked()) << "a fifth of the time";
	Now += 1s;
	Frame();
	EXPECT_TRUE(IsLinkAsked());
}

TEST_F(FRTPSOSchedulerTest, SwapsForMaterialsAreAtLeastSoManyFramesApart)
{
	ASSERT_NO_FATAL_FAILURE(Settle());
	Settings.SwapFrames = 10;
	AddProgram("Rust");
	int Waited = 0;
	for (; Waited < 100 && !IsLinkAsked(); ++Waited)
	{
		Frame();
		CompileAll();
	}
	EXPECT_EQ(Waited, 10) << "since the swap that Settle ended with";
	ASSERT_NO_FATAL_FAILURE(Link());
	Frame(); // takes it over
	AddProgram("Moss");
	Frame();
	CompileAll();
	Frames(3);
	EXPECT_FALSE(IsLinkAsked());
	EXPECT_TRUE(Count().bBusy) << "it is still to come";
	Wanted.RayGens.push_back(MakeShader("Second"));
	Frame();
	CompileAll();
	EXPECT_TRUE(IsLinkAsked()) << "a setting does not wait";
}

TEST_F(FRTPSOSchedulerTest, FinishNeedsNoStandInsAndTheNextOneHasNothingToDo)
{
	AddProgram("Rust");
	Scheduler->BeginFrame(Wanted, Settings, true);
	ASSERT_FALSE(Scheduler->BeginFinish());
	ASSERT_FALSE(Scheduler->AdvanceUnits());
	EXPECT_EQ(Scheduler->GetProgress(), 0.0f);
	Now += 1h; // it has no deadline
	CompileAll();
	EXPECT_FALSE(IsLinkAsked()) << "nothing but the exact link";
	ASSERT_TRUE(Scheduler->AdvanceUnits());
	EXPECT_EQ(Scheduler->GetProgress(), 1.0f);
	EXPECT_TRUE(Scheduler->FindFatalError());
	EXPECT_FALSE(Scheduler->AddStandIns(Wanted));
	EXPECT_FALSE(Scheduler->AdvanceLink().has_value());
	EXPECT_TRUE(Scheduler->IsLinkUnderWay());
	ASSERT_NO_FATAL_FAILURE(Link());
	EXPECT_TRUE(Linked.StandIns.empty());
	const auto Status = Scheduler->AdvanceLink();
	ASSERT_TRUE(Status.has_value());
	EXPECT_TRUE(*Status);
	EXPECT_TRUE(Scheduler->GetCurrent());
	Scheduler->EndFinish(*Status);
	Scheduler->BeginFrame(Wanted, Settings, true);
	EXPECT_TRUE(Scheduler->BeginFinish());
}

TEST_F(FRTPSOSchedulerTest, FinishAddsStandInsForProgramsThatFail)
{
	AddProgram("Rust");
	Scheduler->BeginFrame(Wanted, Settings, true);
	ASSERT_FALSE(Scheduler->BeginFinish());
	ASSERT_FALSE(Scheduler->AdvanceUnits());
	const FLogCapture Log;
	while (Scheduler->HasUnit())
	{
		const FUnitTask Task = Scheduler->TakeUnit();
		if (Task.Job.Unit.Name.starts_with("Rust")) { Fail(Task, ERTResult::CompileFailed); }
		else { Compile(Task); }
	}
	ASSERT_TRUE(Scheduler->AdvanceUnits());
	ASSERT_TRUE(Scheduler->AddStandIns(Wanted));
	ASSERT_FALSE(Scheduler->AdvanceUnits());
	CompileAll();
	ASSERT_TRUE(Scheduler->AdvanceUnits());
	EXPECT_FALSE(Scheduler->AdvanceLink().has_value());
	ASSERT_NO_FATAL_FAILURE(Link());
	EXPECT_EQ(Linked.StandIns.size(), 1u);
	EXPECT_EQ(GetLinkedState(1), ERTHitState::Missing);
}

TEST_F(FRTPSOSchedulerTest, FinishReturnsAFailedLinkAndTriesAShortageAgain)
{
	for (const auto& [Result, bAgain] : {std::pair(ERTResult::OutOfDeviceMemory, true), std::pair(ERTResult::CompileFailed, false)})
	{
		const FLogCapture Log;
		Wanted.RayGens[0].Defines.emplace_back("V", "1"); // another plan
		Scheduler->BeginFrame(Wanted, Settings, true);
		ASSERT_FALSE(Scheduler->BeginFinish());
		ASSERT_FALSE(Scheduler->AdvanceUnits());
		CompileAll();
		ASSERT_TRUE(Scheduler->AdvanceUnits());
		ASSERT_FALSE(Scheduler->AdvanceLink().has_value());
		ASSERT_NO_FATAL_FAILURE(Link(FRTStatus::Error(Result, "no")));
		const auto Status = Scheduler->AdvanceLink();
		ASSERT_TRUE(Status.has_value());
		EXPECT_EQ(Status->Code, Result);
		Scheduler->EndFinish(*Status);
		Scheduler->BeginFrame(Wanted, Settings, true);
		ASSERT_FALSE(Scheduler->BeginFinish());
		ASSERT_TRUE(Scheduler->AdvanceUnits());
		EXPECT_EQ(!Scheduler->AdvanceLink().has_value(), bAgain);
		if (bAgain) { ASSERT_NO_FATAL_FAILURE(Link()); }
	}
}

TEST_F(FRTPSOSchedulerTest, TheBackgroundThreadLinksFirstAndEmptiesTheTrashLast)
{
	Frame();
	CompileAll();
	Scheduler->AskForEdits();
	ASSERT_NO_FATAL_FAILURE(Link());
	EXPECT_EQ(Scheduler->GetBackgroundWork(), EBackgroundWork::FindEdits);
	EXPECT_TRUE(Count().bBusy);
	Scheduler->StoreEdits({});
	ASSERT_EQ(Scheduler->GetBackgroundWork(), EBackgroundWork::EmptyTrash) << "the shaders of the round";
	Scheduler->GetTrash().Take();
	EXPECT_EQ(Scheduler->GetBackgroundWork(), EBackgroundWork::None);
}

TEST_F(FRTPSOSchedulerTest, EditsAreLookedForInIntervals)
{
	ASSERT_NO_FATAL_FAILURE(Settle());
	Scheduler->GetTrash().Take();
	Frame();
	EXPECT_EQ(Scheduler->GetBackgroundWork(), EBackgroundWork::None);
	Settings.ReloadSeconds = 2.0f;
	Frame();
	ASSERT_EQ(Scheduler->GetBackgroundWork(), EBackgroundWork::FindEdits);
	Scheduler->StoreEdits({});
	Now += 2s;
	Frame();
	EXPECT_EQ(Scheduler->GetBackgroundWork(), EBackgroundWork::None);
	Now += 1ms;
	Frame();
	ASSERT_EQ(Scheduler->GetBackgroundWork(), EBackgroundWork::FindEdits);
	Scheduler->StoreEdits({Scheduler->GetUnits().ListSettled().front()});
	Frame();
	EXPECT_TRUE(Scheduler->HasUnit()) << "what was edited is compiled again";
}

} // namespace
} // namespace Lantern
