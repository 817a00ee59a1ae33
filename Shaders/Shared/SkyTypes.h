// What a sky program reads, and the constants of the passes that bake it, shared by C++ and GLSL.
#ifndef LANTERN_SKY_TYPES_H
#define LANTERN_SKY_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define SKY_PROGRAM_VALUES 16 // vec4 of a host's own
#define SKY_TILE_SIZE 64      // texels of the map that are baked together, in each direction
#define SKY_GROUP_SIZE 8

struct FSkyData
{
	vec3 ToSun;         // unit length; as the program's directions
	float Seconds;      // time of the host's, which moves clouds
	vec3 SunIrradiance; // on a plane that faces the sun, lux; 0: no sun
	uint Pad0;
	vec3 Radiance; // nits: the host's measure of how bright the sky is, as a uniform sky's
	uint Pad1;
	vec4 Values[SKY_PROGRAM_VALUES];
	vec3 Axes[3]; // rows: from the scene's directions to those that the program gets
	uint Pad2;
};
LANTERN_ASSERT_SIZE(FSkyData, 344);

struct FSkyBakeConstants
{
	FAddress Sky; // FSkyData
	uint Output;  // storage index
	uint Size;    // texels of the map, in each direction
	uint FirstTile;
	uint Pad;
};
LANTERN_ASSERT_SIZE(FSkyBakeConstants, 24);

struct FSkyFadeConstants
{
	uint Baked; // sampled index
	uint Shown; // storage index
	uint Size;
	float Share; // of Baked in what is shown then; 1: what was shown is not read
};
LANTERN_ASSERT_SIZE(FSkyFadeConstants, 16);

LANTERN_SHARED_END

#endif
