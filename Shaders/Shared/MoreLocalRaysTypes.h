// Constants of LocalLights/MoreLocalRays.comp, shared by C++ and GLSL.
#ifndef LANTERN_MORE_LOCAL_RAYS_TYPES_H
#define LANTERN_MORE_LOCAL_RAYS_TYPES_H

#include "LocalLightTypes.h"

LANTERN_SHARED_BEGIN

struct FMoreLocalRaysConstants
{
	FPassConstants Pass;
	FAddress TileLights;  // FTileLights[]
	FAddress Requests;    // FRayRequest[Capacity]
	FAddress Counters;    // FRayQueueCounters of this queue
	FAddress Answers;     // uint[pixels], of the queues before
	FAddress MoreAnswers; // uint[pixels], see LOCAL_MORE_RAYS; gets the slots
	uint Capacity;
	uint History, Anchors; // sampled indices, of the light that was filtered before (FTemporalConstants); NO_TEXTURE: there is none
	float EnoughFrames;    // of one ray each, that a history is relied on from
};
LANTERN_ASSERT_SIZE(FMoreLocalRaysConstants, 72);

LANTERN_SHARED_END

#endif
