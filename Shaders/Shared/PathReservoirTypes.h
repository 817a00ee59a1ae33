// Paths of pixels that the pixels around them use as well. Structures that C++ and GLSL share.
#ifndef LANTERN_PATH_RESERVOIR_TYPES_H
#define LANTERN_PATH_RESERVOIR_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

// A path that stands for all that were drawn for a pixel, and the light of those that met something near, which it does not stand for.
struct FPathReservoir
{
	vec3 Hit;          // place that the path met first, relative to the camera, metres; of the sky: direction
	uint bSky;
	uint Radiance;     // from there to the pixel, times the number of paths that it stands for, over all of the pixel's, by PackRgbe
	float Share;       // of a white Lambert lobe that it stands for: cosine / π over the density by which it was drawn; 0: there is no path
	uint Near;         // mean light of near paths, and what light sampling has found, by PackRgbe: irradiance / π
	uint NearSpecular; // what the specular lobe reflects of it, over its albedo, by PackRgbe
};
LANTERN_ASSERT_SIZE(FPathReservoir, 32);

struct FPathReservoirConstants
{
	FPassConstants Pass;
	FAddress Reservoirs; // FPathReservoir[] of the first launch's threads, row by row
	uint Depth, Normals; // sampled indices
	uint BaseColor, Material; // sampled indices, where there is a second lobe
	uint Output, SecondOutput; // storage indices
};
LANTERN_ASSERT_SIZE(FPathReservoirConstants, 48);

LANTERN_SHARED_END

#endif
