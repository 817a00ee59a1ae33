// What the threads of the RTPSO compiler do.
#include "Pipelines/RTPSOThreads.h"

#include <algorithm>
#include <chrono>
#include <string>

#include "LanternCore/Tasks/TaskTrace.h"
#include "Pipelines/GiveWay.h"
#include "Pipelines/RTPSOLink.h"

namespace Lantern
{

FRTPSOThreads::FRTPSOThreads(std::mutex& InMutex, FRTPSOScheduler& InScheduler, const FUnitCompiler& InCompiler, IRTDevice& InDevice)
    : Mutex(InMutex),
      Scheduler(InScheduler),
      Compiler(InCompiler),
      Device(InDevice)
{
	const std::lock_guard Lock(Mutex);
	Threads.emplace_back([this] { RunBackground(); });
}

FRTPSOThreads::~FRTPSOThreads()
{
	{
		const std::lock_guard Lock(Mutex);
		bStop = true;
	}
	WorkAdded.notify_all();
	for (std::thread& Thread : Threads) { Thread.join(); }
}

void FRTPSOThreads::SetCount(uint32_t InCount)
{
	const uint32_t Wanted = std::max(1u, InCount);
	if (Wanted != Count)
	{
		Count = Wanted;
		WorkAdded.notify_all();
	}
}

/// Starts one compile thread. The caller holds Mutex.
void FRTPSOThreads::StartNext()
{
	const auto Index = static_cast<uint32_t>(Threads.size() - 1);
	Threads.emplace_back([this, Index] { RunCompiler(Index); });
}

void FRTPSOThreads::RunCompiler(uint32_t Index)
{
	GiveWayToFrames();
	FTaskTrace::NameThread("Pipeline compiler " + std::to_string(Index));
	std::unique_lock Lock(Mutex);
	for (;;)
	{
		WorkAdded.wait(Lock, [&] { return bStop || IsCompilerMissing() || (Index < Count && Scheduler.HasUnit()); });
		if (bStop) { return; }
		if (IsCompilerMissing()) { StartNext(); }
		else { CompileNext(Lock); }
	}
}

void FRTPSOThreads::RunBackground()
{
	FTaskTrace::NameThread("Pipeline linker");
	std::unique_lock Lock(Mutex);
	for (;;)
	{
		WorkAdded.wait(Lock, [&] { return bStop || IsCompilerMissing() || Scheduler.GetBackgroundWork() != EBackgroundWork::None; });
		if (bStop) { return; }
		if (IsCompilerMissing())
		{
			StartNext();
			continue;
		}
		switch (Scheduler.GetBackgroundWork())
		{
		case EBackgroundWork::Link: LinkNext(Lock); break;
		case EBackgroundWork::FindEdits: FindEdits(Lock); break;
		case EBackgroundWork::EmptyTrash: EmptyTrash(Lock); break;
		case EBackgroundWork::None: break;
		}
	}
}

void FRTPSOThreads::CompileNext(std::unique_lock<std::mutex>& Lock)
{
	FUnitTask Task = Scheduler.TakeUnit();
	Lock.unlock();
	FUnitResult Result;
	{
		FTraceScope Trace("Compile", Task.Job.Unit.Name);
		Result = Compiler.Compile(Task.Job);
	}
	Task.Job.Shared.reset(); // may be the last reference, and much memory
	Lock.lock();
	Scheduler.StoreUnit(Task, std::move(Result));
	ResultStored.notify_all();
}

void FRTPSOThreads::LinkNext(std::unique_lock<std::mutex>& Lock)
{
	FLinkPlan Plan = Scheduler.TakeLink();
	Lock.unlock();
	using FClock = std::chrono::steady_clock;
	const auto Start = FClock::now();
	std::shared_ptr<const FRTPSO> Pipeline;
	FRTStatus Status;
	{
		FTraceScope Trace("Link RTPSO");
		Status = LinkRTPSO(Device, Plan, Pipeline);
	}
	const double Ms = std::chrono::duration<double, std::milli>(FClock::now() - Start).count();
	Lock.lock();
	Scheduler.StoreLink(Status, std::move(Pipeline), std::move(Plan), Ms);
	ResultStored.notify_all();
}

void FRTPSOThreads::FindEdits(std::unique_lock<std::mutex>& Lock)
{
	std::vector<FUnitLook> Looks = Scheduler.GetUnits().ListSettled();
	Lock.unlock();
	std::erase_if(Looks, [&](const FUnitLook& Look) { return Compiler.GetContentKey(Look.Unit) == Look.ContentKey; });
	Lock.lock();
	Scheduler.StoreEdits(Looks);
	ResultStored.notify_all();
}

void FRTPSOThreads::EmptyTrash(std::unique_lock<std::mutex>& Lock)
{
	std::vector<std::shared_ptr<void>> Doomed = Scheduler.GetTrash().Take();
	Lock.unlock();
	Doomed.clear();
	Lock.lock();
}

} // namespace Lantern
