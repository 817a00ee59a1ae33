// Diffuse global illumination and reflections.
#ifndef LANTERN_INDIRECT_TYPES_H
#define LANTERN_INDIRECT_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

struct FDiffuseGIConstants
{
	FPassConstants Pass;
	uint Depth, Normals; // sampled indices
	uint Output;         // storage index
	uint SamplesPerPixel;
	uint MaxBounces; // scattering events, that at the pixel included
};
LANTERN_ASSERT_SIZE(FDiffuseGIConstants, 40);

struct FReflectionsConstants
{
	FPassConstants Pass;
	uint Depth, Normals, BaseColor, Material; // sampled indices
	uint Output;                              // storage index
	uint SamplesPerPixel;
	uint MaxBounces; // scattering events, that at the pixel included
	float MaxRoughness;
};
LANTERN_ASSERT_SIZE(FReflectionsConstants, 48);

LANTERN_SHARED_END

#endif
