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
// Known without a ray, see Tiles/Settled.glsl.
#define TILE_SUN_LIT 8u        // has long seen the sun, as have its neighbours
#define TILE_SUN_DARK 16u      // has not, nor have they
#define TILE_SUN_DISAGREES 32u // a ray of this frame says otherwise: all pixels of the tile are traced

struct FTile
{
	uint Classes;    // TILE_…
	uint SunRays[2]; // a bit for each pixel that asks for a sun ray, in Z order
	uint SunRest[2]; // pixels that ask for one only if those of SunRays say something new
};
LANTERN_ASSERT_SIZE(FTile, 20);

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
	float SunOneMinusCos; // of the disk that sun rays go to; 0: they go to its centre
	uint bSunRest;   // ShareQueue.comp: 1: the queue holds the rays of FTile::SunRest
	FAddress Settled; // ADAPTIVE only: FSettledConstants
};
LANTERN_ASSERT_SIZE(FTilesConstants, 80);

LANTERN_SHARED_END

#endif
