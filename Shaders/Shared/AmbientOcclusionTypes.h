// Constants of ambient occlusion, shared by C++ and GLSL.
#ifndef LANTERN_AMBIENT_OCCLUSION_TYPES_H
#define LANTERN_AMBIENT_OCCLUSION_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

struct FAmbientOcclusionConstants
{
	FPassConstants Pass;
	uint Depth;   // sampled index
	uint Normals; // sampled index: shading and geometric normal, both octahedral
	uint Output;  // storage index
	uint SamplesPerPixel;
	float Radius; // metres
	uint InstanceMask;
};
LANTERN_ASSERT_SIZE(FAmbientOcclusionConstants, 40);

LANTERN_SHARED_END

#endif
