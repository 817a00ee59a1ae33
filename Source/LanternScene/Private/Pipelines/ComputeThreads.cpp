// What the threads that compile compute pipelines do.
#include "Pipelines/ComputeThreads.h"

#include <algorithm>
#include <utility>

#include "LanternCore/Tasks/TaskTrace.h"
#include "Pipelines/GiveWay.h"

namespace Lantern
{

FComputeThreads::FComputeThreads(IRTDevice& InDevice, FShaderCompiler& InCompiler) : Device(InDevice), Compiler(InCompiler)
{
	const std::lock_guard Lock(Mutex);
	Threads.emplace_back([this] { Run(0); });
}

FComputeThreads::~FComputeThreads()
{
	{
		const std::lock_guard Lock(Mutex);
		bStop = true;
	}
	WorkAdded.notify_all();
	for (std::thread& Thread : Threads) { Thread.join(); }
}

void FComputeThreads::Add(FComputeJobRef Job, uint32_t MostThreads)
{
	NewJobs.push_back(std::move(Job));
	NewMost = MostThreads;
}

void FComputeThreads::HandOver(bool bWait)
{
	if (NewJobs.empty() && NewDoomed.empty()) { return; }
	std::unique_lock Lock(Mutex, std::defer_lock);
	if (bWait) { Lock.lock(); }
	else if (!Lock.try_lock()) { return; }
	Queue.insert(Queue.end(), NewJobs.begin(), NewJobs.end());
	Doomed.insert(Doomed.end(), NewDoomed.begin(), NewDoomed.end());
	Most = NewMost;
	Lock.unlock();
	NewJobs.clear();
	NewDoomed.clear();
	WorkAdded.notify_all();
}

void FComputeThreads::Wait(const FComputeJob& Job)
{
	std::unique_lock Lock(Mutex);
	// It goes before what frames have asked for and nobody waits for.
	const auto Place = std::find_if(Queue.begin(), Queue.end(), [&](const FComputeJobRef& Other) { return Other.get() == &Job; });
	if (Place != Queue.end()) { std::rotate(Queue.begin(), Place, Place + 1); }
	JobDone.wait(Lock, [&] { return Job.IsDone(); });
}

/// Starts one thread if more could work, and one that waits for what is to come. The caller holds Mutex.
void FComputeThreads::StartNext()
{
	if (Threads.size() >= std::min<size_t>(Most, Working + std::max<size_t>(1, Queue.size()))) { return; }
	const auto Index = static_cast<uint32_t>(Threads.size());
	Threads.emplace_back([this, Index] { Run(Index); });
}

void FComputeThreads::Run(uint32_t Index)
{
	GiveWayToFrames();
	FTaskTrace::NameThread("Compute compiler " + std::to_string(Index));
	std::unique_lock Lock(Mutex);
	for (;;)
	{
		WorkAdded.wait(Lock, [&] { return bStop || !Queue.empty() || !Doomed.empty(); });
		if (bStop) { return; }
		std::vector<FComputeJobRef> Old = std::exchange(Doomed, {});
		FComputeJobRef Job;
		if (!Queue.empty())
		{
			Job = std::move(Queue.front());
			Queue.pop_front();
			++Working;
			StartNext();
		}
		Lock.unlock();
		Old.clear();
		if (Job) { Compile(*Job); }
		Lock.lock();
		if (!Job) { continue; }
		--Working;
		Job->bDone.store(true, std::memory_order_release);
		JobDone.notify_all();
	}
}

void FComputeThreads::Compile(FComputeJob& Job) const
{
	FTraceScope Trace("Compile", Job.Name);
	FShaderBinary Binary;
	Job.Status = Compiler.Compile(Job.Source, Binary);
	if (!Job.Status) { return; }
	FRTComputePipelineDesc Desc;
	Desc.Shader = Binary.GetCode();
	Desc.Name = Job.Name.c_str();
	Job.Status = Device.CreateComputePipeline(Desc, Job.Pipeline.ReleaseAndGetAddress());
}

} // namespace Lantern
