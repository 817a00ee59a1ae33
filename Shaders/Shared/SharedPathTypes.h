// Paths of pixels that the pixels around them use as well. Structures that C++ and GLSL share.
#ifndef LANTERN_SHARED_PATH_TYPES_H
#define LANTERN_SHARED_PATH_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

// The path of a pixel that pixels around use as well, or what it has brought if it met something near.
struct FSharedPath
{
	vec3 Hit;          // place that the path met first, relative to the camera, metres; of the sky: direction
	uint SkyAndGone;   // bit 0: the sky. From bit 16 on: part of itself by which the light was more a moment ago, fp16
	uint Radiance;     // from there to the pixel, by PackRgbe
	float Share;       // cosine / π over the density by which the path was drawn; 0: there is none for others
	uint Near;         // light of a near path, and what light sampling has found, by PackRgbe: irradiance / π
	uint NearSpecular; // what the specular lobe reflects of it, over its albedo, by PackRgbe
};
LANTERN_ASSERT_SIZE(FSharedPath, 32);

// By how much the light of a tile's paths has changed of late.
struct FPathChange
{
	float Light;   // sum of its luminance
	float Gone;    // sum of that by which it was more a moment ago
	float Squares; // of these
};
LANTERN_ASSERT_SIZE(FPathChange, 12);

struct FSharedPathConstants
{
	FPassConstants Pass;
	FAddress Shared; // FSharedPath[] of the first launch's threads, row by row
	uint Depth, Normals; // sampled indices
	uint BaseColor, Material; // sampled indices, where there is a second lobe
	uint Output, SecondOutput; // storage indices
	uint ToonPixels;           // sampled index of what ToonSurface.comp writes, or NO_TEXTURE
	uint BackAlbedo;           // sampled index, or NO_TEXTURE
	FAddress Changes;          // FPathChange[tiles]; 0: nothing has changed for long
};
LANTERN_ASSERT_SIZE(FSharedPathConstants, 64);

LANTERN_SHARED_END

#endif
