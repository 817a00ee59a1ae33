// The queue of shadow rays: its buffers, and the pass that traces it.
#include "Rays/RayQueue.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "LanternCore/Text/Log.h"
#include "RayQueueTypes.h"
#include "Rays/RayQueueDemand.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<float> CVarQueuePerPixel("r.RT.Rays.QueuePerPixel", 2.0f,
    "Room in the queue of shadow rays: requests per pixel, 4 bytes each. No more is allocated than can be asked for. If rays find no room, "
    "their pixels keep the shadow of the frame before, and later queues are larger.",
    {0.0001, 64});

FShadowQueueConstants MakeConstants(FPassContext& Pass, const FFrameContext& Frame, const FRayQueue& Queue, const FSunRays& Sun)
{
	FShadowQueueConstants C{};
	C.Pass = Frame.Pass;
	C.Requests = Pass.GetBuffer(Queue.Requests)->GetDeviceAddress();
	C.Counters = Pass.GetBuffer(Queue.Counters)->GetDeviceAddress();
	C.Answers = Pass.GetBuffer(Queue.Answers)->GetDeviceAddress();
	C.SunWidths = Queue.SunWidths.IsValid() ? Pass.GetBuffer(Queue.SunWidths)->GetDeviceAddress() : 0;
	C.Capacity = Queue.Capacity;
	C.SamplesPerPixel = Sun.SamplesPerPixel;
	C.MaxDistance = Sun.MaxDistance;
	C.RayFlags = Sun.RayFlags;
	C.InstanceMask = Sun.InstanceMask;
	C.LitMask = Sun.LitMask;
	C.bSoft = Sun.bSoft ? 1u : 0u;
	return C;
}

void TraceQueue(FPassContext& Pass, const FFrameContext& Frame, const FRayDispatch& Dispatch, const FRayQueue& Queue,
    const FShadowQueueConstants& Constants, bool bIndirect)
{
	if (!bIndirect) { return TraceFrameRays(Pass, Frame, Dispatch.RayGen, Constants, Queue.Capacity, 1); }
	IRTCommandList& Commands = Pass.Commands();
	IRTBuffer* const Arguments = Pass.GetBuffer(Queue.Counters);
	Commands.SetPipeline(Dispatch.Compute ? Dispatch.Compute : Frame.RayPipeline->GetPipeline());
	Commands.PushConstants(&Constants, sizeof(Constants));
	if (Dispatch.Compute) { return Commands.DispatchIndirect(Arguments, offsetof(FRayQueueCounters, Groups)); }
	Commands.TraceRaysIndirect(Frame.RayTable->GetTable(), Dispatch.RayGen, Arguments, offsetof(FRayQueueCounters, Launch));
}
} // namespace

bool CanQueueRays(uint32_t Width, uint32_t Height)
{
	if (uint64_t(Width) * Height <= 1ull << RAY_INDEX_BITS) { return true; }
	LogOnce(ERTLogLevel::Warning, "shadow rays are off: the picture has more than 2^" + std::to_string(RAY_INDEX_BITS) + " pixels");
	return false;
}

bool MayQueuesOverflow() { return CVarQueuePerPixel.GetOnRenderThread() < 1.0f; }

FRayQueue CreateRayQueue(FFrameContext& Context, ESignal Signal)
{
	const uint64_t Pixels = uint64_t(Context.Width) * Context.Height;
	const double Room = std::ceil(Context.QueueDemand->GetRoom(CVarQueuePerPixel.GetOnRenderThread()) * double(Pixels));
	FRayQueue Queue;
	Queue.Name = GetSignalInfo(Signal).Pass;
	Queue.Capacity = static_cast<uint32_t>(std::min(Room, double(Pixels)));
	Queue.bMayOverflow = Queue.Capacity < Pixels;
	Queue.Requests = Context.Graph.CreateBuffer({Queue.Capacity * sizeof(FRayRequest)}, "RayRequests");
	Queue.Counters = Context.Graph.CreateBuffer({sizeof(FRayQueueCounters), ERTBufferUsage::CopyDest}, "RayQueueCounters");
	Queue.Answers = Context.Graph.CreateBuffer({Pixels * sizeof(uint32_t)}, "RayAnswers");
	return Queue;
}

void AddShadowRaysPass(
    FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, const FRayQueue& Queue, const FSunRays& Sun)
{
	// Without indirect launches, all of the queue's room is launched, and most threads end at once. A count read back would be of
	// another frame, and a frame that asks for more rays would lose some.
	const bool bIndirect = Dispatch.Compute || Context.Device.GetCapabilities().bIndirectTrace;
	const FFrameContext* const Frame = &Context;
	FGraphBuffer Demand;
	if (Queue.bMayOverflow)
	{
		const FRayQueueDemand::FQueue Asked{Queue.Counters, Queue.Capacity, uint64_t(Context.Width) * Context.Height};
		Demand = Context.QueueDemand->AddRead(Context.Graph, (Queue.Name + "Demand").c_str(), Asked);
	}
	Context.Graph.AddPass((Queue.Name + "Rays").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Read(GBuffer.Normals, ERTAccess::ShaderRead);
		Builder.Read(Queue.Requests, ERTAccess::ShaderRead);
		Builder.Read(Queue.Counters, ERTAccess::ShaderRead);
		if (bIndirect) { Builder.Read(Queue.Counters, ERTAccess::IndirectRead); }
		Builder.Read(Queue.Answers, ERTAccess::StorageRead);
		Builder.Write(Queue.Answers, ERTAccess::StorageWrite);
		if (Queue.SunWidths.IsValid()) { Builder.Write(Queue.SunWidths, ERTAccess::StorageWrite); }
		if (Demand.IsValid()) { Builder.Keep(Demand); }
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FShadowQueueConstants Constants = MakeConstants(Pass, *Frame, Queue, Sun);
			Constants.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			Constants.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			Pass.CountRays(uint64_t(Queue.Capacity) * Sun.SamplesPerPixel); // at most: the device alone knows how many
			TraceQueue(Pass, *Frame, Dispatch, Queue, Constants, bIndirect);
		};
	});
}

} // namespace Lantern
