// Tiles of the screen and what they need, shared by C++ and GLSL.
#ifndef LANTERN_TILE_TYPES_H
#define LANTERN_TILE_TYPES_H

#include "RayQueueTypes.h"

LANTERN_SHARED_BEGIN

#define TILE_SIZE 8    // pixels in x and y
#define TILE_PIXELS 64 // threads of a work group

// Classes of a tile: what some pixel of it is.
#define TILE_SKY 1u
#define TILE_SUN_BEHIND 2u // its surface has its back to the sun, and is dark without a ray
#define TILE_SUN_TRACED 4u // asks for a sun ray
// By the host's shadow map. A pixel that is lit may ask for rays that look for other casters.
#define TILE_SUN_LIT 8u
#define TILE_SUN_DARK 16u

struct FTile
{
	uint Classes;    // TILE_…
	uint SunRays[2]; // a bit for each pixel that asks for a sun ray, in Z order
};
LANTERN_ASSERT_SIZE(FTile, 12);

struct FTilesConstants
{
	FPassConstants Pass;
	FAddress Tiles;     // FTile[], row by row
	FAddress Requests;  // FRayRequest[Capacity]
	FAddress Counters;  // FRayQueueCounters
	FAddress Answers;   // uint[pixels]
	uint Capacity;
	uint Depth;      // sampled index
	uint Normals;    // sampled index: shading and geometric normal, both octahedral
	uint SunSamples; // for each pixel, 1 to 64
	uint bSoftSun;   // 0: all rays go to the centre of the sun's disk
	uint SunMask;    // casters that rays look for: in general
	uint LitMask;    // and where the host's shadow map says that a pixel is lit
	uint Pad;
	FAddress HostShadow; // FHostShadowData, or what the host's shader reads; 0: no map in this frame
	FAddress SunWidths;  // as in FShadowQueueConstants; 0: nobody asks
};
LANTERN_ASSERT_SIZE(FTilesConstants, 96);

LANTERN_SHARED_END

#endif
