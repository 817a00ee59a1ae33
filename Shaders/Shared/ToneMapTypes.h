// Constants of tone mapping, shared by C++ and GLSL.
#ifndef LANTERN_TONE_MAP_TYPES_H
#define LANTERN_TONE_MAP_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define TONE_MAP_GROUP_SIZE 8 // threads in x and y

struct FToneMapConstants
{
	FPassConstants Pass;
	uint Input;  // sampled index
	uint Output; // storage index
};
LANTERN_ASSERT_SIZE(FToneMapConstants, 24);

LANTERN_SHARED_END

#endif
