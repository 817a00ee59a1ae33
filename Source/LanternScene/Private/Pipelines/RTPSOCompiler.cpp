#include "LanternScene/Pipelines/RTPSOCompiler.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "LanternCore/Config/ConsoleVariables.h"
#include "Pipelines/RTPSOCompilerImpl.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarLibraries("r.RT.Pipeline.Libraries", true,
    "Each shader group is a pipeline library of its own, where the device has them. "
    "Off: a link compiles everything anew.");
TRTConsoleVariable<int32_t> CVarThreads(
    "r.RT.Pipeline.Threads", 0, "Threads that compile pipelines. 0: one less than the machine has, at least one.", {0, 256});
TRTConsoleVariable<int32_t> CVarRoundMs(
    "r.RT.Pipeline.RoundMs", 100, "Milliseconds after which what is compiled is linked, though more is waiting.", {1, 1e6});
TRTConsoleVariable<int32_t> CVarFallback("r.RT.Pipeline.Fallback", 1,
    "Objects whose shaders are not compiled yet. 0: left out. 1: drawn with the standard material. 2: the frame waits.", {0, 2});
TRTConsoleVariable<int32_t> CVarKeepFrames(
    "r.RT.Pipeline.KeepFrames", 1000, "Frames after which compiled shaders that nothing wants are dropped.", {1, 1e6});
TRTConsoleVariable<float> CVarSwapShare("r.RT.Pipeline.SwapShare", 0.2f,
    "Most of the time that first uses of new pipelines may take. Materials that are ready wait for it, where the driver "
    "compiles at first use. 1: they never wait.",
    {FSwapPacer::LeastShare, 1});
TRTConsoleVariable<float> CVarReloadSeconds("r.RT.Pipeline.ReloadSeconds", 0.0f,
    "Seconds between looks for edited shader files, whose pipelines are then compiled anew. 0: never.", {0, 3600});
} // namespace

ERTFallback GetPipelineFallback() { return static_cast<ERTFallback>(CVarFallback.GetOnRenderThread()); }

FRTPSOCompiler::FRTPSOCompiler(IRTDevice& Device, FShaderCompiler& Compiler, const FMaterialPrograms& Programs, FPipelineTimeSource Time)
    : Impl(std::make_unique<FImpl>(Device, Compiler, Programs, std::move(Time)))
{}

FRTPSOCompiler::~FRTPSOCompiler() = default;

FRTPSOCompiler::FImpl::FImpl(
    IRTDevice& InDevice, FShaderCompiler& InCompiler, const FMaterialPrograms& InPrograms, FPipelineTimeSource InTime)
    : Device(InDevice),
      Compiler(InCompiler),
      Programs(InPrograms),
      Time(InTime ? std::move(InTime) : [] { return FPipelineClock::now(); })
{}

FRTPSOCompiler::FImpl::~FImpl()
{
	{
		const std::lock_guard Lock(Mutex);
		bStop = true;
	}
	WorkAdded.notify_all();
	for (std::thread& Thread : Threads) { Thread.join(); }
}

bool FRTPSOCompiler::FImpl::AreLibrariesOn() { return CVarLibraries.GetOnRenderThread(); }

void FRTPSOCompiler::FImpl::StartThreads()
{
	const int32_t Asked = CVarThreads.GetOnRenderThread();
	const uint32_t Cores = std::max(1u, std::thread::hardware_concurrency());
	const uint32_t Limit = Asked > 0 ? static_cast<uint32_t>(Asked) : std::max(1u, Cores - 1);
	if (Limit != ThreadLimit)
	{
		ThreadLimit = Limit;
		WorkAdded.notify_all();
	}
	if (Threads.empty())
	{
		Threads.emplace_back([this] { RunLinker(); });
	}
	while (Threads.size() < size_t(Limit) + 1)
	{
		const uint32_t Index = static_cast<uint32_t>(Threads.size() - 1);
		Threads.emplace_back([this, Index] { RunCompiler(Index); });
	}
}

void FRTPSOCompiler::FImpl::TakeLink()
{
	if (!bLinkDone) { return; }
	bLinkDone = false;
	bDirty = true; // more may have become ready since
	if (!LinkStatus) { return; }
	++Stats.Links;
	Pacer.Swapped();
	RetireCurrent();
	Current = std::move(Linked);
	Taken = Current.Pipeline;
	Current.LastUsed = Frame;
	Linked = {};
}

void FRTPSOCompiler::FImpl::TellPacer()
{
	for (const FFrameEvent& Event : FrameEvents)
	{
		if (Event.GpuMs) { Pacer.FrameDone(Event.Frame, std::chrono::duration<double, std::milli>(*Event.GpuMs), Event.Time); }
		else { Pacer.FrameSubmitted(Event.Frame); }
	}
	FrameEvents.clear();
}

/// Also where frames have nothing for Update to do: what they report must not pile up.
void FRTPSOCompiler::FImpl::AddFrameEvent(const FFrameEvent& Event)
{
	FrameEvents.push_back(Event);
	const std::unique_lock Lock(Mutex, std::try_to_lock);
	if (Lock.owns_lock()) { TellPacer(); }
}

void FRTPSOCompiler::FImpl::Begin(const FRTPSODesc& Desc, bool bWait)
{
	++Frame;
	RoundMs = CVarRoundMs.GetOnRenderThread();
	KeepFrames = CVarKeepFrames.GetOnRenderThread();
	Pacer.SetLimits(CVarSwapShare.GetOnRenderThread(), std::chrono::milliseconds(RoundMs));
	TellPacer();
	if (NewPriorities) { Priorities = std::exchange(NewPriorities, std::nullopt).value(); }
	StartThreads();
	TakeLink();
	if (const bool bServes = GetPipelineFallback() != ERTFallback::Skip; bServes != bStandardServes)
	{
		bStandardServes = bServes;
		bDirty = true;
		bFinished = false;
	}
	SetWanted(Desc, bWait ? std::nullopt : std::optional(GetPipelineFallback() == ERTFallback::StandIn));
	if (RetryFrame > 0 && Frame >= RetryFrame)
	{
		RetryFrame = 0;
		FailedLink.clear();
		bDirty = true;
	}
	DropOld();
}

void FRTPSOCompiler::Update(const FRTPSODesc& Wanted)
{
	// A thread of lower priority may be kept from running while it holds the lock: then this frame goes on without.
	const std::unique_lock Lock(Impl->Mutex, std::try_to_lock);
	if (!Lock.owns_lock() || Impl->bLost) { return; }
	Impl->Begin(Wanted, false);
	Impl->EndRoundIfOver();
	if (std::exchange(Impl->bDirty, false))
	{
		Impl->StartRound(false);
		Impl->StartLink(false);
	}
	else if (Impl->bHeld && Impl->Pacer.MayLink(Impl->Time(), Impl->HeldSwap)) { Impl->StartLink(false); }
	const float Seconds = CVarReloadSeconds.GetOnRenderThread();
	if (Seconds > 0.0f && Impl->Time() > Impl->NextReload)
	{
		Impl->NextReload = Impl->Time() + std::chrono::milliseconds(static_cast<int64_t>(Seconds * 1000.0f));
		Impl->bReload = true;
		Impl->WorkAdded.notify_all();
	}
}

FRTStatus FRTPSOCompiler::FImpl::FindFatalError() const
{
	if (bLost) { return LostError; }
	for (const FPipelineSlotRef& Slot : Wanted.All)
	{
		const bool bFailed = !Slot->Ready && !Slot->Error.IsOk();
		const bool bShortage = bFailed && Slot->FailedVersion != Slot->GetVersion();
		if (bFailed && (Slot->bEssential || bShortage)) { return Slot->Error; }
	}
	return FRTStatus::Success();
}

FRTStatus FRTPSOCompiler::FImpl::FinishSlots(std::unique_lock<std::mutex>& Lock, const std::function<void(float)>& Progress)
{
	bNoDeadline = true;
	for (FPipelineSlotRef& Slot : Wanted.All)
	{
		Slot->RetryAt = 0;
		if (Slot->FailedVersion != Slot->GetVersion()) { Slot->Error = FRTStatus::Success(); }
	}
	for (;;)
	{
		StartRound(true);
		const auto IsDone = [](const FPipelineSlotRef& Slot) { return Slot->IsSettled(); };
		const size_t Done = static_cast<size_t>(std::count_if(Wanted.All.begin(), Wanted.All.end(), IsDone));
		const FRTStatus Error = FindFatalError();
		if (Done == Wanted.All.size() || !Error)
		{
			bNoDeadline = false;
			return Error;
		}
		if (Progress)
		{
			Lock.unlock();
			Progress(static_cast<float>(Done) / static_cast<float>(Wanted.All.size()));
			Lock.lock();
		}
		const uint64_t Before = DoneCount;
		SomethingDone.wait(Lock, [&] { return DoneCount != Before || bLost; });
	}
}

FRTStatus FRTPSOCompiler::FImpl::FinishLink(std::unique_lock<std::mutex>& Lock)
{
	for (;;)
	{
		SomethingDone.wait(Lock, [&] { return (!bLinking && !bLinkWanted) || bLost; });
		if (bLost) { return LostError; }
		TakeLink();
		const FLinkPlan Plan = MakePlan();
		if (!Plan.bComplete) { return FRTStatus::Error(ERTResult::CompileFailed, "nothing that could be linked"); }
		if (Current.Pipeline && Current.Plan.Key == Plan.Key) { return FRTStatus::Success(); }
		if (FailedLink == Plan.Key && !LinkStatus.IsOk())
		{
			// A shortage of memory passes: the next call tries again.
			if (LinkStatus.Code != ERTResult::CompileFailed) { FailedLink.clear(); }
			return LinkStatus;
		}
		StartLink(true);
	}
}

FRTStatus FRTPSOCompiler::Finish(const FRTPSODesc& Wanted, const std::function<void(float)>& Progress)
{
	std::unique_lock Lock(Impl->Mutex);
	if (Impl->bLost) { return Impl->LostError; }
	Impl->Begin(Wanted, true);
	Impl->bHeld = false;
	// The usual frame: nothing is new.
	if (!Impl->bDirty && Impl->bFinished) { return FRTStatus::Success(); }
	FRTStatus Status = Impl->FinishSlots(Lock, Progress);
	if (Status && !Impl->AreHitsCompiled() && GetPipelineFallback() != ERTFallback::Skip)
	{
		Impl->SetWanted(Wanted, true);
		Status = Impl->FinishSlots(Lock, Progress);
	}
	if (Status) { Status = Impl->FinishLink(Lock); }
	Impl->bFinished = Status.IsOk();
	Impl->bDirty = !Status;
	if (Status && Progress)
	{
		Lock.unlock();
		Progress(1.0f);
	}
	return Status;
}

std::shared_ptr<const FRTPSO> FRTPSOCompiler::GetCurrent() const { return Impl->Taken; }

void FRTPSOCompiler::FrameSubmitted(uint64_t Frame) { Impl->AddFrameEvent({Frame, Impl->Time(), std::nullopt}); }

void FRTPSOCompiler::FrameDone(uint64_t Frame, double GpuMs) { Impl->AddFrameEvent({Frame, Impl->Time(), GpuMs}); }

void FRTPSOCompiler::SetPriorities(std::vector<FProgramPriority> ByProgram) { Impl->NewPriorities = std::move(ByProgram); }

void FRTPSOCompiler::Reload()
{
	const std::lock_guard Lock(Impl->Mutex);
	Impl->StartThreads();
	Impl->bReload = true;
	Impl->WorkAdded.notify_all();
}

const FRTPSOCompilerStats& FRTPSOCompiler::GetStats() const
{
	FRTPSOCompilerStats& Out = Impl->Known;
	const std::unique_lock Lock(Impl->Mutex, std::try_to_lock);
	if (!Lock.owns_lock())
	{
		Out.bBusy = true; // with whoever has the lock
		return Out;
	}
	Out = Impl->Stats;
	for (const FPipelineSlotRef& Slot : Impl->Wanted.All)
	{
		++Out.Wanted;
		Out.Ready += Slot->Ready ? 1 : 0;
		Out.Failed += !Slot->Ready && Slot->FailedVersion == Slot->GetVersion() ? 1 : 0;
	}
	for (const auto& [Key, Slot] : Impl->Slots) { Out.Kept += Slot->Ready ? 1 : 0; }
	Out.bBusy = Impl->bRound || Impl->Running > 0 || Impl->bLinking || Impl->bLinkWanted || Impl->bLinkDone || Impl->bDirty ||
	            Impl->bHeld || Impl->bReload;
	Out.LastSwapMs = 1e3 * Impl->Pacer.GetCost().count();
	return Out;
}

} // namespace Lantern
