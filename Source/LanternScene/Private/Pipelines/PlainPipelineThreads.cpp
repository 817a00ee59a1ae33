// What the threads that compile plain pipelines do.
#include "Pipelines/PlainPipelineThreads.h"

#include <algorithm>
#include <utility>

#include "LanternCore/Tasks/TaskTrace.h"
#include "Pipelines/GiveWay.h"

namespace Lantern
{

FPlainPipelineThreads::FPlainPipelineThreads(IRTDevice& InDevice, FShaderCompiler& InCompiler) : Device(InDevice), Compiler(InCompiler)
{
	const std::lock_guard Lock(Mutex);
	Threads.emplace_back([this] { Run(0); });
}

FPlainPipelineThreads::~FPlainPipelineThreads()
{
	{
		const std::lock_guard Lock(Mutex);
		bStop = true;
	}
	WorkAdded.notify_all();
	for (std::thread& Thread : Threads) { Thread.join(); }
}

void FPlainPipelineThreads::Add(FPlainJobRef Job, uint32_t MostThreads)
{
	NewJobs.push_back(std::move(Job));
	NewMost = MostThreads;
}

void FPlainPipelineThreads::HandOver(bool bWait)
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

void FPlainPipelineThreads::Wait(const FPlainJob& Job)
{
	std::unique_lock Lock(Mutex);
	// It goes before what frames have asked for and nobody waits for.
	const auto Place = std::find_if(Queue.begin(), Queue.end(), [&](const FPlainJobRef& Other) { return Other.get() == &Job; });
	if (Place != Queue.end()) { std::rotate(Queue.begin(), Place, Place + 1); }
	JobDone.wait(Lock, [&] { return Job.IsDone(); });
}

/// Starts one thread if more could work, and one that waits for what is to come. The caller holds Mutex.
void FPlainPipelineThreads::StartNext()
{
	if (Threads.size() >= std::min<size_t>(Most, Working + std::max<size_t>(1, Queue.size()))) { return; }
	const auto Index = static_cast<uint32_t>(Threads.size());
	Threads.emplace_back([this, Index] { Run(Index); });
}

void FPlainPipelineThreads::Run(uint32_t Index)
{
	GiveWayToFrames();
	FTaskTrace::NameThread("Plain compiler " + std::to_string(Index));
	std::unique_lock Lock(Mutex);
	for (;;)
	{
		WorkAdded.wait(Lock, [&] { return bStop || !Queue.empty() || !Doomed.empty(); });
		if (bStop) { return; }
		std::vector<FPlainJobRef> Old = std::exchange(Doomed, {});
		FPlainJobRef Job;
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
		Doomed.push_back(std::move(Job)); // may be the last reference, which Mutex must not be held for
	}
}

void FPlainPipelineThreads::Compile(FPlainJob& Job) const
{
	FTraceScope Trace("Compile", Job.Name);
	Job.Status = std::visit([&](const auto& Source) { return Make(Source, Job); }, Job.Source);
}

FRTStatus FPlainPipelineThreads::Make(const FShaderSource& Source, FPlainJob& Job) const
{
	FShaderBinary Binary;
	if (FRTStatus S = Compiler.Compile(Source, Binary); !S) { return S; }
	FRTComputePipelineDesc Desc;
	Desc.Shader = Binary.GetCode();
	Desc.Name = Job.Name.c_str();
	return Device.CreateComputePipeline(Desc, Job.Pipeline.ReleaseAndGetAddress());
}

FRTStatus FPlainPipelineThreads::Make(const FRasterSource& Source, FPlainJob& Job) const
{
	FShaderBinary Vertex, Fragment;
	if (FRTStatus S = Compiler.Compile(Source.Vertex, Vertex); !S) { return S; }
	if (FRTStatus S = Compiler.Compile(Source.Fragment, Fragment); !S) { return S; }
	FRTRasterPipelineDesc Desc;
	Desc.Vertex = Vertex.GetCode();
	Desc.Fragment = Fragment.GetCode();
	Desc.ColorFormats = Source.ColorFormats.data();
	Desc.ColorCount = static_cast<uint32_t>(Source.ColorFormats.size());
	Desc.DepthFormat = Source.DepthFormat;
	Desc.Cull = Source.Cull;
	Desc.Name = Job.Name.c_str();
	return Device.CreateRasterPipeline(Desc, Job.Pipeline.ReleaseAndGetAddress());
}

} // namespace Lantern
