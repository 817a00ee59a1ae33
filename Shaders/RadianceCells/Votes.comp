// Gives each cell the place of the look-up that won its vote: those of this frame's pixels, and of updates of the frame before.
#version 460
#include "RadianceCellSlots.glsl"

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	uint Thread = GetThread();
	if (Thread >= Grid.VoteCount + RADIANCE_CELL_MOST_UPDATES) { return; }
	bool bPixel = Thread < Grid.VoteCount;
	FRadianceVoteRef Votes = FRadianceVoteRef(bPixel ? Grid.Votes : Grid.UpdateVotes);
	FRadianceVote Vote = Votes.Data[bPixel ? Thread : Thread - Grid.VoteCount];
	if (Vote.Vote == 0u || Vote.Slot >= GetSlotCount(Grid)) { return; } // a table begins with zeroes
	FRadianceCellRef Cells = FRadianceCellRef(Grid.Cells);
	if (Cells.Data[Vote.Slot].Vote != Vote.Vote) { return; }
	Cells.Data[Vote.Slot].Place = Vote.Place;
	Cells.Data[Vote.Slot].GeometricNormal = Vote.GeometricNormal | (Cells.Data[Vote.Slot].GeometricNormal & ~NormalMask);
	Cells.Data[Vote.Slot].Normal = Vote.Normal | (Cells.Data[Vote.Slot].Normal & ~NormalMask);
}
