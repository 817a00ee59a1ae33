// Lights of tiles and pixels, shared by C++ and GLSL.
#ifndef LANTERN_LOCAL_LIGHT_TYPES_H
#define LANTERN_LOCAL_LIGHT_TYPES_H

#include "TileTypes.h"

LANTERN_SHARED_BEGIN

#define TILE_LIGHTS 8u // most lights of a tile that all get rays

#define TILE_CHOSEN_MOST 4u // most lights that a pixel chooses where its tile has many

#define TILE_LIGHTS_MANY 0xffffffffu     // FTileLights::Count: each pixel chooses one light
#define TILE_LIGHT_UNSHADOWED 0x80000000u // in FTileLights::Lights: it casts no shadow and gets no ray
#define TILE_LIGHT_NONE 0xffffffffu // in FTileLights::Lights: with LIGHT_MASK, a free slot
#define TILE_CHOOSES_NOBODY 3u // FTileLights::bChooses: pixels choose of emissive triangles, but none has its turn in this frame
#define TILE_CHOOSES_REST 2u // FTileLights::bChooses: with LIGHT_MASK, there are more lights than slots; each pixel chooses one of the rest

// A light's number is its index in the table of lights, or this bit and the index of an emissive triangle. Where triangles are weighed
// by cluster, in tables and guides of tiles, it is this bit and the index of a cluster.
#define LIGHT_TRIANGLE (1u << (LIGHT_INDEX_BITS - 1))

// What a tile's pixels are lit by.
struct FTileLights
{
	uint Count;                 // 0 to TILE_LIGHTS, or TILE_LIGHTS_MANY
	uint Lights[TILE_LIGHTS];   // index in the table of lights, and TILE_LIGHT_UNSHADOWED. Rising; with LIGHT_MASK, a light keeps its slot
	uint Reached[2 * TILE_LIGHTS]; // two words for each light: pixels that it may light, in Z order
	uint bChooses; // not 0: each pixel has an FLightChoice, unless TILE_CHOOSES_NOBODY (HaveChosen): with MANY of all lights, and CHOSEN_RAYS of them; else one of emissive triangles alone
	uint Asking[2 * TILE_CHOSEN_MOST]; // two words for each choice: pixels that ask for a ray to it, in Z order
	uint Chose[2];  // with r.RT.Lights.Rate, of tiles of many lights: pixels that chose one in this frame
};
LANTERN_ASSERT_SIZE(FTileLights, 144);

// The light that a pixel chose of many.
struct FLightChoice
{
	uint Light;   // number of a light
	float Weight; // what its light is multiplied by, the inverse of the probability; 0: no light reaches the pixel
};
LANTERN_ASSERT_SIZE(FLightChoice, 8);

// Tiles of many lights, with r.RT.Lights.Candidates.
#define REGION_TILES 4u     // tiles along an edge of a region
#define REGION_LIGHTS 128u  // lights that a region lists for its tiles
#define REGION_EMITTERS 96u // clusters of emissive triangles that a region lists; with lights and the guide they fill a tile's table
#define REGION_THREADS 128u
#define TILE_TABLE_MOST 256 // lights that a tile weighs for its pixels: its region's, and those that it remembers
#define TILE_GUIDE_LIGHTS 32
#define TILE_GUIDE_RAY 32u   // what a ray counts in FGuideLight::Counts
#define TILE_GUIDE_RAYS 1024 // most rays of a light that are remembered

// How many of the last frames' rays from a tile to a light got through.
struct FGuideLight
{
	uint Light;  // number of a light or cluster
	uint Counts; // rays traced, 16 bits, and rays that got through; older ones count less
};
LANTERN_ASSERT_SIZE(FGuideLight, 8);

// The brightest lights of a tile, each at the place that its number and the tile's give.
struct FTileGuide
{
	FGuideLight Lights[TILE_GUIDE_LIGHTS];
};
LANTERN_ASSERT_SIZE(FTileGuide, 256);

// The lights that may reach a region, a square of tiles. If they are more than the list holds, it has REGION_LIGHTS that were drawn of
// them, the brightest possibly several times.
struct FLightRegion
{
	uint Count;                   // of lights that may reach it; more than REGION_LIGHTS: the list was drawn
	uint Lights[REGION_LIGHTS];   // index in the table of lights, in rising order
	float Stands[REGION_LIGHTS];  // how many lights like it an entry stands for
};
LANTERN_ASSERT_SIZE(FLightRegion, 1028);

struct FLightRegionsConstants
{
	FPassConstants Pass;
	FAddress Regions; // FLightRegion[], row by row; with EMITTERS behind FEmitterCluster[], see FEmitterHeader
	uint Depth, Normals; // sampled indices
};
LANTERN_ASSERT_SIZE(FLightRegionsConstants, 32);

// What a pixel reflects if the light that it chose is visible.
struct FLitPixel
{
	uint Lobes[3]; // 6 × fp16: diffuse and specular lobe
};
LANTERN_ASSERT_SIZE(FLitPixel, 12);

// Begins the buffer of clusters. FEmitterCluster[] follows, and behind it the FLightRegion[] of clusters if these are more than
// REGION_EMITTERS.
struct FEmitterHeader
{
	float ReflectedRoughness; // rougher surfaces have no reflections traced; negative: none have
	float Dim; // see DimEmitter
	uint Pad[2];
};
LANTERN_ASSERT_SIZE(FEmitterHeader, 16);

struct FEmitterClustersConstants
{
	FPassConstants Pass;
	FAddress Clusters; // FEmitterHeader, and what follows
	float ReflectedRoughness, Dim;
	uint Count, Pad; // Count: of clusters
};
LANTERN_ASSERT_SIZE(FEmitterClustersConstants, 40);

#define EMITTER_GROUP_SIZE 64u // clusters that a work group does

// FLocalRequestsConstants::Limits
#define PREVIOUS_GUIDE_NONE 0u
#define PREVIOUS_GUIDE_BEFORE 1u // it ends where this frame's begins
#define PREVIOUS_GUIDE_BEHIND 2u

struct FLocalRequestsConstants
{
	FPassConstants Pass;
	FAddress TileLights; // FTileLights[], row by row
	FAddress Choices;    // FLightChoice[choices][pixels]; 0 without MANY_LIGHTS. LISTS_CHOOSERS: FThreadList of tiles, each a work group
	FAddress Requests;   // FRayRequest[Capacity]
	FAddress Counters;   // FRayQueueCounters
	FAddress Answers;    // uint[pixels], to start with none; 0: they have started. Choose.comp: FThreadList of tiles
	uint Capacity;
	uint Depth;   // sampled index
	uint Normals; // sampled index: shading and geometric normal, both octahedral
	// low 8 bits: most lights of a tile that all get rays, 1 to TILE_LIGHTS. GUIDED: next 8: where FTileGuide[] of the previous frame lies,
	// PREVIOUS_GUIDE_…; high 16: candidates of each pixel, 1 to 64
	uint Limits;
	// GUIDED only:
	uint BaseColor, Material; // sampled indices
	FAddress Lit;             // FLitPixel[choices][pixels]; 0 with UNBIASED
	FAddress Guide;           // FTileGuide[], row by row; this frame's
	uint BackAlbedo;          // sampled index, or NO_TEXTURE
	uint PreviousLights;      // also not GUIDED, LIGHT_MASK only: sampled index of FLightMaskConstants::OutLights; NO_TEXTURE: there is none
	uint Channels;            // also not GUIDED, HAS_LIGHT_CHANNELS only: see LoadPixelChannels
	float GuideKept;          // share of what the guide knows that it keeps in this frame
	FAddress Regions;         // FLightRegion[], row by row; 0: tiles look at all lights of the scene
	FAddress Emitters;        // FEmitterHeader, and what follows it; 0: nothing emits
};
LANTERN_ASSERT_SIZE(FLocalRequestsConstants, 128);

struct FLocalShadeConstants
{
	FPassConstants Pass;
	FAddress TileLights; // FTileLights[]
	FAddress Choices;    // FLightChoice[choices][pixels]
	FAddress Answers;    // uint[pixels]
	uint Depth, Normals, BaseColor, Material; // sampled indices
	uint OutDiffuse, OutSpecular;             // storage indices, or NO_TEXTURE
	FAddress Lit;      // FLitPixel[choices][pixels]; GUIDED without UNBIASED only
	FAddress Guide;    // FTileGuide[]; GUIDED only
	float ReflectedRoughness; // LOCAL_EMISSIVE: rougher surfaces have no reflections traced; negative: none have
	uint Channels; // HAS_LIGHT_CHANNELS only: see LoadPixelChannels
	uint BackAlbedo; // sampled index, or NO_TEXTURE
	uint Pad;
	FAddress MoreAnswers; // uint[pixels], see LOCAL_MORE_RAYS; 0: there are none
};
LANTERN_ASSERT_SIZE(FLocalShadeConstants, 104);

// Constants of LocalLights/LampView.comp.
struct FLampViewConstants
{
	FPassConstants Pass;
	FAddress TileLights; // FTileLights[]
	FAddress Answers;    // uint[pixels]; 0: there are no rays
	uint Output;         // storage index
	uint bRays;          // 1: rays of each pixel; 0: lights of tiles
};
LANTERN_ASSERT_SIZE(FLampViewConstants, 40);

LANTERN_SHARED_END

#endif
