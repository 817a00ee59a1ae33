// Constants of Tiles/MoreRays.comp, shared by C++ and GLSL.
#ifndef LANTERN_MORE_RAYS_TYPES_H
#define LANTERN_MORE_RAYS_TYPES_H

#include "SettledTypes.h"

LANTERN_SHARED_BEGIN

struct FMoreRaysConstants
{
	FPassConstants Pass;
	FAddress Tiles;    // FTile[]
	FAddress Marks;    // FSunQueueConstants::Marks
	FAddress Answers;  // uint[pixels], of the queues before
	FAddress Widths;   // FShadowQueueConstants::SunWidths
	uint Surface, Reprojection, Motion; // sampled indices; NO_TEXTURE, the last two: no pixel has a history
	uint History; // sampled index, of the shadows that were filtered before (FTemporalConstants); NO_TEXTURE: there is none
	FAddress Casters;   // FMovedCaster[CasterCount]: those that moved in the last frames
	uint CasterCount;
	float CasterSpread; // as in FTemporalConstants
};
LANTERN_ASSERT_SIZE(FMoreRaysConstants, 80);

LANTERN_SHARED_END

#endif
