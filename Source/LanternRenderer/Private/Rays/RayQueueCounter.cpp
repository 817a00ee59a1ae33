// Counts of traced rays, read back.
#include "Rays/RayQueueCounter.h"

#include <cstddef>
#include <utility>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "RayQueueTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCount("r.RT.Rays.Count", false,
    "Counts the shadow rays that are really traced, for tests and measurements. The count is read two frames later.");

constexpr uint64_t First = offsetof(FRayQueueCounters, Segments), Bytes = sizeof(FRayQueueCounters::Segments);
} // namespace

bool FRayQueueCounter::IsWanted() { return CVarCount.GetOnRenderThread(); }

uint64_t FRayQueueCounter::GetRays(const FRing::FEntry& Entry)
{
	// As SegmentEnd in RayQueue.glsl.
	const auto* const Segments = static_cast<const FRaySegment*>(Entry.Buffer->GetMapped());
	uint64_t End = 0, Rays = 0;
	for (uint32_t I = 0; I < RAY_SEGMENTS; ++I)
	{
		const uint64_t Requests = Segments[I].Wanted <= Entry.Notes.Capacity - End ? Segments[I].Wanted : Segments[I].Kept;
		Rays += Requests * (I == RAY_SEGMENT_SUN ? Entry.Notes.RaysPerSunRequest : Entry.Notes.RaysPerLocalRequest);
		End += Requests;
	}
	return Rays;
}

void FRayQueueCounter::BeginFrame(uint32_t FlightIndex)
{
	Used = 0;
	Flight = FlightIndex;
	FRayCounts Frame;
	for (const auto& Place : Places)
	{
		Place->bWritten = false;
		Place->Ring->BeginFrame(FlightIndex, [&](const FRing::FEntry& Entry) {
			Frame.Passes.emplace_back(Entry.Notes.Pass, GetRays(Entry));
			Frame.LastFrame += Frame.Passes.back().second;
		});
	}
	if (Frame.Passes.empty()) { return; }
	Frame.Total = Counts.Total + Frame.LastFrame;
	Frame.Frames = Counts.Frames + 1;
	Counts = std::move(Frame);
}

void FRayQueueCounter::TakeAll()
{
	for (uint32_t Step = 1; Step <= FRing::FramesInFlight; ++Step) { BeginFrame((Flight + 1) % FRing::FramesInFlight); }
}

FGraphBuffer FRayQueueCounter::AddRead(FFrameGraph& Graph, const char* PassName, const FQueue& Queue)
{
	if (Used == Places.size())
	{
		Places.push_back(
		    std::make_unique<FPlace>(FPlace{std::make_unique<FRing>(Device, "RayQueueCounts", ERTBufferUsage::CopyDest), false}));
		Places.back()->Ring->BeginFrame(Flight, [](const FRing::FEntry&) {});
	}
	FPlace& Place = *Places[Used++];
	FRTStatus Status;
	FRing::FEntry* const Entry = Place.Ring->Write(Bytes, Status);
	if (!Entry)
	{
		LogOnce(ERTLogLevel::Warning, std::string("shadow rays are not counted: ") + Status.Message);
		return {};
	}
	Entry->Notes = Queue;
	const FGraphBuffer Out = Graph.ImportBuffer(Entry->Buffer.Get(), ERTAccess::HostRead, ERTAccess::HostRead, "RayQueueCounts");
	Graph.MarkForLater(Out, &Place.bWritten);
	Graph.AddPass(PassName, [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Queue.Counters, ERTAccess::CopyRead);
		Builder.Write(Out, ERTAccess::CopyWrite);
		Builder.AllowAsync();
		return [=, Counters = Queue.Counters](
		           FPassContext& Pass) { Pass.Commands().CopyBuffer(Pass.GetBuffer(Out), 0, Pass.GetBuffer(Counters), First, Bytes); };
	});
	return Out;
}

void FRayQueueCounter::EndFrame(bool bSubmitted)
{
	for (const auto& Place : Places) { Place->Ring->EndFrame(bSubmitted && Place->bWritten); }
}

} // namespace Lantern
