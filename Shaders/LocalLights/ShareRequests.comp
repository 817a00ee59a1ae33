// Writes the requests of local lights anew if not all had room: each tile then keeps an equal share, as in ShareQueue.comp.
#version 460
#include "../Rays/RayQueue.glsl"
#include "../Tiles/Tile.glsl"
#include "LocalPoint.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FLocalRequestsConstants Push; };

// Returns the pixels that ask for a ray in a slot, 32 of them. The slot behind the others is for what pixels chose.
uint AskingPixels(FTileLights Tile, uint Slots, uint Slot, uint Word)
{
	if (Slot == Slots) { return Tile.Asking[Word]; }
	return (Tile.Lights[Slot] & TILE_LIGHT_UNSHADOWED) != 0u ? 0u : Tile.Reached[2u * Slot + Word];
}

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
	uint Slots = Tile.Count == TILE_LIGHTS_MANY ? 0u : Tile.Count, Count = 0u;
	for (uint I = 0u; I < 2u * Slots + 2u; ++I) { Count += bitCount(AskingPixels(Tile, Slots, I >> 1u, I & 1u)); }
	uint Kept = ShareRoom(Count, Room, Wanted);
	if (Kept == 0u) { return; }
	uint Number = Base + atomicAdd(Counters.Data.Segments[RAY_SEGMENT_LOCAL].Kept, Kept);
	uint Turn = View.FrameIndex * Kept; // other rays in each frame
	[[dont_unroll]] for (uint I = 0u; I < 2u * Slots + 2u; ++I)
	{
		uint Asking = AskingPixels(Tile, Slots, I >> 1u, I & 1u);
		bool bChosen = (I >> 1u) == Slots;
		[[dont_unroll]] while (Asking != 0u)
		{
			uint Bit = uint(findLSB(Asking));
			Asking &= Asking - 1u;
			if (Turn++ % Count >= Kept) { continue; }
			uvec2 Pixel = TilePixel(uvec2(Index % Columns, Index / Columns), 32u * (I & 1u) + Bit);
			uint PixelIndex = Pixel.y * View.Width + Pixel.x;
			FRayRequestRef(Push.Requests).Data[Number++] = MakeRayRequest(bChosen ? RAY_KIND_CHOSEN : RAY_KIND_LOCAL, bChosen ? 0u : I >> 1u, PixelIndex);
		}
	}
}
