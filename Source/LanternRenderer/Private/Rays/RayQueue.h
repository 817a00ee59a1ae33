// The queue of shadow rays. Passes write requests into it, one shader traces all of them, and answers lie in a word for each pixel.
//
// A new kind of ray is a RAY_KIND_… with its bits of an answer (RayQueueTypes.h), a case in Shaders/Rays/ShadowQueue.glsl, and what it
// needs to know in FShadowQueueConstants.
#pragma once

#include "RayPath.h"

namespace Lantern
{

/// Buffers of one frame.
struct FRayQueue
{
	std::string Name;      ///< passes begin with it: FSignalInfo::Pass
	FGraphBuffer Requests; ///< FRayRequest[Capacity]
	FGraphBuffer Counters; ///< FRayQueueCounters
	FGraphBuffer Answers;  ///< uint32_t[Width · Height]
	/// float[Width · Height], see FShadowQueueConstants. Invalid: nobody asks.
	FGraphBuffer SunWidths;
	uint32_t Capacity = 0; ///< requests
};

/// Rays towards the sun.
struct FSunRays
{
	uint32_t SamplesPerPixel = 1; ///< 1 to 64
	float MaxDistance = 0.0f;     ///< metres
	uint32_t RayFlags = 0;        ///< gl_RayFlags…
	uint32_t InstanceMask = 0;
	bool bSoft = false; ///< towards all of the disk; if false, to its centre
};

/// Returns whether the pixels of a picture have an index in requests. Logs once if they have not.
bool CanQueueRays(uint32_t Width, uint32_t Height);

/// Name: of the signal's passes. The queue has room for what r.RT.Rays.QueuePerPixel says, and for one request of each pixel at most.
FRayQueue CreateRayQueue(FFrameContext& Context, ESignal Signal);

/// Adds the pass that traces what is in the queue. Dispatch: of Shaders/Rays/ShadowQueue.
void AddShadowRaysPass(
    FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, const FRayQueue& Queue, const FSunRays& Sun);

/// Path of the shaders that trace the queue, without suffix.
inline constexpr const char* ShadowQueueShaders = "Rays/ShadowQueue";

} // namespace Lantern
