#ifndef LANTERN_@UPPER@_TYPES_H
#define LANTERN_@UPPER@_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

struct F@NAME@Constants
{
	FPassConstants Pass;
	uint Depth, Material; // sampled indices
	uint Output;          // storage index
	uint Pad;
};
LANTERN_ASSERT_SIZE(F@NAME@Constants, 32);

LANTERN_SHARED_END

#endif
