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
// Known without a ray: by the host's shadow map, or see Tiles/Settled.glsl. A pixel that the map lights may ask for rays that look for
// other casters.
#define TILE_SUN_LIT 8u
#define TILE_SUN_DARK 16u
#define TILE_SUN_DISAGREES 32u // a ray of this frame says otherwise than what has settled: all pixels of the tile are traced

struct FTile
{
	uint Classes;    // TILE_…
	uint SunRays[2]; // a bit for each pixel that asks for a sun ray, in Z order
	uint SunRest[2]; // pixels that ask for one only if those of SunRays say something new
	uint SunLit[2];  // of SunRays: the pixel is lit by the host's shadow map (RAY_SLOT_SUN_LIT)
};
LANTERN_ASSERT_SIZE(FTile, 28);

// Which rays QueueSun.comp queues, and what counts as wanted.
#define SUN_QUEUE_ROOM 0u // those that have room
#define SUN_QUEUE_ALL 1u  // all: ShareQueue.comp follows, which unmarks what has no room
#define SUN_QUEUE_KEPT 2u // what that has left, if the queue had overflowed

// Constants of QueueSun.comp and ShareQueue.comp.
struct FSunQueueConstants
{
	FPassConstants Pass;
	FAddress Marks;    // uvec2[TileCount]: a bit for each pixel that asks for a ray, in Z order
	FAddress Tiles;    // FTile[TileCount], of which SunLit holds; 0: no pixel is lit by the host's shadow map
	FAddress Requests; // FRayRequest[Capacity]
	FAddress Counters; // FRayQueueCounters
	uint Capacity;
	uint TileCount;
	uint Samples; // threads of each request
	uint Rays;    // SUN_QUEUE_…
};
LANTERN_ASSERT_SIZE(FSunQueueConstants, 64);

struct FTilesConstants
{
	FPassConstants Pass;
	FAddress Tiles;     // FTile[], row by row
	FAddress Answers;   // uint[pixels]
	uint Depth;      // sampled index
	uint Normals;    // sampled index: shading and geometric normal, both octahedral
	uint SunSamples; // for each pixel, 1 to 64
	float SunOneMinusCos; // of the disk that sun rays go to; 0: they go to its centre
	uint SunMask;    // casters that rays look for: in general
	uint LitMask;    // and where the host's shadow map says that a pixel is lit
	FAddress Settled; // ADAPTIVE only: FSettledConstants
	FAddress HostShadow; // FHostShadowData, or what the host's shader reads; 0: no map in this frame
	FAddress SunWidths;  // as in FShadowQueueConstants; 0: nobody asks
	FAddress Marks;      // FSunQueueConstants::Marks, of SunRays
};
LANTERN_ASSERT_SIZE(FTilesConstants, 88);

LANTERN_SHARED_END

#endif
