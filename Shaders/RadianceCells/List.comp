// Lists the cells that this frame updates. Where the budget ends, chance decides and never the place in the table.
#version 460
#include "RadianceCellSlots.glsl"

shared uint Count, First;

bool IsListed(FRadianceGrid Grid, uint Slot)
{
	if (Slot >= GetSlotCount(Grid)) { return false; }
	if (FRadianceWordRef(Grid.Keys).Data[Slot] == 0u) { return false; }
	FRadianceCountersRef Counters = FRadianceCountersRef(Grid.Counters);
	uint Cutoff = Counters.Data.Cutoff;
	FRadianceCell Cell = FRadianceCellRef(Grid.Cells).Data[Slot];
	uint Bin = GetBin(Grid, Cell.State);
	if (Bin != Cutoff) { return Bin < Cutoff; }
	return float(HashPcg(RadianceSeed(Grid, Cell) ^ HashPcg(Grid.Turn)) >> 8u) * (1.0 / 16777216.0) < Counters.Data.Share;
}

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	uint Slot = GetThread();
	if (gl_LocalInvocationIndex == 0u) { Count = 0u; }
	barrier();
	bool bListed = IsListed(Grid, Slot);
	uint Number = bListed ? atomicAdd(Count, 1u) : 0u;
	barrier();
	if (gl_LocalInvocationIndex == 0u && Count > 0u) { First = atomicAdd(FRadianceCountersRef(Grid.Counters).Data.Listed, Count); }
	barrier();
	if (bListed && First + Number < Grid.Room) { FRadianceWordRef(Grid.List).Data[First + Number] = Slot; }
}
