// The host's shadow map of the sun, shared by C++ and GLSL.
#ifndef LANTERN_HOST_SHADOW_TYPES_H
#define LANTERN_HOST_SHADOW_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define HOST_SHADOW_CASCADES 4
// What the map holds beside casters of an instance mask: things that rays cannot meet, as billboards and translucent layers.
#define HOST_SHADOW_OTHERS 256u

// The pyramid of a cascade: level n has one cell for 2^n × 2^n texels. Smaller cells than those of the first level are not stored,
// because the map itself is read there.
#define HOST_SHADOW_FIRST_LEVEL 2
#define HOST_SHADOW_LEVELS 16    // one more than the last level that can be
#define HOST_SHADOW_CASCADE_BYTES 200
#define HOST_SHADOW_GROUP_SIZE 8 // threads in x and y of Pyramid.comp, which makes four levels at a time
#define HOST_SHADOW_GROUP_LEVELS 4

struct FHostShadowCascadeData
{
	FAddress Pyramid; // vec2[]: distances from the near plane to the nearest and the farthest texel of a cell, metres
	// Rows: from positions relative to the camera to texels of the cascade, and to the distance from its near plane along the sun's
	// light; metres.
	vec4 ToMap[3];
	vec3 NormalToMap[3];     // rows: normals, likewise; the inverse transpose of ToMap
	float DepthScale;        // metres for one unit of a texel's depth; negative if depth is reversed
	float NearDepth;         // of a texel on the near plane, 0 or 1
	float TexelSize;         // metres
	float Bias;              // metres
	float SpreadTexels;      // by which the sun's disk spreads on the map for each metre between blocker and receiver, texels
	uint Map;                // sampled index
	uint FirstX, FirstY;     // first texel of the cascade in its texture
	uint Width, Height;      // texels
	uint TopLevel;           // the last one, of one cell
	uint Levels[HOST_SHADOW_LEVELS]; // of each level: its first cell in the pyramid
};
LANTERN_ASSERT_SIZE(FHostShadowCascadeData, HOST_SHADOW_CASCADE_BYTES);

struct FHostShadowData
{
	FAddress Cascades;  // FHostShadowCascadeData[], from the finest to the coarsest
	uint CascadeCount;
	uint bKept;         // the map holds HOST_SHADOW_OTHERS: rays do not replace it
	float TexelPixels;  // a lit texel must not be wider than so many pixels
	uint Pad;
};
LANTERN_ASSERT_SIZE(FHostShadowData, 24);

struct FPyramidConstants
{
	FAddress HostShadow; // FHostShadowData
	uint InputLevel;     // 0: the map
	uint Pad;
};
LANTERN_ASSERT_SIZE(FPyramidConstants, 16);

LANTERN_SHARED_END

#endif
