// Gives each cell the place of the look-up that won its vote.
#version 460
#include "RadianceCellSlots.glsl"

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	uint Number = GetThread();
	if (Number >= CountNotes(Grid)) { return; }
	FRadianceVote Vote = FRadianceVoteRef(GetNote(Grid, Number)).Data[0];
	if (Vote.Vote == 0u || Vote.Slot >= GetSlotCount(Grid)) { return; } // a table begins with zeroes
	FRadianceCellRef Cells = FRadianceCellRef(Grid.Cells);
	if (Cells.Data[Vote.Slot].Vote != Vote.Vote) { return; }
	Cells.Data[Vote.Slot].Place = Vote.Place;
	Cells.Data[Vote.Slot].GeometricNormal = Vote.GeometricNormal | (Cells.Data[Vote.Slot].GeometricNormal & ~NormalMask);
	Cells.Data[Vote.Slot].Normal = Vote.Normal | (Cells.Data[Vote.Slot].Normal & ~NormalMask);
}
