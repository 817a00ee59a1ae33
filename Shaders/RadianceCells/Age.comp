// Frees cells that nobody has asked for, and counts the others by urgency. New ones are found from here on.
#version 460
#include "RadianceCellSlots.glsl"

shared uint Bins[RADIANCE_CELL_BINS];

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	uint Lane = gl_LocalInvocationIndex, Slot = GetThread();
	if (Lane < RADIANCE_CELL_BINS) { Bins[Lane] = 0u; }
	barrier();
	FRadianceWordRef Keys = FRadianceWordRef(Grid.Keys);
	if (Slot < GetSlotCount(Grid) && Keys.Data[Slot] != 0u)
	{
		FRadianceCellRef Cells = FRadianceCellRef(Grid.Cells);
		FRadianceCell Cell = Cells.Data[Slot];
		uint Key = Keys.Data[Slot];
		bool bNew = Key < SettledKey;
		Cells.Data[Slot].Vote = 0u;
		// Without a vote, a new cell has no place.
		bool bUnused = bNew ? Cell.Vote == 0u : RadianceTurnsSince(Grid, RadianceCellAsked(Cell.State)) > Grid.Life;
		if (Key == LostKey || bUnused)
		{
			Keys.Data[Slot] = 0u;
			Cells.Data[Slot].State = 0u;
			Cells.Data[Slot].Light = 0u;
			Cells.Data[Slot].From = 0u;
			Cells.Data[Slot].GeometricNormal = 0u;
			Cells.Data[Slot].Normal = 0u;
		}
		else
		{
			if (bNew) { Keys.Data[Slot] = Key | SettledKey; }
			atomicAdd(Bins[GetBin(Grid, Cell)], 1u);
		}
	}
	barrier();
	if (Lane < RADIANCE_CELL_BINS && Bins[Lane] > 0u)
	{
		atomicAdd(FRadianceCountersRef(Grid.Counters).Data.Bins[Lane], Bins[Lane]);
	}
}
