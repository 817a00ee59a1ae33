// The queue of shadow rays. Passes write requests into it, one shader traces all of them, and answers lie in a word for each pixel.
//
// A new kind of ray is a RAY_KIND_… with its bits of an answer (RayQueueTypes.h), a case in Shaders/Rays/ShadowQueue.glsl, and what it
// needs to know in FShadowQueueConstants.
#pragma once

#include "LanternCore/FrameGraph/History.h"
#include "RayPath.h"

namespace Lantern
{

/// Buffers of one frame.
struct FRayQueue
{
	std::string Name = "Shadow"; ///< passes begin with it: FSignalInfo::SharedPass
	FGraphBuffer Requests;       ///< FRayRequest[Capacity]
	FGraphBuffer Counters;       ///< FRayQueueCounters
	FGraphBuffer Answers;        ///< uint32_t[Width · Height]
	/// float[Width · Height], see FShadowQueueConstants. Invalid: nobody asks.
	FGraphBuffer SunWidths;
	uint32_t Capacity = 0;   ///< requests
	uint64_t MostWanted = 0; ///< requests that a frame can make
	/// More rays can be asked for than have room. Those left out have no answer, and a later queue is larger.
	bool bMayOverflow = false;
	bool bRest = false; ///< holds rays that another queue of this frame has left out
};

/// Rays towards the sun.
struct FSunRays
{
	uint32_t SamplesPerPixel = 0; ///< 1 to 64; 0: nobody asks
	float MaxDistance = 0.0f;     ///< metres
	uint32_t InstanceMask = 0;
	uint32_t LitMask = 0;  ///< of rays with RAY_SLOT_SUN_LIT; 0: these are not traced
	uint32_t RayFlags = 0; ///< GetCasterRayFlags
	float Diameter = 0.0f; ///< of the disk that they go to, radians; 0: they go to its centre
	friend bool operator==(const FSunRays&, const FSunRays&) = default;
};

/// Adds what the queue's shaders need to know who casts on what a pixel shows, and what lets a share of light through.
void AddShadowRayDefines(const FSceneFacts& Facts, FShaderDefines& Defines);
/// Returns gl_RayFlags… of all shadow rays, by r.RT.Shadow.CasterFaces.
uint32_t GetCasterRayFlags();

/// Returns 1 − cosine of the disk's angular radius.
float GetSunOneMinusCos(const FSunRays& Rays);

/// Returns whether the pixels of a picture have an index in requests. Logs once if they have not.
bool CanQueueRays(uint32_t Width, uint32_t Height);

/// Returns whether queues of this frame's settings may lack room for so many requests of each pixel, so that shaders for it are needed.
bool MayQueuesOverflow(uint32_t MostPerPixel);

/// Chooses how the queue is traced: r.RT.Shadow.Path. What: as in ChooseRayPath.
ERayPath ChooseQueuePath(const FPassQuery& Query, const char* What);

/// MostPerPixel: requests that a pixel can make, which the queue never exceeds. It has room for what
/// r.RT.Rays.QueuePerPixel says, or for what earlier frames asked for. That of the half frame has room for all.
FRayQueue CreateRayQueue(FFrameContext& Context, uint32_t MostPerPixel);
/// Creates a further queue of the frame in the place of one that has been traced by then; answers lie where its do. What has no room
/// in it is left out. Suffix: of the names of its passes.
FRayQueue CreateFurtherQueue(FFrameContext& Context, const FRayQueue& Traced, const char* Suffix);

/// Empties the queue's counters. For the first pass that writes requests, while it is recorded; it has declared StorageWrite.
void StartQueue(FPassContext& Pass, const FRayQueue& Queue);

/// What the rays are traced for beside what the queue holds.
struct FQueuedRays
{
	FSunRays Sun;
	FGraphBuffer TileLights;    ///< FTileLights[], for rays to local lights; invalid: there are none
	FGraphBuffer Choices;       ///< FLightChoice[choices · Width · Height]; invalid: no pixel chooses a light
	FGraphBuffer Lit;           ///< FLitPixel[choices · Width · Height], for the shading; invalid: it goes by Choices alone
	FGraphBuffer Guide;         ///< two times FTileGuide[], this frame's at GuideOffset
	uint64_t GuideOffset = 0;   ///< bytes
	FHistoryTexture MaskLights; ///< which lights the slots of tiles have (FindMaskLights); Current invalid: nobody reads the light mask
	uint32_t LocalPerPixel = 0;
	uint32_t MoreSamples = 0; ///< see FShadowQueueConstants
	FGraphBuffer MoreAnswers; ///< uint[Width · Height], see LOCAL_MORE_RAYS; invalid: MoreSamples are of the sun, or nobody has asked
};
/// Adds the pass that traces what is in the queue. Dispatch: of Shaders/Rays/ShadowQueue.
void AddShadowRaysPass(
    FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, const FRayQueue& Queue, const FQueuedRays& Rays);

/// Path of the shaders that trace the queue, without suffix.
inline constexpr const char* ShadowQueueShaders = "Rays/ShadowQueue";

} // namespace Lantern
