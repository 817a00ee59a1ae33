// From the frame's graph to the device: command lists, errors of passes, submissions.
#include <algorithm>
#include <cassert>

#include "Feedback/AnyHitCounter.h"
#include "Feedback/PathRayCounter.h"
#include "Feedback/PixelExplainer.h"
#include "Feedback/RadianceAuditor.h"
#include "Feedback/RadianceCellCounter.h"
#include "Feedback/ReflectionCounter.h"
#include "Feedback/StandInFeedback.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternRenderer/Renderer.h"

namespace Lantern
{

FRTStatus FRenderer::BeginList(ERTQueue Queue, IRTCommandList*& Out)
{
	const auto Index = static_cast<size_t>(Queue);
	std::vector<TRTRef<IRTCommandList>>& Mine = Lists[FlightIndex][Index];
	if (ListsUsed[Index] == Mine.size())
	{
		TRTRef<IRTCommandList> Made;
		if (FRTStatus S = Device.CreateCommandList("Frame", Made.ReleaseAndGetAddress(), Queue); !S) { return S; }
		Mine.push_back(std::move(Made));
	}
	Out = Mine[ListsUsed[Index]].Get();
	const FRTStatus Status = Out->Begin();
	if (Status)
	{
		++ListsUsed[Index];
		Recorded.push_back(Out);
	}
	return Status;
}

void FFrameContext::Fail(const FRTStatus& Error) const { Owner->Fail(Error); }

void FRenderer::Fail(const FRTStatus& Error)
{
	const std::lock_guard Lock(FailureMutex);
	if (FrameStatus) { FrameStatus = Error; }
}

FRTStatus FRenderer::GetFailure()
{
	const std::lock_guard Lock(FailureMutex);
	return FrameStatus;
}

FRTStatus FRenderer::Execute(const std::function<FRTStatus()>& Run)
{
	assert(Graph);
	AddRayPasses(); // also where nobody asked: what was begun is recorded, so that the next frame finds it done
	AnyHits->GetCounters().AddRead(*Graph);
	CellCounter->GetCounters().AddRead(*Graph);
	CellAuditor->GetCounters().AddRead(*Graph);
	ReflectionCounter->GetCounters().AddRead(*Graph);
	PathRayCounter->GetCounters().AddRead(*Graph);
	Explainer->GetCounters().AddRead(*Graph);
	StandIns->GetCounters().AddRead(*Graph);
	FRTStatus Status = FrameStatus;
	if (Status)
	{
		FTraceScope Trace("Record passes");
		Status = Run();
	}
	// A graph that failed may not have come to the pass that waits.
	PrebindTask.Wait();
	if (Status) { WriteConstants(); }
	if (Status && bDumpGraph) { LastDump = Graph->Dump(); }
	Graph.reset();
	return Status;
}

/// Submits what the graph recorded. OutFence: of all of it.
FRTStatus FRenderer::SubmitGraph(FRTFence& OutFence)
{
	FTraceScope Trace("Submit");
	std::vector<FRTFence> Done; // by submission
	IRTCommandList* const* Next = Recorded.data();
	for (const FGraphSubmission& Submission : Submissions)
	{
		std::vector<FRTFence> Waits;
		for (const uint32_t Wait : Submission.Waits) { Waits.push_back(Done[Wait]); }
		if (Submission.bWaitsForLastGraph && LastGraph != 0) { Waits.push_back(LastGraph); }
		FRTFence Fence = 0;
		const FRTStatus Status = Device.Submit(Next, Submission.ListCount, &Fence, Waits.data(), static_cast<uint32_t>(Waits.size()));
		if (!Status)
		{
			// Lists of this frame must not be begun again while some of them run.
			if (!Done.empty()) { (void)Device.WaitIdle(); }
			return Status;
		}
		Next += Submission.ListCount;
		Done.push_back(Fence);
	}
	OutFence = Done.back();
	return FRTStatus::Success();
}

void FRenderer::StartRecording()
{
	Recorded.clear();
	Submissions.clear();
	std::fill(std::begin(ListsUsed), std::end(ListsUsed), 0u);
}

/// Ends the lists of this frame. Status: whether they were recorded.
FRTStatus FRenderer::EndLists(FRTStatus Status)
{
	for (IRTCommandList* const List : Recorded)
	{
		const FRTStatus Ended = List->End();
		if (Status) { Status = Ended; }
	}
	return Status;
}

FRTStatus FRenderer::EndFrame(FRTFence* OutFence)
{
	StartRecording();
	const FGraphRecorder Recorder{[this](ERTQueue Queue, IRTCommandList*& Out) { return BeginList(Queue, Out); },
	    [this] { return GetFailure(); }, Device.GetCapabilities().bAsyncComputeQueue};
	FRTStatus Status = EndLists(Execute([&] {
		const FRTStatus Executed = Graph->Execute(Recorder);
		Submissions = Graph->GetSubmissions();
		return Executed;
	}));
	FRTFence Fence = 0;
	if (Status) { Status = SubmitGraph(Fence); }
	FrameSubmitted(Fence);
	if (OutFence) { *OutFence = Fence; }
	return Status;
}

FRTStatus FRenderer::EndFrame(IRTCommandList& List)
{
	return Execute([&] {
		const FRTStatus Status = Graph->Execute(List, &FrameStatus);
		return Status ? List.GetStatus() : Status; // an engine's list has no End that would say so
	});
}

FRTStatus FRenderer::EndFrame(IRTCommandList& List, const FAheadWork& Ahead, FRTFence& OutAhead)
{
	OutAhead = 0;
	StartRecording();
	FGraphRecorder Recorder{
	    [this](ERTQueue Queue, IRTCommandList*& Out) { return BeginList(Queue, Out); }, [this] { return GetFailure(); }};
	Recorder.Engine = &List;
	Recorder.AheadQueue = Ahead.Queue;
	FRTStatus Status = EndLists(Execute([&] {
		const FRTStatus Executed = Graph->Execute(Recorder);
		return Executed ? List.GetStatus() : Executed;
	}));
	std::vector<IRTCommandList*> Submitted(Recorded);
	if (Ahead.First != nullptr) { Submitted.insert(Submitted.begin(), Ahead.First); }
	if (!Status || Submitted.empty()) { return Status; }
	std::vector<FRTFence> Waits;
	for (const FRTFence Fence : {LastGraph, Ahead.WaitFor})
	{
		if (Fence != 0 && Ahead.Queue != GetFenceQueue(Fence)) { Waits.push_back(Fence); }
	}
	FTraceScope Trace("Submit ahead");
	return Device.Submit(
	    Submitted.data(), static_cast<uint32_t>(Submitted.size()), &OutAhead, Waits.data(), static_cast<uint32_t>(Waits.size()));
}

} // namespace Lantern
