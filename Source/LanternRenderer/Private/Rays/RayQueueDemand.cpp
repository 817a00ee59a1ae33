// What the queue of shadow rays should have had room for.
#include "Rays/RayQueueDemand.h"

#include <algorithm>
#include <cstddef>

#include "LanternCore/Text/Log.h"
#include "RayQueueTypes.h"

namespace Lantern
{

namespace
{
/// A view that turns asks for a little more in each frame.
constexpr double Headroom = 1.25;
constexpr size_t SegmentBytes = sizeof(FRayQueueCounters::Segments);
} // namespace

void FRayQueueDemand::BeginFrame(uint32_t FlightIndex)
{
	bWritten = false;
	Ring.BeginFrame(FlightIndex, [this](const TReadbackRing<FNotes>::FEntry& Entry) {
		const auto* const Segments = static_cast<const FRaySegment*>(Entry.Buffer->GetMapped());
		uint64_t Wanted = 0;
		for (uint32_t I = 0; I < RAY_SEGMENTS; ++I) { Wanted += Segments[I].Wanted; }
		if (Wanted <= Entry.Notes.Capacity) { return; }
		Room = std::max(Room, Headroom * double(Wanted) / double(Entry.Notes.Pixels));
		LogOnce(ERTLogLevel::Warning,
		    "r.RT.Rays.QueuePerPixel: shadow rays found no room in their queue. Some pixels keep the shadow of the frame before, and the "
		    "next queues are larger.");
	});
}

double FRayQueueDemand::GetRoom(double PerPixel)
{
	if (PerPixel != Set) { Room = 0.0; }
	Set = PerPixel;
	return std::max(PerPixel, Room);
}

FGraphBuffer FRayQueueDemand::AddRead(FFrameGraph& Graph, const char* PassName, const FQueue& Queue)
{
	FRTStatus Status;
	auto* const Entry = Ring.Write(SegmentBytes, Status);
	if (!Entry)
	{
		LogOnce(ERTLogLevel::Warning, std::string("shadow rays are not counted: ") + Status.Message);
		return {};
	}
	Entry->Notes = {Queue.Capacity, Queue.Pixels};
	const FGraphBuffer Out = Graph.ImportBuffer(Entry->Buffer.Get(), ERTAccess::HostRead, ERTAccess::HostRead, "RayQueueDemand");
	Graph.MarkForLater(Out, &bWritten);
	Graph.AddPass(PassName, [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Queue.Counters, ERTAccess::CopyRead);
		Builder.Write(Out, ERTAccess::CopyWrite);
		Builder.AllowAsync();
		return [=, Counters = Queue.Counters](FPassContext& Pass) {
			Pass.Commands().CopyBuffer(
			    Pass.GetBuffer(Out), 0, Pass.GetBuffer(Counters), offsetof(FRayQueueCounters, Segments), SegmentBytes);
		};
	});
	return Out;
}

} // namespace Lantern
