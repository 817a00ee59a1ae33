// Constants of the debug view.
#ifndef LANTERN_DEBUG_VIEW_TYPES_H
#define LANTERN_DEBUG_VIEW_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define DEBUG_VIEW_GROUP_SIZE 8

struct FDebugViewConstants
{
	FPassConstants Pass;
	uint Input;     // sampled index: the signal
	uint Output;    // storage index
	uint bRadiance; // 0: shown as it is, grey; 1: exposed and tone-mapped
	uint Pad;
};
LANTERN_ASSERT_SIZE(FDebugViewConstants, 32);

LANTERN_SHARED_END

#endif
