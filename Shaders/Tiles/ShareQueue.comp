// Writes the queue anew if not all rays had room: each tile then keeps an equal share of its rays. Which requests had found room depended
// on the order of tiles; what is kept here does not.
#version 460
#include "../Shared/TileTypes.h"
#include "../Rays/RayQueue.glsl"
#include "Tile.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FTilesConstants Push; };

void main()
{
	FRayQueueCountersRef Counters = FRayQueueCountersRef(Push.Counters);
	uint Wanted = Counters.Data.Segments[RAY_SEGMENT_SUN].Wanted;
	if (Wanted <= Push.Capacity) { return; }
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uint Columns = TileIndex(View, uvec2(0u, 1u)), Rows = (View.Height + TILE_SIZE - 1u) / TILE_SIZE;
	uint Index = gl_WorkGroupID.x * TILE_PIXELS + gl_LocalInvocationIndex;
	if (Index >= Columns * Rows) { return; }
	FTile Tile = FTileRef(Push.Tiles).Data[Index];
	uint Rays[2] = Tile.SunRays;
	if (Push.bSunRest != 0u)
	{
		if ((Tile.Classes & TILE_SUN_DISAGREES) == 0u) { return; }
		Rays = Tile.SunRest;
	}
	uint Count = bitCount(Rays[0]) + bitCount(Rays[1]);
	uint Kept = ShareRoom(Count, Push.Capacity, Wanted);
	if (Kept == 0u) { return; }
	uint Number = atomicAdd(Counters.Data.Segments[RAY_SEGMENT_SUN].Kept, Kept);
	uint Turn = View.FrameIndex * Kept; // other pixels in each frame
	[[dont_unroll]] for (uint Place = 0u; Place < TILE_PIXELS; ++Place)
	{
		if ((Rays[Place >> 5u] & (1u << (Place & 31u))) == 0u) { continue; }
		if (Turn++ % Count >= Kept) { continue; }
		uvec2 Pixel = TilePixel(TileOf(View, Index), Place);
		FRayRequestRef(Push.Requests).Data[Number++] = MakeRayRequest(RAY_KIND_SUN, 0u, Pixel.y * View.Width + Pixel.x);
	}
}
