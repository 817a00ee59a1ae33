// What the parts of FRTPSOCompiler share. Everything below Mutex is read and written with it held; no call of a driver, of
// glslang or of the file system is made meanwhile.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <list>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <unordered_map>

#include "LanternScene/Pipelines/RTPSOCompiler.h"
#include "Pipelines/RTPSOUnits.h"
#include "Pipelines/SwapPacer.h"

namespace Lantern
{

using FPipelineClock = std::chrono::steady_clock;
using FShaderBinaryRef = std::shared_ptr<const FShaderBinary>;

/// A compiled version of a unit. Immutable.
struct FPipelineBuild
{
	uint64_t Id = 0; ///< never used twice
	ERTGroupKind Kind = ERTGroupKind::General;
	std::vector<ERTShaderStage> Stages;
	TRTRef<IRTPipeline> Library;         ///< or null, and
	std::vector<FShaderBinaryRef> Codes; ///< what a link compiles itself
	bool bEmptyGroup = false;            ///< the library's second group is a hit group without shaders
};
using FPipelineBuildRef = std::shared_ptr<const FPipelineBuild>;

enum class ESlotState : uint8_t
{
	Idle,
	Queued,
	Compiling
};

/// A unit, whatever its version.
struct FPipelineSlot
{
	FPipelineUnit Unit; ///< the newest version wanted
	bool bLibrary = false, bEmptyGroup = false;
	bool bEssential = false; ///< no frame can do without, or any stand-in
	uint32_t Program = StandardProgram;
	uint32_t PayloadBytes = 0;
	ESlotState State = ESlotState::Idle;
	uint64_t Reloads = 0;
	FPipelineBuildRef Ready;
	uint64_t ReadyVersion = 0, FailedVersion = 0; ///< as GetVersion has it; 0: none
	FRTStatus Error;
	uint64_t RetryAt = 0;    ///< frame, after a shortage of memory
	std::string ContentKey;  ///< of the version compiled last
	uint64_t LastWanted = 0; ///< frame
	bool bWanted = false;

	uint64_t GetVersion() const { return (Unit.Version << 24) + Reloads + 1; }
	bool IsSettled() const { return ReadyVersion == GetVersion() || FailedVersion == GetVersion(); }
};
using FPipelineSlotRef = std::shared_ptr<FPipelineSlot>;

struct FHitSlots
{
	FHitProgram Program;
	std::vector<FPipelineSlotRef> Types; ///< null: the group runs nothing
};

/// The slots of a description.
struct FWantedSlots
{
	std::vector<FPipelineSlotRef> RayGens, Misses, Callables;
	std::vector<FHitSlots> Hits;
	std::vector<FHitSlots> StandIns;   ///< Program.Class says which
	FPipelineSlotRef EmptyCallable;    ///< for callables that do not compile; null without callables
	std::vector<FPipelineSlotRef> All; ///< each once
};

/// All that a link needs, without the slots.
struct FLinkPlan
{
	struct FHit
	{
		FHitProgram Program;
		ERTHitState State = ERTHitState::Missing;
		std::vector<FPipelineBuildRef> Builds; ///< by ray type; null: the group runs nothing
	};
	std::vector<FShaderSource> RayGenSources;
	std::vector<FPipelineBuildRef> RayGens, Misses, Callables;
	std::vector<FHit> Hits, StandIns;
	uint32_t PayloadBytes = 0;
	bool bStandardServes = false; ///< see FRTPSOLayout
	std::vector<uint64_t> Key;    ///< equal: the same pipeline
	bool bComplete = false;       ///< a pipeline can be made of it
};

struct FLinkedPipeline
{
	std::shared_ptr<const FRTPSO> Pipeline;
	FLinkPlan Plan;
	bool bExact = false;   ///< made by Finish
	uint64_t LastUsed = 0; ///< frame
};

struct FRTPSOCompiler::FImpl
{
	FImpl(IRTDevice& InDevice, FShaderCompiler& InCompiler, const FMaterialPrograms& InPrograms, FPipelineTimeSource InTime);
	~FImpl();

	/// Something that the pacer is told under Mutex.
	struct FFrameEvent
	{
		uint64_t Frame = 0;
		FPipelineClock::time_point Time;
		std::optional<double> GpuMs; ///< none: it was submitted
	};

	// ---- PipelineCompiler.cpp: the render thread
	void AddFrameEvent(const FFrameEvent& Event);
	void TellPacer();
	void TakeLink();
	void Begin(const FRTPSODesc& Desc, bool bWait);
	FRTStatus FinishSlots(std::unique_lock<std::mutex>& Lock, const std::function<void(float)>& Progress);
	FRTStatus FinishLink(std::unique_lock<std::mutex>& Lock);
	FRTStatus FindFatalError() const;
	void StartThreads();

	// ---- PipelineCompilerRounds.cpp: with Mutex held
	/// StandIns: whether classes have one; none: as it is, unless Desc is new.
	void SetWanted(const FRTPSODesc& Desc, std::optional<bool> StandIns);
	FPipelineSlotRef FindSlot(FPipelineUnit Unit, bool bHit, bool bEmptyGroup);
	FHitSlots FindHitSlots(FHitProgram Program);
	FHitSlots FindStandInSlots(ERTHitClass Class);
	void CollectWanted();
	void CollectGeneral();
	void WantSlot(const FPipelineSlotRef& Slot);
	static bool AreLibrariesOn();
	bool NeedsCompile(const FPipelineSlot& Slot) const;
	bool ComesBefore(const FPipelineSlot& A, const FPipelineSlot& B) const;
	void StartRound(bool bAppend);
	void EndRoundIfOver();
	bool AreHitsCompiled() const;
	void StartLink(bool bExact);
	/// Whether Plan, which Current does not cover, is to wait. Sets bHeld and HeldSwap.
	bool HoldBack(const FLinkPlan& Plan);
	void DropOld();
	template <class T>
	void Discard(T&& Object)
	{
		Trash.push_back(std::make_shared<std::decay_t<T>>(std::move(Object)));
	}
	void RetireCurrent();
	void LoseDevice(const FRTStatus& Error);
	bool IsQueueEmpty() const { return NextQueued == Queue.size(); }

	// ---- PipelineLink.cpp
	FLinkPlan MakePlan() const;
	/// Whether all that Plan has but its programs is in Made.
	static bool CoversFrame(const FLinkPlan& Made, const FLinkPlan& Plan);
	/// Programs that are ready in Plan and not the same in Made.
	static size_t CountNewPrograms(const FLinkPlan& Made, const FLinkPlan& Plan);
	FRTStatus Link(const FLinkPlan& Plan, std::shared_ptr<const FRTPSO>& Out);

	// ---- PipelineCompilerWork.cpp: the compiler's threads
	struct FJob
	{
		FPipelineSlotRef Slot;
		FPipelineUnit Unit;
		uint64_t Version = 0;
		std::string ContentKey;
		double GlslangMs = 0.0, DriverMs = 0.0;
	};
	void RunCompiler(uint32_t Index);
	void RunLinker();
	void CompileNext(std::unique_lock<std::mutex>& Lock);
	void LinkNext(std::unique_lock<std::mutex>& Lock);
	void LookForEdits(std::unique_lock<std::mutex>& Lock);
	void EmptyTrash(std::unique_lock<std::mutex>& Lock);
	FRTStatus CompileShaders(FJob& Job, FPipelineBuild& Build);
	FRTStatus CompileLibrary(FJob& Job, FPipelineBuild& Build);
	FRTStatus GetBinary(const FShaderSource& Source, uint64_t Version, FShaderBinaryRef& Out);
	void StoreResult(const FJob& Job, const FRTStatus& Status, std::shared_ptr<FPipelineBuild> Build);
	void ReportFailure(const FJob& Job, const FRTStatus& Status);
	std::string GetContentKey(const FPipelineUnit& Unit);

	IRTDevice& Device;
	FShaderCompiler& Compiler;
	const FMaterialPrograms& Programs;

	std::shared_ptr<const FRTPSO> Taken;                        ///< Current's pipeline; the render thread's, without Mutex
	std::optional<std::vector<FProgramPriority>> NewPriorities; ///< the same
	FRTPSOCompilerStats Known;                                  ///< the same
	std::vector<FFrameEvent> FrameEvents;                       ///< the same; that the pacer has not been told of
	const FPipelineTimeSource Time;

	mutable std::mutex Mutex;
	std::condition_variable WorkAdded, SomethingDone;
	bool bStop = false;
	bool bLost = false; ///< the device is; Error of what noticed it:
	FRTStatus LostError;
	uint64_t Frame = 0;
	uint64_t NextBuild = 1;

	FRTPSODesc WantedDesc;
	uint64_t WantedEdits = 0; ///< of Programs
	bool bWantedLibraries = true, bWantedStandIns = false;
	bool bStandardServes = false;
	FWantedSlots Wanted;
	std::unordered_map<std::string, FPipelineSlotRef> Slots;
	std::map<FHitProgram, FHitSlots> HitSlots; ///< of WantedDesc's ray types
	std::vector<FProgramPriority> Priorities;

	bool bRound = false, bNoDeadline = false;
	bool bDirty = false; ///< there may be something to compile or to link
	bool bHeld = false;  ///< programs are ready to be linked, but swaps are dear
	FSwapPacer::FSwap HeldSwap;
	FSwapPacer Pacer;
	FPipelineClock::time_point RoundEnd;
	int32_t RoundMs = 100, KeepFrames = 1000;
	uint32_t ThreadLimit = 1;
	std::vector<FPipelineSlotRef> Queue; ///< those before NextQueued have been taken
	size_t NextQueued = 0;
	uint32_t Running = 0;

	bool bLinkWanted = false, bLinking = false, bLinkDone = false;
	FLinkPlan LinkPlan;
	bool bLinkExact = false;
	FRTStatus LinkStatus;
	std::vector<uint64_t> FailedLink; ///< key of the last link that the driver refused
	uint64_t RetryFrame = 0;          ///< when to look again at what failed for want of memory; 0: nothing did
	FLinkedPipeline Linked;           ///< where bLinkDone
	FLinkedPipeline Current;
	std::list<FLinkedPipeline> Recent; ///< newest first
	std::deque<FLinkedPipeline> Old;   ///< the frames in which they were Current may still hold them
	/// To be destroyed by the linking thread. Memory that the compiler's threads allocated is given back under a lock of
	/// the allocator, which one of them may hold while it does not run: measured, 5 to 150 ms of a frame on two busy cores.
	std::vector<std::shared_ptr<void>> Trash;
	bool bReload = false;
	FPipelineClock::time_point NextReload;
	bool bFinished = false; ///< Current is all that the last Finish could make of WantedDesc
	uint64_t DoneCount = 0; ///< compiles and links that ended

	/// Shaders that several units of a round share are compiled once.
	struct FSharedShader
	{
		std::mutex Mutex;
		bool bDone = false;
		FRTStatus Status;
		FShaderBinaryRef Binary;
	};
	std::unordered_map<std::string, std::shared_ptr<FSharedShader>> Shared;
	std::set<std::string> Reported;
	FRTPSOCompilerStats Stats;
	std::vector<std::thread> Threads; ///< the first links, the others compile
};

} // namespace Lantern
