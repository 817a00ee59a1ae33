// What the rays of a tile's pixels say of the lights in its slots. The includer's Push has what Neighbors.glsl needs, if SPARSE.
#ifndef LANTERN_SLOT_ANSWERS_GLSL
#define LANTERN_SLOT_ANSWERS_GLSL

#include "../Rays/RayQueue.glsl"
#include "LocalPoint.glsl"
#ifdef SPARSE
#include "Neighbors.glsl"
#endif

// Rays of the tile by slot: where some had no room in the queue, their pixels take the mean of the others.
const uint ChosenSlot = TILE_LIGHTS;
shared uint Seen[TILE_LIGHTS + 1u], Traced[TILE_LIGHTS + 1u];

// Returns the visibility of a slot's light. Neighbors: their rays to it, and those that got through.
float SlotVisibility(uint Answer, uint Slot, uint SeenBit, uint TracedBit, uvec2 Neighbors)
{
	if ((Answer & (1u << TracedBit)) != 0u) { return (Answer & (1u << SeenBit)) != 0u ? 1.0 : 0.0; }
	if (Neighbors.x > 0u) { return float(Neighbors.y) / float(Neighbors.x); }
	return Traced[Slot] > 0u ? float(Seen[Slot]) / float(Traced[Slot]) : 1.0;
}

void CountAnswer(uint Answer, uint Slot, uint SeenBit, uint TracedBit)
{
	atomicAdd(Traced[Slot], (Answer >> TracedBit) & 1u);
	atomicAdd(Seen[Slot], (Answer >> SeenBit) & 1u);
}

// Counts the tile's answers. All threads, with a barrier behind it.
void CountAnswers(FTileLights Tile, FViewConstants View, uint Answer, uint Place)
{
	if (Place <= TILE_LIGHTS) { Seen[Place] = Traced[Place] = 0u; }
	barrier();
	uint Chosen = HaveChosen(Tile) ? CountChosen(Tile) : 0u;
	for (uint I = 0u; I < Chosen; ++I) { CountAnswer(Answer, ChosenSlot, ChosenSeenBit(I), ChosenTracedBit(I)); }
	uint Slots = CountSlots(Tile);
	for (uint I = 0u; I < Slots; ++I) { CountAnswer(Answer, I, ANSWER_LOCAL_SEEN + I, ANSWER_LOCAL_TRACED + I); }
#ifdef SPARSE
	if (Tile.Count != 0u) { LoadNeighbors(View, Tile, Place); }
#endif
}

#endif
