// The queue of shadow rays: its buffers, and the pass that traces it.
#include "Rays/RayQueue.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "LanternCore/Text/Log.h"
#include "RayQueueTypes.h"
#include "Rays/RayQueueCounter.h"
#include "Rays/RayQueueDemand.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<float> CVarQueuePerPixel("r.RT.Rays.QueuePerPixel", 2.0f,
    "Room in the queue of shadow rays: requests per pixel, 4 bytes each. No more is allocated than can be asked for. If rays find no room, "
    "their pixels keep the shadow of the frame before, and later queues are larger.",
    {0.0001, 64});

TRTConsoleVariable<bool> CVarShares("r.RT.Transmission.Shadows", true,
    "Rays to the sun and to lights with extent pass what light shines through as often as it leaves light, if a filter follows. Shadows of "
    "glass and of blended surfaces are then as dark as these are. Off: such rays pass what leaves more than half.");
TRTConsoleVariable<bool> CVarReceivers(
    "r.RT.Debug.Shadow.Receivers", true, "Planted fault. If off, shadow rays from characters meet what those from other surfaces do.");
TRTConsoleVariable<int32_t> CVarPath(
    "r.RT.Shadow.Path", 0, "How shadow rays are traced. 0: as the device does best. 1: ray-tracing pipeline. 2: ray query.", {0, 2});

TRTConsoleVariable<int32_t> CVarCasterFaces("r.RT.Shadow.CasterFaces", 0,
    "Which faces cast shadows of single-sided planes. 0: either. 1: those turned to the light, as in shadow maps that cull back faces. "
    "2: those turned away from it, as in shadow maps that cull front faces. An object casts all the same if all of its materials are "
    "double-sided.",
    {0, 2});

FShadowQueueConstants MakeConstants(FPassContext& Pass, const FFrameContext& Frame, const FRayQueue& Queue, const FQueuedRays& Rays)
{
	const FSunRays& Sun = Rays.Sun;
	FShadowQueueConstants C{};
	C.Pass = Frame.Pass;
	C.Requests = GetAddress(Pass, Queue.Requests);
	C.Counters = GetAddress(Pass, Queue.Counters);
	C.Answers = GetAddress(Pass, Queue.Answers);
	C.SunWidths = GetAddress(Pass, Queue.SunWidths);
	C.TileLights = GetAddress(Pass, Rays.TileLights);
	C.Choices = GetAddress(Pass, Rays.Choices);
	C.Capacity = Queue.Capacity;
	C.SamplesPerPixel = Sun.SamplesPerPixel;
	C.MaxDistance = Sun.MaxDistance;
	C.RayFlags = GetCasterRayFlags();
	C.InstanceMask = Sun.InstanceMask;
	C.LitMask = Sun.LitMask;
	C.SunOneMinusCos = GetSunOneMinusCos(Sun);
	C.MoreSamples = Rays.MoreSamples;
	C.MoreAnswers = GetAddress(Pass, Rays.MoreAnswers);
	return C;
}

/// Launches of a pipeline are this wide at most on every device, and the positions of segments add up without a carry.
constexpr uint32_t MaxCapacity = 1u << 28;

void TraceQueue(FPassContext& Pass, const FFrameContext& Frame, const FRayDispatch& Dispatch, const FRayQueue& Queue,
    const FShadowQueueConstants& Constants, bool bIndirect)
{
	if (!bIndirect) { return TraceFrameRays(Pass, Frame, Dispatch.RayGen, Constants, Queue.Capacity, std::max(Constants.MoreSamples, 1u)); }
	IRTCommandList& Commands = Pass.Commands();
	IRTBuffer* const Arguments = Pass.GetBuffer(Queue.Counters);
	Commands.SetPipeline(Dispatch.Compute ? Dispatch.Compute : Frame.RayPipeline->GetPipeline());
	Commands.PushConstants(&Constants, sizeof(Constants));
	if (Dispatch.Compute) { return Commands.DispatchIndirect(Arguments, offsetof(FRayQueueCounters, Groups)); }
	Commands.TraceRaysIndirect(Frame.RayTable->GetTable(), Dispatch.RayGen, Arguments, offsetof(FRayQueueCounters, Launch));
}
} // namespace

/// A ray towards a light sees the backs of faces that are turned to it.
uint32_t GetCasterRayFlags()
{
	constexpr uint32_t CullBackFacing = 0x10, CullFrontFacing = 0x20; // gl_RayFlagsCullBackFacingTrianglesEXT, …Front…
	const int32_t Faces = CVarCasterFaces.GetOnRenderThread();
	return Faces == 1 ? CullFrontFacing : Faces == 2 ? CullBackFacing : 0u;
}

void AddShadowRayDefines(const FSceneFacts& Facts, FShaderDefines& Defines)
{
	AddTransmissionDefine(Facts, Defines);
	AddBackPixelsDefine(Facts.bBackPixels, Defines);
	if (Facts.bTransmissive && !CVarShares.GetOnRenderThread()) { Defines.emplace_back("NO_SHARES", "1"); }
	if (!Facts.bCharacters) { return; }
	Defines.emplace_back("HAS_CHARACTERS", "1");
	if (!CVarReceivers.GetOnRenderThread()) { Defines.emplace_back("ONE_RECEIVER", "1"); }
}

float GetSunOneMinusCos(const FSunRays& Rays)
{
	const double HalfSin = std::sin(0.25 * double(Rays.Diameter));
	return static_cast<float>(2.0 * HalfSin * HalfSin);
}

bool CanQueueRays(uint32_t Width, uint32_t Height)
{
	if (uint64_t(Width) * Height <= 1ull << RAY_INDEX_BITS) { return true; }
	LogOnce(ERTLogLevel::Warning, "shadow rays are off: the picture has more than 2^" + std::to_string(RAY_INDEX_BITS) + " pixels");
	return false;
}

bool MayQueuesOverflow(uint32_t MostPerPixel) { return CVarQueuePerPixel.GetOnRenderThread() < float(MostPerPixel); }

ERayPath ChooseQueuePath(const FPassQuery& Query, const char* What) { return ChooseRayPath(Query, CVarPath, What); }

FRayQueue CreateRayQueue(FFrameContext& Context, uint32_t MostPerPixel)
{
	const uint64_t Pixels = uint64_t(Context.Width) * Context.Height;
	FRayQueue Queue;
	Queue.MostWanted = Pixels * MostPerPixel;
	// The half frame's pixels are few: theirs has room for all, and the demand is that of the other.
	const double Room = Context.bHalf ? double(Queue.MostWanted)
	                                  : std::ceil(Context.QueueDemand->GetRoom(CVarQueuePerPixel.GetOnRenderThread()) * double(Pixels));
	if (Context.bHalf) { Queue.Name += "Half"; }
	Queue.Capacity =
	    static_cast<uint32_t>(std::max(std::min({Room, double(Queue.MostWanted), double(MaxCapacity)}), 1.0)); // buffers have a size
	Queue.bMayOverflow = Queue.Capacity < Queue.MostWanted;
	Queue.Requests = Context.Graph.CreateBuffer({Queue.Capacity * sizeof(FRayRequest)}, "RayRequests");
	Queue.Counters = Context.Graph.CreateBuffer({sizeof(FRayQueueCounters), ERTBufferUsage::CopyDest}, "RayQueueCounters");
	Queue.Answers = Context.Graph.CreateBuffer({Pixels * sizeof(uint32_t)}, "RayAnswers");
	return Queue;
}

FRayQueue CreateFurtherQueue(FFrameContext& Context, const FRayQueue& Traced, const char* Suffix)
{
	FRayQueue Further = Traced;
	Further.Name += Suffix;
	Further.bRest = false;
	Further.bMayOverflow = false;
	Further.Counters =
	    Context.Graph.CreateBuffer({sizeof(FRayQueueCounters), ERTBufferUsage::CopyDest}, (Further.Name + "Counters").c_str());
	return Further;
}

void StartQueue(FPassContext& Pass, const FRayQueue& Queue)
{
	IRTBuffer* const Counters = Pass.GetBuffer(Queue.Counters);
	IRTCommandList& Commands = Pass.Commands();
	// Others reach the counters as the pass has declared it, behind this.
	constexpr ERTAccess Declared = ERTAccess::StorageWrite;
	const FRTBarrier Before{Counters, nullptr, Declared, ERTAccess::CopyWrite}, After{Counters, nullptr, ERTAccess::CopyWrite, Declared};
	Commands.Barriers(&Before, 1);
	const auto Fill = [&](uint64_t Offset, uint64_t Size, uint32_t Value) { Commands.FillBuffer(Counters, Offset, Size, Value); };
	constexpr uint64_t Word = sizeof(uint32_t), Groups = offsetof(FRayQueueCounters, Groups), Launch = offsetof(FRayQueueCounters, Launch);
	Fill(Groups, Word, RAY_QUEUE_ROW_GROUPS);
	Fill(Groups + Word, Word, 0);
	Fill(Groups + 2 * Word, Word, 1);
	Fill(Launch, Word, 0);
	Fill(Launch + Word, 2 * Word, 1);
	Fill(offsetof(FRayQueueCounters, Segments), sizeof(FRayQueueCounters::Segments), 0);
	Commands.Barriers(&After, 1);
}

void AddShadowRaysPass(
    FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, const FRayQueue& Queue, const FQueuedRays& Rays)
{
	// Without indirect launches, all of the queue's room is launched, and most threads end at once. A count read back would be of
	// another frame, and a frame that asks for more rays would lose some.
	const bool bIndirect = Dispatch.Compute || Context.Device.GetCapabilities().bIndirectTrace;
	const FFrameContext* const Frame = &Context;
	// Nobody but characters asks what a pixel shows.
	const bool bClasses = Dispatch.Has("HAS_CHARACTERS");
	const FGraphTexture Classes = bClasses ? GBuffer.Classes : FGraphTexture();
	const FGraphTexture Motion = bClasses && !Classes.IsValid() && GBuffer.bNamesObjects ? GBuffer.Motion : FGraphTexture();
	FGraphBuffer Demand, Count;
	if (Queue.bMayOverflow)
	{
		const FRayQueueDemand::FQueue Asked{Queue.Counters, Queue.Capacity, uint64_t(Context.Width) * Context.Height};
		Demand = Context.QueueDemand->AddRead(Context.Graph, (Queue.Name + "Demand").c_str(), Asked);
	}
	if (FRayQueueCounter::IsWanted())
	{
		const bool bMore = Rays.MoreSamples > 0;
		const FRayQueueCounter::FQueue Asked{Queue.Name + "Rays", Queue.Counters, Queue.Capacity,
		    bMore ? Rays.MoreSamples : Rays.Sun.SamplesPerPixel, bMore ? Rays.MoreSamples : 1};
		Count = Context.RayCounter->AddRead(Context.Graph, (Queue.Name + "Count").c_str(), Asked);
	}
	Context.Graph.AddPass((Queue.Name + "Rays").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Read(GBuffer.Normals, ERTAccess::ShaderRead);
		for (const FGraphTexture Texture : {Classes, Motion})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		Builder.Read(Queue.Requests, ERTAccess::ShaderRead);
		Builder.Read(Queue.Counters, ERTAccess::ShaderRead);
		if (bIndirect) { Builder.Read(Queue.Counters, ERTAccess::IndirectRead); }
		Builder.Read(Queue.Answers, ERTAccess::StorageRead);
		Builder.Write(Queue.Answers, ERTAccess::StorageWrite);
		if (Queue.SunWidths.IsValid()) { Builder.Write(Queue.SunWidths, ERTAccess::StorageWrite); }
		if (Rays.MoreAnswers.IsValid())
		{
			Builder.Read(Rays.MoreAnswers, ERTAccess::StorageRead);
			Builder.Write(Rays.MoreAnswers, ERTAccess::StorageWrite);
		}
		for (const FGraphBuffer Buffer : {Rays.TileLights, Rays.Choices})
		{
			if (Buffer.IsValid()) { Builder.Read(Buffer, ERTAccess::ShaderRead); }
		}
		for (const FGraphBuffer Read : {Demand, Count})
		{
			if (Read.IsValid()) { Builder.Keep(Read); }
		}
		Builder.AllowAsync();
		Builder.RunBeside(PathsGroup);
		return [=](FPassContext& Pass) {
			FShadowQueueConstants Constants = MakeConstants(Pass, *Frame, Queue, Rays);
			Constants.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			Constants.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			Constants.Motion = GetSampledIndex(Pass, Motion);
			Constants.Classes = GetSampledIndex(Pass, Classes);
			Constants.ClassesOffset = GBuffer.ClassesOffset.x | (GBuffer.ClassesOffset.y << 16);
			// At most: the device alone knows how many. Those of the rest are among the first queue's.
			const uint64_t Pixels = uint64_t(Frame->Width) * Frame->Height;
			const uint64_t Most = std::min<uint64_t>(Pixels, Queue.Capacity) * Rays.Sun.SamplesPerPixel + Pixels * Rays.LocalPerPixel;
			Pass.CountRays(Queue.bRest ? 0 : Most);
			TraceQueue(Pass, *Frame, Dispatch, Queue, Constants, bIndirect);
		};
	});
}

} // namespace Lantern
