// Constants of LocalLights/SecondRays.comp, shared by C++ and GLSL.
#ifndef LANTERN_SECOND_RAYS_TYPES_H
#define LANTERN_SECOND_RAYS_TYPES_H

#include "LocalLightTypes.h"

LANTERN_SHARED_BEGIN

struct FSecondRaysConstants
{
	FPassConstants Pass;
	FAddress TileLights; // FTileLights[]
	FAddress Requests;   // FRayRequest[Capacity]
	FAddress Counters;   // FRayQueueCounters of this queue
	FAddress Answers;    // uint[pixels], of the queue before
	uint Capacity;
	uint Depth, Normals; // sampled indices
	uint Pad;
};
LANTERN_ASSERT_SIZE(FSecondRaysConstants, 64);

LANTERN_SHARED_END

#endif
