// Constants of contact shadows (Tiles/Contact.glsl), shared by C++ and GLSL.
#ifndef LANTERN_CONTACT_TYPES_H
#define LANTERN_CONTACT_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

struct FContactConstants
{
	uint Motion;            // sampled index; NO_TEXTURE: no pixel names its object
	uint bUnnumbered;       // 1: pixels that name no object cast no rays
	uint ObjectCount;       // objects that pixels may name
	float DistanceOfRadius; // an object casts rays up to this distance for each metre of its radius
};
LANTERN_ASSERT_SIZE(FContactConstants, 16);

LANTERN_SHARED_END

#endif
