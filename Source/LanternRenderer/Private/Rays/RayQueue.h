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
	/// More rays can be asked for than have room. Those left out have no answer, and a later queue is larger.
	bool bMayOverflow = false;
};

/// Rays towards the sun.
struct FSunRays
{
	uint32_t SamplesPerPixel = 1; ///< 1 to 64
	float MaxDistance = 0.0f;     ///< metres
	uint32_t RayFlags = 0;        ///< gl_RayFlags…
	uint32_t InstanceMask = 0;
	uint32_t LitMask = 0; ///< of rays with RAY_SLOT_SUN_LIT; 0: these are not traced
	bool bSoft = false; ///< towards all of the disk; if false, to its centre
};

/// Returns whether the pixels of a picture have an index in requests. Logs once if they have not.
bool CanQueueRays(uint32_t Width, uint32_t Height);

/// Returns whether queues of this frame's settings may lack room, so that shaders for it are needed.
bool MayQueuesOverflow();

/// Signal: whose passes trace it. The queue has room for what r.RT.Rays.QueuePerPixel says, or for what earlier frames asked for. It has
/// room for one request of each pixel at most, since no more can be asked for.
FRayQueue CreateRayQueue(FFrameContext& Context, ESignal Signal);

/// Adds the pass that traces what is in the queue. Dispatch: of Shaders/Rays/ShadowQueue.
void AddShadowRaysPass(
    FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, const FRayQueue& Queue, const FSunRays& Sun);

/// Path of the shaders that trace the queue, without suffix.
inline constexpr const char* ShadowQueueShaders = "Rays/ShadowQueue";

} // namespace Lantern
