// Asks for rays of pixels that have asked for none in this frame, where their neighbours cannot tell (r.RT.Lights.Rate).
#version 460
#include "../Shared/SecondRaysTypes.h"
#include "TileRequests.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FSecondRaysConstants Push; };

#include "Neighbors.glsl"

const uint LeastRays = 2u; // of neighbours that are believed

// Whether neighbours leave a doubt about a light. Rays: of theirs, and those that got through. Rays to a light with an extent differ by
// chance. Their mean has no bias then; to ask wherever they differ, and to believe them where they do not, would have one.
bool Doubts(FSceneConstants Scene, uint Light, uvec2 Rays)
{
	if (Rays.x < LeastRays) { return true; }
	return Rays.y != 0u && Rays.y != Rays.x && !HasExtent(FLightRef(Scene.Lights).Data[Light]);
}

// Marks the slots whose rays the pixel wants.
void MarkDoubts(FSceneConstants Scene, FViewConstants View, FTileLights Tile, uint Place)
{
	ivec2 InTile = ivec2(TilePixel(uvec2(0u), Place));
	uint Word = Place >> 5u, Bit = 1u << (Place & 31u), Neighbors = FindNeighbors(View, InTile, false);
	for (uint Slot = 0u; Slot < Tile.Count; ++Slot)
	{
		bool bUnshadowed = (Tile.Lights[Slot] & TILE_LIGHT_UNSHADOWED) != 0u;
		if (bUnshadowed || (Tile.Reached[2u * Slot + Word] & Bit) == 0u) { continue; }
		if (Doubts(Scene, Tile.Lights[Slot], CountNeighborRays(InTile, Neighbors, Slot))) { atomicOr(Asking[2u * Slot + Word], Bit); }
	}
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FTileLights Tile = FTileLightsRef(Push.TileLights).Data[TileIndex(View, gl_WorkGroupID.xy)];
	if (Tile.Count == 0u || Tile.Count == TILE_LIGHTS_MANY) { return; }
	uint Place = gl_LocalInvocationIndex;
	if (Place < 2u * TILE_LIGHTS) { Asking[Place] = 0u; }
	LoadNeighbors(View, Tile, Place);
	barrier();
	if (!HasTurn(View.FrameIndex, Place)) { MarkDoubts(FSceneRef(Push.Pass.Scene).Data, View, Tile, Place); }
	barrier();
	if (Place == 0u) { Reserve(Tile.Count, Push.Counters, Push.Capacity); }
	barrier();
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place);
	WriteRequests(Tile.Count, Tile.Count, Push.Requests, Push.Capacity, Place, Pixel.y * View.Width + Pixel.x);
}
