#ifndef LANTERN_MOTION_TYPES_H
#define LANTERN_MOTION_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define MOTION_GROUP_SIZE 8

struct FCameraMotionConstants
{
	FPassConstants Pass;
	uint Depth;  // sampled index
	uint Output; // storage index
};
LANTERN_ASSERT_SIZE(FCameraMotionConstants, 24);

LANTERN_SHARED_END

#endif
