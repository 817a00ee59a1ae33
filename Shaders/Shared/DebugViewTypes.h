// Constants of the debug view.
#ifndef LANTERN_DEBUG_VIEW_TYPES_H
#define LANTERN_DEBUG_VIEW_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define DEBUG_VIEW_GROUP_SIZE 8
#define DEBUG_SHOW_GREY 0     // the first channel as it is
#define DEBUG_SHOW_RADIANCE 1 // exposed and tone-mapped
#define DEBUG_SHOW_PICTURE 2  // a finished picture

struct FDebugViewConstants
{
	FPassConstants Pass;
	uint Input;     // sampled index: the signal
	uint Output;    // storage index
	uint Show;      // DEBUG_SHOW_…
	uint Scale;     // pixels of the picture for one of the input, in either direction
};
LANTERN_ASSERT_SIZE(FDebugViewConstants, 32);

LANTERN_SHARED_END

#endif
