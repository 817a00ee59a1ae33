// Constants of camera motion, shared by C++ and GLSL.
#ifndef LANTERN_CAMERA_MOTION_TYPES_H
#define LANTERN_CAMERA_MOTION_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define CAMERA_MOTION_GROUP_SIZE 8 // threads in x and y

struct FCameraMotionConstants
{
	FPassConstants Pass;
	uint Depth;  // sampled index
	uint Output; // storage index
};
LANTERN_ASSERT_SIZE(FCameraMotionConstants, 24);

LANTERN_SHARED_END

#endif
