// Writes the requests of local lights anew if not all had room: each tile then keeps an equal share, as in ShareQueue.comp.
#version 460
#include "../Tiles/Tile.glsl"
#include "TileRequests.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FLocalRequestsConstants Push; };

void main()
{
	FRayQueueCountersRef Counters = FRayQueueCountersRef(Push.Counters);
	uint Base = SegmentEnd(Counters.Data, RAY_SEGMENT_LOCAL - 1u, Push.Capacity), Room = Push.Capacity - Base;
	uint Wanted = Counters.Data.Segments[RAY_SEGMENT_LOCAL].Wanted;
	if (Wanted <= Room) { return; }
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uint Columns = TileIndex(View, uvec2(0u, 1u)), Rows = (View.Height + TILE_SIZE - 1u) / TILE_SIZE;
	uint Index = gl_WorkGroupID.x * TILE_PIXELS + gl_LocalInvocationIndex;
	if (Index >= Columns * Rows) { return; }
	FTileLights Tile = FTileLightsRef(Push.TileLights).Data[Index];
	uint Slots = CountSlots(Tile), All = Slots + TILE_CHOSEN_MOST, Count = 0u;
	for (uint I = 0u; I < 2u * All; ++I) { Count += bitCount(AskingPixels(Tile, I >> 1u, I & 1u, View.FrameIndex)); }
	uint Kept = ShareRoom(Count, Room, Wanted);
	if (Kept == 0u) { return; }
	uint Number = Base + atomicAdd(Counters.Data.Segments[RAY_SEGMENT_LOCAL].Kept, Kept);
	uint Turn = View.FrameIndex * Kept; // other rays in each frame
	[[dont_unroll]] for (uint I = 0u; I < 2u * All; ++I)
	{
		uint Pixels = AskingPixels(Tile, I >> 1u, I & 1u, View.FrameIndex);
		[[dont_unroll]] while (Pixels != 0u)
		{
			uint Bit = uint(findLSB(Pixels));
			Pixels &= Pixels - 1u;
			if (Turn++ % Count >= Kept) { continue; }
			uvec2 Pixel = TilePixel(TileOf(View, Index), 32u * (I & 1u) + Bit);
			uint PixelIndex = Pixel.y * View.Width + Pixel.x;
			FRayRequestRef(Push.Requests).Data[Number++] = MakeSlotRequest(I >> 1u, Slots, PixelIndex);
		}
	}
}
