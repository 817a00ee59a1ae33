// Constants of the sample engine's shadow map, shared by C++ and GLSL.
#ifndef LANTERN_SHADOW_MAP_TYPES_H
#define LANTERN_SHADOW_MAP_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

struct FShadowMapConstants
{
	FPassConstants Pass;
	FAddress Objects; // uint[]: object index of each instance of the draw
	uint Section;     // index of the section within each of these objects
	uint Pad;
	vec4 ToClip[3]; // rows: from positions relative to the camera
};
LANTERN_ASSERT_SIZE(FShadowMapConstants, 80);

LANTERN_SHARED_END

#endif
