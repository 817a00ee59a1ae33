// Lights of tiles and pixels, shared by C++ and GLSL.
#ifndef LANTERN_LOCAL_LIGHT_TYPES_H
#define LANTERN_LOCAL_LIGHT_TYPES_H

#include "TileTypes.h"

LANTERN_SHARED_BEGIN

#define TILE_LIGHTS 8u // most lights of a tile that all get rays

#define TILE_LIGHTS_MANY 0xffffffffu     // FTileLights::Count: each pixel chooses one light
#define TILE_LIGHT_UNSHADOWED 0x80000000u // in FTileLights::Lights: it casts no shadow and gets no ray

// What a tile's pixels are lit by.
struct FTileLights
{
	uint Count;                 // 0 to TILE_LIGHTS, or TILE_LIGHTS_MANY
	uint Lights[TILE_LIGHTS];   // index in the table of lights, in rising order, and TILE_LIGHT_UNSHADOWED
	uint Reached[2 * TILE_LIGHTS]; // two words for each light: pixels that it may light, in Z order. MANY: pixels that ask for a ray, first
};
LANTERN_ASSERT_SIZE(FTileLights, 100);

// The light that a pixel chose of many.
struct FLightChoice
{
	uint Light;   // index in the table of lights
	float Weight; // what its light is multiplied by, the inverse of the probability; 0: no light reaches the pixel
};
LANTERN_ASSERT_SIZE(FLightChoice, 8);

struct FLocalRequestsConstants
{
	FPassConstants Pass;
	FAddress TileLights; // FTileLights[], row by row
	FAddress Choices;    // FLightChoice[pixels]; 0 without MANY_LIGHTS
	FAddress Requests;   // FRayRequest[Capacity]
	FAddress Counters;   // FRayQueueCounters
	FAddress Answers;    // uint[pixels], to start with none; 0: they have started
	uint Capacity;
	uint Depth;   // sampled index
	uint Normals; // sampled index: shading and geometric normal, both octahedral
	uint Exact;   // most lights of a tile that all get rays, 1 to TILE_LIGHTS
};
LANTERN_ASSERT_SIZE(FLocalRequestsConstants, 72);

struct FLocalShadeConstants
{
	FPassConstants Pass;
	FAddress TileLights; // FTileLights[]
	FAddress Choices;    // FLightChoice[pixels]
	FAddress Answers;    // uint[pixels]
	uint Depth, Normals, BaseColor, Material; // sampled indices
	uint OutDiffuse, OutSpecular;             // storage indices, or NO_TEXTURE
};
LANTERN_ASSERT_SIZE(FLocalShadeConstants, 64);

LANTERN_SHARED_END

#endif
