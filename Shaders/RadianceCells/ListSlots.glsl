// Appends slots to the list of a round's updates: one atomic operation for each work group. Included behind RadianceCellSlots.glsl.

shared uint Count, First;

// Turn: another one for each time that a cell is asked for.
bool IsTakenByChance(FRadianceGrid Grid, FRadianceCell Cell, uint Turn, float Share)
{
	return float(HashPcg(RadianceSeed(Grid, Cell) ^ HashPcg(Turn)) >> 8u) * (1.0 / 16777216.0) < Share;
}

// All threads of a work group call it once.
void ListSlot(FRadianceGrid Grid, uint Round, uint Slot, bool bListed)
{
	if (gl_LocalInvocationIndex == 0u) { Count = 0u; }
	barrier();
	uint Number = bListed ? atomicAdd(Count, 1u) : 0u;
	barrier();
	if (gl_LocalInvocationIndex == 0u && Count > 0u) { First = atomicAdd(FRadianceCountersRef(Grid.Counters).Data.Listed[Round], Count); }
	barrier();
	if (bListed && First + Number < Grid.Room) { FRadianceWordRef(Grid.List).Data[PlaceInList(Round, First + Number)] = Slot; }
}
