// The front of the RTPSO compiler: console variables, the lock, and who waits for what.
#include "LanternScene/Pipelines/RTPSOCompiler.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "LanternCore/Config/ConsoleVariables.h"
#include "Pipelines/PipelineVariables.h"
#include "Pipelines/RTPSOThreads.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarLibraries("r.RT.Pipeline.Libraries", true,
    "Compiles each shader group to a pipeline library, if the device supports them. 0: each link compiles everything anew.");
TRTConsoleVariable<int32_t> CVarRoundMs(
    "r.RT.Pipeline.RoundMs", 100, "Longest time, in milliseconds, that compiled shaders wait for others before they are linked.", {1, 1e6});
TRTConsoleVariable<int32_t> CVarFallback("r.RT.Pipeline.Fallback", 1,
    "Treatment of objects whose shaders are not compiled yet. 0: they are left out. 1: they are drawn with the standard material. "
    "2: the frame waits.",
    {0, 2});
TRTConsoleVariable<float> CVarSwapShare("r.RT.Pipeline.SwapShare", 0.2f,
    "Largest share of the time that first uses of new pipelines may take. Materials that are ready wait, if the driver compiles "
    "a pipeline at its first use. 1: they never wait.",
    {FSwapPacer::LeastShare, 1});
TRTConsoleVariable<int32_t> CVarSwapFrames("r.RT.Pipeline.SwapFrames", 1,
    "Fewest frames from one pipeline with more materials to the next. Shaders that a setting asks for do not wait.", {1, 10'000});
TRTConsoleVariable<float> CVarReloadSeconds("r.RT.Pipeline.ReloadSeconds", 0.0f,
    "Seconds between searches for edited shader files. Pipelines of edited files are compiled anew. 0: no search.", {0, 3600});

FRTPSOSettings GetSettings()
{
	FRTPSOSettings Settings;
	Settings.bLibraries = CVarLibraries.GetOnRenderThread();
	Settings.RoundLength = std::chrono::milliseconds(CVarRoundMs.GetOnRenderThread());
	Settings.KeepFrames = GetPipelineKeepFrames();
	Settings.Fallback = GetPipelineFallback();
	Settings.SwapShare = CVarSwapShare.GetOnRenderThread();
	Settings.SwapFrames = static_cast<uint64_t>(CVarSwapFrames.GetOnRenderThread());
	Settings.ReloadSeconds = CVarReloadSeconds.GetOnRenderThread();
	return Settings;
}
} // namespace

ERTFallback GetPipelineFallback() { return static_cast<ERTFallback>(CVarFallback.GetOnRenderThread()); }

/// Threads: the render thread, one call at a time. Members guarded by Mutex are shared with the threads of FRTPSOThreads.
struct FRTPSOCompiler::FImpl
{
	/// A frame that was submitted, or that is done.
	struct FFrameEvent
	{
		uint64_t Frame = 0;
		std::chrono::steady_clock::time_point Time;
		std::optional<double> GpuMs; ///< none: it was submitted
	};

	FImpl(IRTDevice& Device, FShaderCompiler& Compiler, const FMaterialPrograms& Programs, FPipelineTimeSource InTime);
	void AddFrameEvent(const FFrameEvent& Event);
	void TellPacer();
	void Begin(const FRTPSODesc& Desc, bool bFinish);
	FRTStatus FinishAll(std::unique_lock<std::mutex>& Lock, const FRTPSODesc& Desc, const std::function<void(float)>& Progress);
	FRTStatus FinishUnits(std::unique_lock<std::mutex>& Lock, const std::function<void(float)>& Progress);
	FRTStatus FinishLink(std::unique_lock<std::mutex>& Lock);

	const FPipelineTimeSource Time; ///< any thread may call it
	std::shared_ptr<const FRTPSO> Taken;
	std::optional<std::vector<FProgramPriority>> NewPriorities;
	FRTPSOCompilerStats Known;
	std::vector<FFrameEvent> FrameEvents; ///< those that the pacer has not been told
	const FUnitCompiler UnitCompiler;
	std::mutex Mutex;          ///< never held during a call of the driver, of glslang, or of the file system
	FRTPSOScheduler Scheduler; ///< guarded by Mutex
	FRTPSOThreads Threads;     ///< last: its end joins them
};

FRTPSOCompiler::FImpl::FImpl(IRTDevice& Device, FShaderCompiler& Compiler, const FMaterialPrograms& Programs, FPipelineTimeSource InTime)
    : Time(InTime ? std::move(InTime) : [] { return std::chrono::steady_clock::now(); }),
      UnitCompiler(Device, Compiler),
      Scheduler(Device.GetCapabilities(), Programs, Time, [this] { Threads.Wake(); }),
      Threads(Mutex, Scheduler, UnitCompiler, Device)
{}

void FRTPSOCompiler::FImpl::TellPacer()
{
	FSwapPacer& Pacer = Scheduler.GetPacer();
	for (const FFrameEvent& Event : FrameEvents)
	{
		if (Event.GpuMs) { Pacer.FrameDone(Event.Frame, std::chrono::duration<double, std::milli>(*Event.GpuMs), Event.Time); }
		else { Pacer.FrameSubmitted(Event.Frame); }
	}
	FrameEvents.clear();
}

/// Tells the pacer at once if it can, so that events do not pile up where frames do not call Update.
void FRTPSOCompiler::FImpl::AddFrameEvent(const FFrameEvent& Event)
{
	FrameEvents.push_back(Event);
	const std::unique_lock Lock(Mutex, std::try_to_lock);
	if (Lock.owns_lock()) { TellPacer(); }
}

void FRTPSOCompiler::FImpl::Begin(const FRTPSODesc& Desc, bool bFinish)
{
	TellPacer();
	if (NewPriorities) { Scheduler.SetPriorities(std::exchange(NewPriorities, std::nullopt).value()); }
	Threads.SetCount(GetPipelineThreadCount());
	Scheduler.BeginFrame(Desc, GetSettings(), bFinish);
	Taken = Scheduler.GetCurrent();
}

FRTStatus FRTPSOCompiler::FImpl::FinishUnits(std::unique_lock<std::mutex>& Lock, const std::function<void(float)>& Progress)
{
	while (!Scheduler.AdvanceUnits())
	{
		// Counted before Progress is called: a result that comes meanwhile is not waited for.
		const uint64_t Before = Scheduler.GetResultCount();
		if (Progress)
		{
			const float Done = Scheduler.GetProgress();
			Lock.unlock();
			Progress(Done);
			Lock.lock();
		}
		Threads.WaitForResult(Lock, [&] { return Scheduler.GetResultCount() != Before || Scheduler.IsLost(); });
	}
	return Scheduler.FindFatalError();
}

FRTStatus FRTPSOCompiler::FImpl::FinishLink(std::unique_lock<std::mutex>& Lock)
{
	for (;;)
	{
		Threads.WaitForResult(Lock, [&] { return !Scheduler.IsLinkUnderWay() || Scheduler.IsLost(); });
		const std::optional<FRTStatus> Status = Scheduler.AdvanceLink();
		Taken = Scheduler.GetCurrent();
		if (Status) { return *Status; }
	}
}

FRTStatus FRTPSOCompiler::FImpl::FinishAll(
    std::unique_lock<std::mutex>& Lock, const FRTPSODesc& Desc, const std::function<void(float)>& Progress)
{
	if (FRTStatus S = FinishUnits(Lock, Progress); !S) { return S; }
	if (Scheduler.AddStandIns(Desc))
	{
		if (FRTStatus S = FinishUnits(Lock, Progress); !S) { return S; }
	}
	return FinishLink(Lock);
}

FRTPSOCompiler::FRTPSOCompiler(IRTDevice& Device, FShaderCompiler& Compiler, const FMaterialPrograms& Programs, FPipelineTimeSource Time)
    : Impl(std::make_unique<FImpl>(Device, Compiler, Programs, std::move(Time)))
{}

FRTPSOCompiler::~FRTPSOCompiler() = default;

void FRTPSOCompiler::Update(const FRTPSODesc& Wanted)
{
	// A thread of lower priority may be kept from running while it holds the lock. This frame then goes on without an update.
	const std::unique_lock Lock(Impl->Mutex, std::try_to_lock);
	if (!Lock.owns_lock() || Impl->Scheduler.IsLost()) { return; }
	Impl->Begin(Wanted, false);
	Impl->Scheduler.Advance();
}

FRTStatus FRTPSOCompiler::Finish(const FRTPSODesc& Wanted, const std::function<void(float)>& Progress, bool bStandIns)
{
	std::unique_lock Lock(Impl->Mutex);
	if (Impl->Scheduler.IsLost()) { return Impl->Scheduler.FindFatalError(); }
	Impl->Begin(Wanted, !bStandIns);
	// The usual frame: nothing is new.
	if (Impl->Scheduler.BeginFinish()) { return FRTStatus::Success(); }
	const FRTStatus Status = Impl->FinishAll(Lock, Wanted, Progress);
	Impl->Scheduler.EndFinish(Status);
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
	Impl->Threads.SetCount(GetPipelineThreadCount());
	Impl->Scheduler.AskForEdits();
}

const FRTPSOCompilerStats& FRTPSOCompiler::GetStats() const
{
	FRTPSOCompilerStats& Out = Impl->Known;
	const std::unique_lock Lock(Impl->Mutex, std::try_to_lock);
	if (!Lock.owns_lock()) { Out.bBusy = true; } // with what the owner of the lock does
	else { Impl->Scheduler.Count(Out); }
	return Out;
}

} // namespace Lantern
