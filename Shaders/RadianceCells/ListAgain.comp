// Marks the cells for another round of this frame: those whose light changes, as long as the frame's budget lasts. Light then goes several
// surfaces further in a frame, and not one.
#version 460
#include "RadianceCellSlots.glsl"
#include "ListSlots.glsl"

// Round: the one to list for.
float GetShare(FRadianceGrid Grid, uint Round)
{
	uint Spent = 0u, Lively = FRadianceCountersRef(Grid.Counters).Data.Lively[Round - 1u];
	for (uint I = 0u; I < Round; ++I) { Spent += CountListed(Grid, I); }
	return Spent < Grid.Budget ? float(Grid.Budget - Spent) / float(max(Lively, 1u)) : 0.0;
}

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	uint Number = GetThread();
	bool bListed = false;
	if (Number < CountListed(Grid, Push.Round - 1u))
	{
		uint Entry = FRadianceWordRef(Grid.List).Data[PlaceInList(Push.Round - 1u, Number)];
		FRadianceCell Cell = FRadianceCellRef(Grid.Cells).Data[Entry & ~LivelySlot];
		uint Turn = Grid.Turn | (Push.Round << 12u);
		bListed = (Entry & LivelySlot) != 0u && IsTakenByChance(Grid, Cell, Turn, GetShare(Grid, Push.Round));
	}
	MarkSlot(Grid, bListed);
}
