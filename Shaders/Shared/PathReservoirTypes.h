// Path reservoirs: paths that pixels keep from frame to frame, and take over from pixels around. Structures that C++ and GLSL share.
#ifndef LANTERN_PATH_RESERVOIR_TYPES_H
#define LANTERN_PATH_RESERVOIR_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define PATH_RESERVOIR_MOST_NEIGHBORS 8u

// FPathReservoir::State: count | flags | length of paths that are too short to be resampled, metres, fp16.
#define PATH_RESERVOIR_COUNT_MASK 0xffu
#define PATH_RESERVOIR_SKY 0x100u    // the path has met nothing
#define PATH_RESERVOIR_NEAR_MASK 0xffff0000u
#define PATH_RESERVOIR_SPHERE 0x200u // the pixel's object has a toon sphere: its paths do not see what others see

// One path of many, chosen by what it brings. It stands for all of them.
struct FPathReservoir
{
	vec3 Hit;       // place that the path met first, relative to the camera, metres; of the sky: direction
	uint HitNormal; // geometric, by PackOct24
	uint Radiance;  // from there to the pixel, by PackRgbe
	float Weight;   // one over the density by which the path was chosen, by solid angle; 0: there is none
	uint State;     // PATH_RESERVOIR_…; count 0: the pixel shows no surface
	vec3 Place;     // that its rays leave, relative to the camera, metres
	uint Normal;    // shading, there, by PackOct24
};
LANTERN_ASSERT_SIZE(FPathReservoir, 44);

// Those of a frame and of the one before: one for each thread that traces paths, row by row.
struct FPathReservoirs
{
	FAddress Current;  // FPathReservoir[]
	FAddress Previous; // 0: there are none
	uint MostCount; // paths that one may stand for, 1 to PATH_RESERVOIR_COUNT_MASK
	float Chance;   // with which a pixel forgets what it has kept, whatever it is
	uint Neighbors; // pixels around whose paths are taken over
	float Radius;   // pixels, within which they lie; above 0
};
LANTERN_ASSERT_SIZE(FPathReservoirs, 32);

LANTERN_SHARED_END

#endif
