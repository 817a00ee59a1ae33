// Counts the votes for cells that are new: their slots are known when all keys have been added.
#version 460
#include "RadianceCellSlots.glsl"

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	uint Number = GetThread();
	if (Number >= CountNotes(Grid)) { return; }
	FRadianceVoteRef Note = FRadianceVoteRef(GetNote(Grid, Number));
	uint Named = Note.Data[0].Slot, Name = Named & ~NEW_RADIANCE_CELL;
	uint Vote = Note.Data[0].Vote;
	if (Named < NEW_RADIANCE_CELL || !IsKeyName(Name) || Vote == 0u || IsVoteClaim(Vote)) { return; } // also notes that nobody has written
	uint Slot = FindNewKey(Grid, MakeNamedKey(Grid, Note.Data[0].Place, Name));
	Note.Data[0].Slot = Slot;
	if (Slot == NO_RADIANCE_CELL)
	{
		if (Grid.Statistics != FAddress(0)) { atomicAdd(FRadianceStatisticsRef(Grid.Statistics).Data.Full, 1u); }
		return;
	}
	AskRadianceCell(Grid, Slot, (Name & NameCoarse) != 0u);
	atomicMax(FRadianceCellRef(Grid.Cells).Data[Slot].Vote, Vote);
}
