// Where the regions lie whose lists of lights tiles look at. They lie elsewhere in each frame, so that no border stays.
#ifndef LANTERN_LOCAL_REGIONS_GLSL
#define LANTERN_LOCAL_REGIONS_GLSL

#include "../Shared/LocalLightTypes.h"
#include "../Library/Bindings.glsl"
#include "../Library/Random.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FLightRegionRef { FLightRegion Data; };

const uint SizeOfRegion = 4u * (1u + 2u * REGION_LIGHTS); // bytes

// Returns by how many tiles the first region begins outside of the picture.
uvec2 RegionShift(FViewConstants View)
{
	uint Number = HashPcg(View.FrameIndex ^ 0x3c6ef372u);
	return uvec2(Number, Number >> 8u) % REGION_TILES;
}

uint RegionColumns(FViewConstants View) { return ((View.Width + TILE_SIZE - 1u) / TILE_SIZE + 2u * (REGION_TILES - 1u)) / REGION_TILES; }

uint RegionIndex(FViewConstants View, uvec2 Tile)
{
	uvec2 Region = (Tile + RegionShift(View)) / REGION_TILES;
	return Region.y * RegionColumns(View) + Region.x;
}

// Returns how many of Most draws lie below a sum of weights, all of them below the whole. They are stratified, and Offset of the first is
// the same for all. Rounding leaves no draw over, whoever has the last weight.
uint DrawsBelow(float Sum, float All, float Offset, uint Most)
{
	return Sum >= All ? Most : uint(clamp(ceil(Sum / All * float(Most) - Offset), 0.0, float(Most)));
}

#endif
