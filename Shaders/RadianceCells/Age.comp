// Frees cells that nobody has asked for, and counts the others by urgency. Those that a look-up has claimed get its place. New ones are found
// from here on.
#version 460
#include "RadianceCellSlots.glsl"

shared uint Bins[RADIANCE_CELL_BINS];

void TakePlace(FRadianceGrid Grid, uint Slot, inout FRadianceCell Cell)
{
	FRadianceVote Vote = FRadianceVoteRef(GetNote(Grid, NoteOfClaim(Cell.Vote))).Data[0];
	Cell.Place = Vote.Place;
	Cell.GeometricNormal = Vote.GeometricNormal | (Cell.GeometricNormal & ~NormalMask);
	Cell.Normal = Vote.Normal | (Cell.Normal & ~NormalMask);
	Cell.From = PackRank(RankOfVote(Vote.Vote)) | (Cell.From & MeanDirectionMask);
	FRadianceCellRef Cells = FRadianceCellRef(Grid.Cells);
	Cells.Data[Slot].Place = Cell.Place;
	Cells.Data[Slot].GeometricNormal = Cell.GeometricNormal;
	Cells.Data[Slot].Normal = Cell.Normal;
	Cells.Data[Slot].From = Cell.From;
}

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
			if (IsClaimed(Grid, Cell.Vote)) { TakePlace(Grid, Slot, Cell); }
			atomicAdd(Bins[GetBin(Grid, Cell)], 1u);
		}
	}
	barrier();
	if (Lane < RADIANCE_CELL_BINS && Bins[Lane] > 0u)
	{
		atomicAdd(FRadianceCountersRef(Grid.Counters).Data.Bins[Lane], Bins[Lane]);
	}
}
