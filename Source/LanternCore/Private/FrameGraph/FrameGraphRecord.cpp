// Records what was compiled: into one command list, or into several by tasks.
#include <algorithm>
#include <cassert>
#include <chrono>

#include "FrameGraph/FrameGraphImpl.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternCore/Tasks/Tasks.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarTasks("r.RT.FrameGraph.Tasks", true,
    "Tasks beside the render thread record refits, copies, skinning and the sample engine's raster, into command lists of their own. "
    "Off: the render thread records all. An engine's command list is always one thread's; see FRTModuleFrame::bSubmitAhead.");

class FContext final : public FPassContext
{
public:
	FContext(IRTCommandList& InCommands, IRTDevice& InDevice, const FGraphPass& InPass, const std::vector<FGraphResource>& InResources)
	    : List(InCommands),
	      DeviceUsed(InDevice),
	      Pass(InPass),
	      Resources(InResources)
	{}
	IRTCommandList& Commands() override { return List; }
	IRTDevice& Device() override { return DeviceUsed; }
	IRTTexture* GetTexture(FGraphTexture Texture) override
	{
		return IsDeclared(Texture.Index) ? Resources[Texture.Index].GetTexture() : nullptr;
	}
	IRTBuffer* GetBuffer(FGraphBuffer Buffer) override { return IsDeclared(Buffer.Index) ? Resources[Buffer.Index].GetBuffer() : nullptr; }
	void CountRays(uint64_t More) override { Rays += More; }

	uint64_t Rays = 0;

private:
	bool IsDeclared(uint32_t Index) const
	{
		const bool bDropped = std::find(Pass.Dropped.begin(), Pass.Dropped.end(), Index) != Pass.Dropped.end();
		const bool bDeclared = Index < Resources.size() && (Pass.Find(Index) || bDropped);
		assert(bDeclared && "a pass may use only what it declared in its setup");
		return bDeclared;
	}

	IRTCommandList& List;
	IRTDevice& DeviceUsed;
	const FGraphPass& Pass;
	const std::vector<FGraphResource>& Resources;
};
} // namespace

FRTStatus FFrameGraph::Execute(IRTCommandList& Commands, const FRTStatus* Failure)
{
	assert(!Impl->bExecuted && "a graph is executed once");
	if (FRTStatus Status = Compile(); !Status) { return Status; }
	std::vector<FImpl::FSegment> Segments = Impl->MakeSegments(false);
	Segments[0].List = &Commands;
	return Impl->Record(Segments, [=] { return Failure ? *Failure : FRTStatus::Success(); });
}

FRTStatus FFrameGraph::Execute(const FGraphRecorder& Recorder)
{
	assert(!Impl->bExecuted && "a graph is executed once");
	Impl->bAsync = Recorder.bAsync;
	Impl->bAhead = Recorder.Engine != nullptr;
	Impl->AheadQueue = Recorder.AheadQueue;
	if (FRTStatus Status = Compile(); !Status) { return Status; }
	std::vector<FImpl::FSegment> Segments = Impl->MakeSegments(CVarTasks.GetOnRenderThread());
	auto Segment = Segments.begin();
	for (const FGraphSubmission& Submission : Impl->Submissions)
	{
		for (uint32_t List = 0; List < Submission.ListCount; ++List, ++Segment)
		{
			if (Recorder.Engine != nullptr && &Submission == &Impl->Submissions.back()) { Segment->List = Recorder.Engine; }
			else if (FRTStatus Status = Recorder.NextList(Submission.Queue, Segment->List); !Status) { return Status; }
		}
	}
	return Impl->Record(
	    Segments, Recorder.GetFailure ? Recorder.GetFailure : [] { return FRTStatus::Success(); });
}

void FFrameGraph::FImpl::RecordBarriers(IRTCommandList& Commands, const std::vector<FGraphBarrier>& Barriers) const
{
	std::vector<FRTBarrier> Items;
	for (const FGraphBarrier& Barrier : Barriers)
	{
		const FGraphResource& Resource = Resources[Barrier.Resource];
		FRTBarrier& Item = Items.emplace_back();
		Item.Texture = Resource.bTexture ? Resource.GetTexture() : nullptr;
		Item.Buffer = Resource.bTexture ? nullptr : Resource.GetBuffer();
		Item.Before = Barrier.Before;
		Item.After = Barrier.After;
		Item.bOtherQueue = Barrier.bOtherQueue;
	}
	if (!Items.empty()) { Commands.Barriers(Items.data(), static_cast<uint32_t>(Items.size())); }
}

void FFrameGraph::FImpl::RecordPass(
    IRTCommandList& Commands, const FGraphPass& Pass, FPassTiming& Timing, IRTQueryPool* Queries, uint32_t Query) const
{
	FTraceScope Trace("Pass", Pass.Name);
	const auto Start = std::chrono::steady_clock::now();
	Commands.BeginMarker(Pass.Name.c_str());
	if (Queries) { Commands.WriteTimestamp(Queries, Query); }
	RecordBarriers(Commands, Pass.Barriers);
	FContext Context(Commands, Shared.Device, Pass, Resources);
	if (Pass.Execute) { Pass.Execute(Context); }
	if (Queries) { Commands.WriteTimestamp(Queries, Query + 1); }
	Commands.EndMarker();
	const std::chrono::duration<double, std::milli> Time = std::chrono::steady_clock::now() - Start;
	Timing = {Pass.Name, -1.0, Time.count(), Context.Rays, Pass.Queue};
}

void FFrameGraph::FImpl::RecordSegment(
    const FSegment& Segment, FTimedFrame& Frame, const std::vector<uint32_t>& Indices, const FGetFailure& GetFailure) const
{
	for (const uint32_t Index : Segment.Passes)
	{
		if (!GetFailure()) { return; }
		IRTQueryPool* const Queries = Frame.Queues[static_cast<size_t>(Passes[Index].Queue)].Pool.Get();
		const uint32_t Place = Indices[Index];
		const FGroupRun* const Run = FindRun(Index);
		if (!Run)
		{
			RecordPass(*Segment.List, Passes[Index], Frame.Passes[Place], Queries, 2 * Frame.Places[Place]);
			continue;
		}
		// A timestamp waits for all before it, and what comes behind would wait with it.
		const uint32_t OfRun = Frame.Places[Indices[Run->First] - 1];
		if (Queries && Index == Run->First) { Segment.List->WriteTimestamp(Queries, 2 * OfRun); }
		RecordPass(*Segment.List, Passes[Index], Frame.Passes[Place], nullptr, 0);
		if (Queries && Index == Run->Last) { Segment.List->WriteTimestamp(Queries, 2 * OfRun + 1); }
	}
}

void FFrameGraph::FImpl::ListTimed(FTimedFrame& Out, std::vector<uint32_t>& OutIndices, uint32_t (&OutCounts)[PassQueueCount]) const
{
	OutIndices.assign(Passes.size(), 0);
	Out.Passes.clear();
	Out.Places.clear();
	const auto Add = [&](const std::string& Name, ERTQueue Queue, bool bTimed) {
		FPassTiming& Timing = Out.Passes.emplace_back();
		Timing.Name = Name;
		Timing.GpuMs = -1.0;
		Timing.Queue = Queue;
		Out.Places.push_back(bTimed ? OutCounts[static_cast<size_t>(Queue)]++ : NoPass);
	};
	for (uint32_t Index = 0; Index < Passes.size(); ++Index)
	{
		if (Passes[Index].bCulled) { continue; }
		const FGroupRun* const Run = FindRun(Index);
		if (Run && Run->First == Index) { Add(Passes[Index].Group, Passes[Index].Queue, true); }
		OutIndices[Index] = static_cast<uint32_t>(Out.Passes.size());
		Add(Passes[Index].Name, Passes[Index].Queue, !Run);
	}
}

FTimedFrame& FFrameGraph::FImpl::BeginTiming(const std::vector<FSegment>& Segments, std::vector<uint32_t>& OutIndices)
{
	FTimedFrame Timed;
	uint32_t Counts[PassQueueCount] = {};
	ListTimed(Timed, OutIndices, Counts);
	FTimedFrame& Frame = Shared.BeginTiming(Counts);
	Frame.Passes = std::move(Timed.Passes);
	Frame.Places = std::move(Timed.Places);
	bool bReset[PassQueueCount] = {};
	for (const FSegment& Segment : Segments)
	{
		const size_t Queue = Segment.Passes.empty() ? 0 : static_cast<size_t>(Passes[Segment.Passes[0]].Queue);
		const FQueueQueries& Queries = Frame.Queues[Queue];
		if (bReset[Queue] || Segment.Passes.empty() || !Queries.Pool) { continue; }
		Segment.List->ResetQueries(Queries.Pool.Get(), 0, 2 * Queries.PassCount);
		bReset[Queue] = true;
	}
	return Frame;
}

FRTStatus FFrameGraph::FImpl::Record(const std::vector<FSegment>& Segments, const FGetFailure& GetFailure)
{
	bExecuted = true;
	++Shared.FrameCounter;
	Shared.Poison.clear();
	std::vector<uint32_t> Indices;
	FTimedFrame& Frame = BeginTiming(Segments, Indices);
	FTaskGroup Tasks;
	for (const FSegment& Segment : Segments)
	{
		if (Segment.bOnTask)
		{
			Tasks.Run([&] { RecordSegment(Segment, Frame, Indices, GetFailure); });
		}
	}
	for (const FSegment& Segment : Segments)
	{
		if (!Segment.bOnTask) { RecordSegment(Segment, Frame, Indices, GetFailure); }
	}
	if (Segments.size() > 1)
	{
		FTraceScope Trace("Wait for recording");
		Tasks.Wait();
	}
	if (FRTStatus Status = GetFailure(); !Status) { return Status; }
	RecordBarriers(*Segments.back().List, FinalBarriers);
	Frame.bPending = true;
	for (const auto& [Pooled, Access] : PooledAccess)
	{
		Pooled->LastAccess = Access;
		Pooled->LastFrame = Shared.FrameCounter;
	}
	Shared.TrimByAge();
	return FRTStatus::Success();
}

} // namespace Lantern
