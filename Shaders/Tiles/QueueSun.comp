// Queues rays that are marked, in the order of tiles. In another order, a driver may meet another of several blockers first, and the filter
// hears how far away it is.
#version 460
#include "../Shared/TileTypes.h"
#include "../Library/OrderBits.glsl"
#include "../Rays/RayQueue.glsl"
#include "Tile.glsl"

layout(local_size_x = THREAD_ORDER_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FSunQueueConstants Push; };

// Of two tiles.
uvec4 LoadBits(uint Index)
{
	uvec4 Bits = FBitsRef(Push.Marks).Data[Index];
	return 2u * Index + 1u < Push.TileCount ? Bits : uvec4(Bits.xy, 0u, 0u);
}

void ListBit(uint Place, uint Bit)
{
	if (Place >= Push.Capacity) { return; }
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uint Tile = Bit / TILE_PIXELS, InTile = Bit % TILE_PIXELS, Slot = 0u;
	if (Push.Tiles != FAddress(0) && IsMarked(FTileRef(Push.Tiles).Data[Tile].SunLit, InTile)) { Slot = RAY_SLOT_SUN_LIT; }
	uvec2 Pixel = TilePixel(TileOf(View, Tile), InTile);
	FRayRequestRef(Push.Requests).Data[Place] = MakeRayRequest(RAY_KIND_SUN, Slot, Pixel.y * View.Width + Pixel.x);
}

void main()
{
	FRayQueueCountersRef Counters = FRayQueueCountersRef(Push.Counters);
	if (Push.Rays == SUN_QUEUE_KEPT && Counters.Data.Segments[RAY_SEGMENT_SUN].Wanted <= Push.Capacity) { return; }
	uint Count = (Push.TileCount + 1u) / 2u, Sum = OrderBits(Count, gl_WorkGroupID.x);
	if (!HasWholeCount(Count, gl_WorkGroupID.x)) { return; }
	if (Push.Rays == SUN_QUEUE_KEPT)
	{
		Counters.Data.Segments[RAY_SEGMENT_SUN].Kept = Sum;
		return;
	}
	Counters.Data.Segments[RAY_SEGMENT_SUN].Wanted = Push.Rays == SUN_QUEUE_ALL ? Sum : min(Sum, Push.Capacity);
	GrowLaunch(Push.Counters, min(Sum, Push.Capacity) * Push.Samples);
}
