// The rules of the RTPSO compiler: rounds, links, and what is tried again.
#include "Pipelines/RTPSOScheduler.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace Lantern
{

namespace
{
constexpr uint64_t RetryFrames = 60; ///< after a shortage of memory
} // namespace

FRTPSOScheduler::FRTPSOScheduler(
    const FRTCapabilities& Capabilities, const FMaterialPrograms& Programs, FPipelineTimeSource InTime, std::function<void()> InOnWork)
    : Time(std::move(InTime)),
      OnWork(std::move(InOnWork)),
      Units(Capabilities, Programs)
{}

void FRTPSOScheduler::BeginFrame(const FRTPSODesc& Desc, const FRTPSOSettings& InSettings, bool bFinish)
{
	++Frame;
	TakeOverLink();
	if ((InSettings.Fallback == ERTFallback::Skip) != (Settings.Fallback == ERTFallback::Skip))
	{
		bDirty = true;
		bFinished = false;
	}
	Settings = InSettings;
	Pacer.SetLimits(Settings.SwapShare, Settings.RoundLength);
	SetWanted(Desc, bFinish ? std::nullopt : std::optional(Settings.Fallback == ERTFallback::StandIn));
	if (RetryFrame > 0 && Frame >= RetryFrame)
	{
		RetryFrame = 0;
		Links.ForgetFailure();
		bDirty = true;
	}
	DropOld();
}

void FRTPSOScheduler::SetWanted(const FRTPSODesc& Desc, std::optional<bool> StandIns)
{
	if (!Units.SetWanted(Desc, Settings.bLibraries, StandIns, Frame)) { return; }
	bDirty = true;
	bFinished = false;
}

void FRTPSOScheduler::TakeOverLink()
{
	if (!Links.IsDone()) { return; }
	bDirty = true; // more may have become ready since
	if (!Links.Take(Frame)) { return; }
	++Stats.Links;
	LastSwap = Frame;
	Pacer.Swapped();
}

void FRTPSOScheduler::Advance()
{
	CloseRoundIfOver();
	if (std::exchange(bDirty, false))
	{
		StartRound(false);
		StartLink(false);
	}
	else if (bHeld && MayLink()) { StartLink(false); }
	if (Settings.ReloadSeconds > 0.0f && Time() > NextFindEdits)
	{
		NextFindEdits = Time() + std::chrono::milliseconds(static_cast<int64_t>(Settings.ReloadSeconds * 1000.0f));
		AskForEdits();
	}
}

void FRTPSOScheduler::AskForEdits()
{
	bFindEdits = true;
	OnWork();
}

void FRTPSOScheduler::StartRound(bool bAppend)
{
	if (Round.IsOpen() && !bAppend) { return; }
	const std::vector<FUnitStateRef> Missing = Units.FindMissing(Frame);
	if (Missing.empty()) { return; }
	Pacer.ProgramsAsked(Time());
	Round.Add(Missing, Time() + Settings.RoundLength);
	OnWork();
}

void FRTPSOScheduler::CloseRoundIfOver()
{
	if (!Round.IsOpen() || !Round.IsOver(Time(), !bNoDeadline)) { return; }
	Round.Close(Trash);
	bDirty = true;
	if (!bNoDeadline) { StartLink(false); }
}

FLinkPlan FRTPSOScheduler::MakePlan() const
{
	return MakeLinkPlan(Units.GetWanted(), Units.GetDesc(), Settings.Fallback != ERTFallback::Skip);
}

void FRTPSOScheduler::StartLink(bool bExact)
{
	if (!Links.IsIdle() || (Round.IsOpen() && !bExact)) { return; }
	bHeld = false;
	FLinkPlan Plan = MakePlan();
	if (!Plan.bComplete) { return; }
	const FLinkedRTPSO& Current = Links.GetCurrent();
	const auto IsCovered = [&] { return CoversFrame(Current.Plan, Plan) && CountNewPrograms(Current.Plan, Plan) == 0; };
	if (Current.Pipeline && (bExact ? Current.Plan.Key == Plan.Key : IsCovered())) { return; }
	if (!bExact && (Links.HasFailed(Plan) || HoldBack(Plan))) { return; }
	if (Links.Ask(std::move(Plan), bExact)) { OnWork(); }
}

/// Whether the time has come for HeldSwap.
bool FRTPSOScheduler::MayLink() const { return Frame - LastSwap >= Settings.SwapFrames && Pacer.MayLink(Time(), HeldSwap); }

/// Whether Plan, which has more than the current pipeline, is to wait.
bool FRTPSOScheduler::HoldBack(const FLinkPlan& Plan)
{
	// If nothing stands in for what is missing, there would be holes meanwhile.
	const FLinkedRTPSO& Current = Links.GetCurrent();
	if (!Current.Pipeline || Settings.Fallback == ERTFallback::Skip || !CoversFrame(Current.Plan, Plan)) { return false; }
	const auto IsReady = [](const FLinkPlan::FHit& Hit) { return Hit.State == ERTHitState::Ready; };
	HeldSwap.InUse = static_cast<size_t>(std::count_if(Current.Plan.Hits.begin(), Current.Plan.Hits.end(), IsReady));
	HeldSwap.New = CountNewPrograms(Current.Plan, Plan);
	HeldSwap.bMore = Units.IsAnyToCome(Frame);
	bHeld = !MayLink();
	if (!bHeld) { Pacer.LinkStarted(); }
	return bHeld;
}

bool FRTPSOScheduler::BeginFinish()
{
	bHeld = false;
	if (!bDirty && bFinished) { return true; }
	Units.ForgetShortages();
	if (IsShortage(Links.GetStatus())) { Links.ForgetFailure(); }
	bNoDeadline = true;
	return false;
}

bool FRTPSOScheduler::AdvanceUnits()
{
	StartRound(true);
	// What is neither settled nor to come has met a shortage of memory.
	return !Units.IsAnyToCome(Frame) || !FindFatalError();
}

bool FRTPSOScheduler::AddStandIns(const FRTPSODesc& Desc)
{
	if (Units.AreHitsReady() || Settings.Fallback == ERTFallback::Skip) { return false; }
	SetWanted(Desc, true);
	Units.ForgetShortages();
	return true;
}

std::optional<FRTStatus> FRTPSOScheduler::AdvanceLink()
{
	bNoDeadline = false;
	if (Lost) { return Lost; }
	assert(!Links.IsUnderWay());
	TakeOverLink();
	const FLinkPlan Plan = MakePlan();
	if (!Plan.bComplete) { return FRTStatus::Error(ERTResult::CompileFailed, "nothing that could be linked"); }
	if (GetCurrent() && Links.GetCurrent().Plan.Key == Plan.Key) { return FRTStatus::Success(); }
	const FRTStatus Status = Links.GetStatus();
	if (Links.HasFailed(Plan) && !Status)
	{
		// A shortage of memory passes: the next call tries again.
		if (Status.Code != ERTResult::CompileFailed) { Links.ForgetFailure(); }
		return Status;
	}
	StartLink(true);
	return std::nullopt;
}

void FRTPSOScheduler::EndFinish(const FRTStatus& Status)
{
	bNoDeadline = false;
	// The next Finish tries again what had no memory, though an older version serves.
	bFinished = Status && Units.CountSettled() == Units.GetWanted().All.size();
	bDirty = !Status;
}

float FRTPSOScheduler::GetProgress() const
{
	return static_cast<float>(Units.CountSettled()) / static_cast<float>(Units.GetWanted().All.size());
}

FUnitTask FRTPSOScheduler::TakeUnit()
{
	FUnitTask Task;
	Task.State = Round.TakeUnit();
	const FUnitState& State = *Task.State;
	Task.Job = {State.Unit, State.GetVersion(), NextBuild++, State.bLibrary, State.bEmptyGroup, State.PayloadBytes, Round.GetShared()};
	return Task;
}

void FRTPSOScheduler::StoreUnit(const FUnitTask& Task, FUnitResult Result)
{
	FUnitState& State = *Task.State;
	Round.EndUnit(State);
	State.ContentKey = std::move(Result.ContentKey);
	const bool bAgain = std::exchange(State.bBeganBefore, false) && IsShortage(Result.Status);
	State.Error = bAgain ? FRTStatus::Success() : Result.Status;
	if (Result.Status)
	{
		++Stats.Compiled;
		State.ReadyVersion = Task.Job.Version;
		// Releasing the last reference to a library calls the driver.
		if (FPipelineBuildRef Older = std::exchange(State.Ready, std::move(Result.Build))) { Trash.Discard(std::move(Older)); }
	}
	else if (!bAgain) { StoreFailure(Task, Result.Status); }
	++Results;
	bDirty |= !Round.IsOpen(); // the compile took longer than its round
	CloseRoundIfOver();
}

void FRTPSOScheduler::StoreFailure(const FUnitTask& Task, const FRTStatus& Status)
{
	if (Status.Code == ERTResult::DeviceLost)
	{
		LoseDevice(Status);
		Round.Abandon();
	}
	else if (IsShortage(Status))
	{
		Task.State->RetryAt = Frame + RetryFrames;
		RetryFrame = Task.State->RetryAt;
	}
	else
	{
		++Stats.Failures;
		Task.State->FailedVersion = Task.Job.Version;
		Failures.ReportUnit(Task.Job.Unit.Name, Task.Job.Version, Task.State->Ready != nullptr, Status);
	}
}

void FRTPSOScheduler::LoseDevice(const FRTStatus& Error)
{
	Lost = Error;
	bHeld = false;
}

EBackgroundWork FRTPSOScheduler::GetBackgroundWork() const
{
	if (Links.IsAsked()) { return EBackgroundWork::Link; }
	if (bFindEdits) { return EBackgroundWork::FindEdits; }
	return Trash.IsEmpty() ? EBackgroundWork::None : EBackgroundWork::EmptyTrash;
}

void FRTPSOScheduler::StoreLink(const FRTStatus& Status, std::shared_ptr<const FRTPSO> Pipeline, FLinkPlan Plan, double Ms)
{
	Links.End(Status, std::move(Pipeline), std::move(Plan), Frame);
	Stats.LastLinkMs = Ms;
	++Results;
	if (Status) { return; }
	if (Status.Code == ERTResult::DeviceLost) { LoseDevice(Status); }
	else if (IsShortage(Status)) { RetryFrame = Frame + RetryFrames; }
	else { Failures.ReportLink(Status); }
}

void FRTPSOScheduler::StoreEdits(const std::vector<FUnitLook>& Edited)
{
	bFindEdits = false;
	if (Units.Reload(Edited))
	{
		bDirty = true;
		bFinished = false;
	}
	++Results;
}

void FRTPSOScheduler::DropOld()
{
	Links.DropRetired(Frame, Trash);
	constexpr uint64_t Interval = 16; // frames; looking at all units in each frame would be a waste
	if (Frame % Interval == 0)
	{
		Units.DropOld(Frame, Settings.KeepFrames, Trash);
		Links.DropOld(Frame, Settings.KeepFrames, Trash);
	}
	if (!Trash.IsEmpty()) { OnWork(); }
}

void FRTPSOScheduler::Count(FRTPSOCompilerStats& Out) const
{
	Out = Stats;
	Units.Count(Out);
	Out.bBusy = Round.IsOpen() || Round.IsAnyRunning() || !Links.IsIdle() || bDirty || bHeld || bFindEdits;
	Out.LastSwapMs = 1e3 * Pacer.GetCost().count();
}

} // namespace Lantern
