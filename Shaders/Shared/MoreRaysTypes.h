// Constants of Tiles/MoreRays.comp, shared by C++ and GLSL.
#ifndef LANTERN_MORE_RAYS_TYPES_H
#define LANTERN_MORE_RAYS_TYPES_H

#include "TileTypes.h"

LANTERN_SHARED_BEGIN

struct FMoreRaysConstants
{
	FPassConstants Pass;
	FAddress Tiles;    // FTile[]
	FAddress Requests; // FRayRequest[Capacity]
	FAddress Counters; // FRayQueueCounters of this queue
	FAddress Answers;  // uint[pixels], of the queues before
	FAddress Widths;   // FShadowQueueConstants::SunWidths
	uint Capacity;
	uint Samples; // of each request
	uint Surface, PreviousSurface, Motion; // sampled indices; NO_TEXTURE, the last two: no pixel has a history
	uint Pad;
};
LANTERN_ASSERT_SIZE(FMoreRaysConstants, 80);

LANTERN_SHARED_END

#endif
