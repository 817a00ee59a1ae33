// Requests of a tile's pixels for rays to its lights: room for all of them is reserved at once.
// REQUEST_THREADS: threads that trace a request; not defined: one.
#ifndef LANTERN_TILE_REQUESTS_GLSL
#define LANTERN_TILE_REQUESTS_GLSL

#include "../Rays/RayQueue.glsl"
#include "LocalPoint.glsl"

#ifndef REQUEST_THREADS
#define REQUEST_THREADS 1u
#endif

// Returns the pixels that ask for a ray in a slot, 32 of them. The slots behind the others are for what pixels chose.
uint AskingPixels(FTileLights Tile, uint Slot, uint Word, uint FrameIndex)
{
	uint Slots = CountSlots(Tile);
	if (Slot >= Slots) { return Tile.Asking[2u * (Slot - Slots) + Word]; }
	bool bUnshadowed = (Tile.Lights[Slot] & TILE_LIGHT_UNSHADOWED) != 0u;
	return bUnshadowed ? 0u : Tile.Reached[2u * Slot + Word] & TurnMask(FrameIndex);
}

// ChosenSlot: the first of what pixels chose.
FRayRequest MakeSlotRequest(uint Slot, uint ChosenSlot, uint PixelIndex)
{
	if (Slot >= ChosenSlot) { return MakeRayRequest(RAY_KIND_CHOSEN, Slot - ChosenSlot, PixelIndex); }
	return MakeRayRequest(RAY_KIND_LOCAL, Slot, PixelIndex);
}

shared uint Asking[2u * (TILE_LIGHTS + TILE_CHOSEN_MOST)]; // two words for each slot: pixels that ask, in Z order
shared uint FirstRequest;

// Reserves room for all rays of Asking[]. One thread.
void Reserve(uint Slots, FAddress CountersAddress, uint Capacity)
{
	uint Count = 0u;
	for (uint I = 0u; I < 2u * Slots; ++I) { Count += bitCount(Asking[I]); }
	if (Count == 0u) { return; }
	FRayQueueCountersRef Counters = FRayQueueCountersRef(CountersAddress);
	FirstRequest = SegmentEnd(Counters.Data, RAY_SEGMENT_LOCAL - 1u, Capacity);
	FirstRequest += atomicAdd(Counters.Data.Segments[RAY_SEGMENT_LOCAL].Wanted, Count);
	GrowLaunch(CountersAddress, min(FirstRequest + Count, Capacity) * REQUEST_THREADS);
}

// Writes the pixel's requests, light by light: rays to one light then start close to each other. ChosenSlot: see AskingPixels; one that
// is no slot if pixels chose nothing.
void WriteRequests(uint Slots, uint ChosenSlot, FAddress Requests, uint Capacity, uint Place, uint PixelIndex)
{
	uint First = FirstRequest;
	for (uint I = 0u; I < Slots; ++I)
	{
		uint Low = Asking[2u * I], High = Asking[2u * I + 1u];
		uint Mine = Place < 32u ? Low : High, Bit = 1u << (Place & 31u);
		uint Number = First + bitCount(Mine & (Bit - 1u)) + (Place < 32u ? 0u : bitCount(Low));
		if ((Mine & Bit) != 0u && Number < Capacity) { FRayRequestRef(Requests).Data[Number] = MakeSlotRequest(I, ChosenSlot, PixelIndex); }
		First += bitCount(Low) + bitCount(High);
	}
}

#endif
