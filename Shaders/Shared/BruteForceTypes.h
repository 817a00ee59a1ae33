// Indirect light by brute force, for all signals.
#ifndef LANTERN_BRUTE_FORCE_TYPES_H
#define LANTERN_BRUTE_FORCE_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

struct FBruteForceConstants
{
	FPassConstants Pass;
	uint Depth, Normals, BaseColor, Material; // sampled indices; the last two: NO_TEXTURE for signals that read neither
	uint Output;                              // storage index
	uint SamplesPerPixel;
	uint MaxBounces; // scattering events, that at the pixel included
	float MaxRoughness; // rougher surfaces are not traced
	FAddress RadianceCells; // FRadianceGrid, for shaders with RADIANCE_CELLS; 0: there are none
};
LANTERN_ASSERT_SIZE(FBruteForceConstants, 56);

// Of the pass that fills pixels which traced nothing.
struct FFillConstants
{
	FPassConstants Pass;
	uint Depth, Normals; // sampled indices
	uint Radiance;       // storage index
	uint Pad;
};
LANTERN_ASSERT_SIZE(FFillConstants, 32);

LANTERN_SHARED_END

#endif
