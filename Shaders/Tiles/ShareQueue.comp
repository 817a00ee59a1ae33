// Unmarks rays without room in a queue, where not all have it: each tile keeps an equal share of its own. The first tiles would have all room.
#version 460
#include "../Shared/TileTypes.h"
#include "../Rays/RayQueue.glsl"
#include "Tile.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FSunQueueConstants Push; };

void main()
{
	uint Index = gl_WorkGroupID.x * TILE_PIXELS + gl_LocalInvocationIndex;
	uint Wanted = FRayQueueCountersRef(Push.Counters).Data.Segments[RAY_SEGMENT_SUN].Wanted;
	if (Wanted <= Push.Capacity || Index >= Push.TileCount) { return; }
	uvec2 Rays = FTileMarksRef(Push.Marks).Data[Index], Left = uvec2(0u);
	uint Count = bitCount(Rays.x) + bitCount(Rays.y), Kept = ShareRoom(Count, Push.Capacity, Wanted);
	uint Turn = FViewRef(Push.Pass.View).Data.FrameIndex * Kept; // other pixels in each frame
	[[dont_unroll]] for (uint Place = 0u; Place < TILE_PIXELS && Kept > 0u; ++Place)
	{
		uint Word = Place >> 5u, Bit = 1u << (Place & 31u);
		if ((Rays[Word] & Bit) != 0u && Turn++ % Count < Kept) { Left[Word] |= Bit; }
	}
	FTileMarksRef(Push.Marks).Data[Index] = Left;
}
