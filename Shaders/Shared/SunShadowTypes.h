// Constants of sun shadows, shared by C++ and GLSL.
#ifndef LANTERN_SUN_SHADOW_TYPES_H
#define LANTERN_SUN_SHADOW_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

struct FSunShadowConstants
{
	FPassConstants Pass;
	uint Depth;   // sampled index
	uint Normals; // sampled index: shading and geometric normal, both octahedral
	uint Output;  // storage index
	uint SamplesPerPixel;
	float MaxDistance; // metres
	uint RayFlags;     // gl_RayFlags… to add to those that the pass needs
	uint InstanceMask;
	uint bSoft; // 0: hard shadows, from the centre of the sun's disk
	uint OutPenumbra; // storage index, or NO_TEXTURE; WITH_PENUMBRA only
	uint Pad;
};
LANTERN_ASSERT_SIZE(FSunShadowConstants, 56);

LANTERN_SHARED_END

#endif
