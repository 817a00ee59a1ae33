// Diffuse global illumination: constants of its passes beside the rays.
#ifndef LANTERN_DIFFUSE_GI_TYPES_H
#define LANTERN_DIFFUSE_GI_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

struct FDiffuseGIFillConstants
{
	FPassConstants Pass;
	uint Depth, Normals; // sampled indices
	uint Radiance;       // storage index
	uint Pad;
};
LANTERN_ASSERT_SIZE(FDiffuseGIFillConstants, 32);

LANTERN_SHARED_END

#endif
