// The share of a surface's light that objects which move may have changed.
#ifndef LANTERN_MOVED_SHARE_TYPES_H
#define LANTERN_MOVED_SHARE_TYPES_H

#include "SettledTypes.h"

LANTERN_SHARED_BEGIN

struct FMovedShareConstants
{
	FPassConstants Pass;
	FAddress Casters; // FMovedCaster[CasterCount]
	uint CasterCount; // at most SETTLED_MOST_CASTERS
	uint Depth, Normals; // sampled indices
	uint Output;         // storage index
};
LANTERN_ASSERT_SIZE(FMovedShareConstants, 40);

LANTERN_SHARED_END

#endif
