// Constants of the sky's ambient light, shared by C++ and GLSL.
#ifndef LANTERN_SKY_LIGHT_TYPES_H
#define LANTERN_SKY_LIGHT_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define SKY_LIGHT_TERMS 9       // spherical harmonics of three bands
#define SKY_LIGHT_GROUP_SIZE 64 // threads of the one work group

struct FSkyLightConstants
{
	FPassConstants Pass;
	uint Output; // storage index
	uint Pad;
};
LANTERN_ASSERT_SIZE(FSkyLightConstants, 24);

LANTERN_SHARED_END

#endif
