// What tiles remember of their lights: how many rays to each got through in the last frames.
#ifndef LANTERN_LOCAL_GUIDE_GLSL
#define LANTERN_LOCAL_GUIDE_GLSL

#include "../Shared/LocalLightTypes.h"
#include "../Library/Bindings.glsl"
#include "../Library/Random.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FTileGuideRef { FTileGuide Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FLitPixelRef { FLitPixel Data[]; };

// Returns a light's place in the guide of a tile. Lights that share one differ from tile to tile.
uint GuidePlace(uint Light, uint TileHash) { return HashPcg(Light ^ TileHash) % TILE_GUIDE_LIGHTS; }
uint GuideTileHash(uint TileIndex) { return HashPcg(TileIndex + 0x68bc21ebu); }

// Returns what a tile remembers a light by: for a triangle, its cluster.
uint GuideNumber(FSceneConstants Scene, uint Light)
{
#ifdef LOCAL_EMISSIVE
	if ((Light & LIGHT_TRIANGLE) != 0u) { return FEmissiveRef(Scene.EmissiveTriangles).Data[Light & ~LIGHT_TRIANGLE].Cluster | LIGHT_TRIANGLE; }
#endif
	return Light;
}

uint GuideTraced(uint Counts) { return Counts & 0xffffu; }
uint GuideSeen(uint Counts) { return min(Counts >> 16u, GuideTraced(Counts)); } // memory may hold anything

// Traced, Seen: in units of TILE_GUIDE_RAY.
uint PackGuideCounts(float Traced, float Seen)
{
	const float Most = float(TILE_GUIDE_RAYS * TILE_GUIDE_RAY - 1u);
	float Scale = Traced > Most ? Most / Traced : 1.0;
	return uint(Traced * Scale + 0.5) | (uint(Seen * Scale + 0.5) << 16u);
}

#endif
