// Decides what is compiled next, when a round ends, when a link begins, and when its pipeline is taken over.
#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "Pipelines/RTPSOFailureLog.h"
#include "Pipelines/RTPSOLinkState.h"
#include "Pipelines/RTPSORound.h"
#include "Pipelines/SwapPacer.h"

namespace Lantern
{

/// The console variables of a frame.
struct FRTPSOSettings
{
	bool bLibraries = true;                     ///< r.RT.Pipeline.Libraries
	std::chrono::milliseconds RoundLength{100}; ///< r.RT.Pipeline.RoundMs
	uint64_t KeepFrames = 1000;                 ///< r.RT.Pipeline.KeepFrames
	ERTFallback Fallback = ERTFallback::StandIn;
	float SwapShare = 0.2f;     ///< r.RT.Pipeline.SwapShare
	uint64_t SwapFrames = 1;    ///< r.RT.Pipeline.SwapFrames
	float ReloadSeconds = 0.0f; ///< r.RT.Pipeline.ReloadSeconds
};

/// A unit on its way through a compile thread.
struct FUnitTask
{
	FUnitStateRef State;
	FUnitJob Job;
};

enum class EBackgroundWork : uint8_t
{
	None,
	Link,      ///< TakeLink, LinkRTPSO, StoreLink
	FindEdits, ///< GetUnits().ListSettled, FUnitCompiler::GetContentKey, StoreEdits
	EmptyTrash
};

/// Has no threads, and calls no driver, no glslang and no file system: it hands out work and is told the results.
/// Threads: the caller holds the lock of the RTPSO compiler in every call. Each section below names the thread.
class FRTPSOScheduler
{
public:
	/// All references must outlive it. OnWork: called with the lock when a thread has something new to do.
	FRTPSOScheduler(
	    const FRTCapabilities& Capabilities, const FMaterialPrograms& Programs, FPipelineTimeSource InTime, std::function<void()> InOnWork);

	// ---- The render thread
	/// Takes over a link that has ended, and wants Desc. bFinish: for a complete picture, which wants no stand-ins at first.
	void BeginFrame(const FRTPSODesc& Desc, const FRTPSOSettings& InSettings, bool bFinish);
	/// Starts what is missing. After BeginFrame.
	void Advance();
	void SetPriorities(std::vector<FProgramPriority> ByProgram) { Units.SetPriorities(std::move(ByProgram)); }
	FSwapPacer& GetPacer() { return Pacer; }
	/// Has the background thread look for edited shader files.
	void AskForEdits();

	// ---- The render thread, in FRTPSOCompiler::Finish
	/// True: an earlier Finish has compiled and linked everything that BeginFrame wants. False: the work begins.
	bool BeginFinish();
	/// Compiles what is missing, without a deadline. True: all wanted units are settled or have met a shortage of memory, or there
	/// is a fatal error.
	bool AdvanceUnits();
	/// Wants stand-ins, if a hit program has failed and may have one. True: units are to be compiled again.
	bool AddStandIns(const FRTPSODesc& Desc);
	/// Takes over a link that has ended, and begins the next one. No value: its end is to be waited for.
	std::optional<FRTStatus> AdvanceLink();
	void EndFinish(const FRTStatus& Status);
	float GetProgress() const; ///< settled units of the wanted ones, 0 to 1

	// ---- Compile threads
	bool HasUnit() const { return Round.HasUnit(); }
	FUnitTask TakeUnit();
	void StoreUnit(const FUnitTask& Task, FUnitResult Result);

	// ---- The background thread
	EBackgroundWork GetBackgroundWork() const;
	FLinkPlan TakeLink() { return Links.Begin(); }
	/// Pipeline: null on an error. Ms: what the link took.
	void StoreLink(const FRTStatus& Status, std::shared_ptr<const FRTPSO> Pipeline, FLinkPlan Plan, double Ms);
	void StoreEdits(const std::vector<FUnitLook>& Edited);
	FTrash& GetTrash() { return Trash; }

	// ---- Any thread
	const FRTPSOUnitSet& GetUnits() const { return Units; }
	const std::shared_ptr<const FRTPSO>& GetCurrent() const { return Links.GetCurrent().Pipeline; }
	bool IsLinkUnderWay() const { return Links.IsUnderWay(); }
	bool IsLost() const { return Lost.has_value(); } ///< the device is lost
	FRTStatus FindFatalError() const { return Lost ? *Lost : Units.FindFatalError(); }
	uint64_t GetResultCount() const { return Results; } ///< compiles, links and looks for edits that have ended
	void Count(FRTPSOCompilerStats& Out) const;

private:
	void SetWanted(const FRTPSODesc& Desc, std::optional<bool> StandIns);
	void TakeOverLink();
	void StartRound(bool bAppend);
	void CloseRoundIfOver();
	void StartLink(bool bExact);
	bool HoldBack(const FLinkPlan& Plan);
	bool MayLink() const;
	void StoreFailure(const FUnitTask& Task, const FRTStatus& Status);
	void LoseDevice(const FRTStatus& Error);
	void DropOld();
	FLinkPlan MakePlan() const;

	const FPipelineTimeSource Time;
	const std::function<void()> OnWork;
	FRTPSOSettings Settings;
	FRTPSOUnitSet Units;
	FCompileRound Round;
	FRTPSOLinkState Links;
	FSwapPacer Pacer;
	FTrash Trash;
	FRTPSOFailureLog Failures;
	FRTPSOCompilerStats Stats;
	uint64_t Frame = 0;
	uint64_t LastSwap = 0; ///< frame
	uint64_t NextBuild = 1;
	uint64_t Results = 0;
	uint64_t RetryFrame = 0;  ///< when to try again what failed for want of memory; 0: nothing did
	bool bDirty = false;      ///< there may be something to compile or to link
	bool bNoDeadline = false; ///< rounds have none while Finish waits for them
	bool bFinished = false;   ///< the current pipeline is all that the newest Finish could make of what is wanted
	bool bHeld = false;       ///< programs are ready to be linked, but the pacer has them wait
	FSwapPacer::FSwap HeldSwap;
	bool bFindEdits = false;
	std::chrono::steady_clock::time_point NextFindEdits;
	std::optional<FRTStatus> Lost; ///< the error that told that the device is lost
};

} // namespace Lantern
