// Marks the cells that this frame updates, and Order.comp lists them. Where the budget ends, chance decides and never the place in the table.
#version 460
#include "RadianceCellSlots.glsl"
#include "ListSlots.glsl"

bool IsListed(FRadianceGrid Grid, uint Slot)
{
	if (Slot >= GetSlotCount(Grid)) { return false; }
	if (FRadianceWordRef(Grid.Keys).Data[Slot] == 0u) { return false; }
	FRadianceCountersRef Counters = FRadianceCountersRef(Grid.Counters);
	uint Cutoff = Counters.Data.Cutoff;
	FRadianceCell Cell = FRadianceCellRef(Grid.Cells).Data[Slot];
	uint Bin = GetBin(Grid, Cell);
	if (Bin != Cutoff) { return Bin < Cutoff; }
	return IsTakenByChance(Grid, Cell, Grid.Turn, Counters.Data.Share);
}

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	uint Slot = GetThread();
	MarkSlot(Grid, IsListed(Grid, Slot));
}
