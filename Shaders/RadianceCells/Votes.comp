// Gives each cell the place of the look-up that won its vote. Look-ups that are further from the camera than the one that a cell has its place
// from must be lucky. What overlaps, as floors do that run on under walls, has parts that only rays within it reach. Its light is not that of
// the rest of their cells, and these rays look up cells as often as others.
#version 460
#include "RadianceCellSlots.glsl"

const uint FurtherVotes = 64u; // of which one counts: what has nearer ones no longer follows the others

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	uint Number = GetThread();
	if (Number >= CountNotes(Grid)) { return; }
	FRadianceVote Vote = FRadianceVoteRef(GetNote(Grid, Number)).Data[0];
	if (Vote.Vote == 0u || Vote.Slot >= GetSlotCount(Grid)) { return; } // a table begins with zeroes
	FRadianceCellRef Cells = FRadianceCellRef(Grid.Cells);
	FRadianceCell Cell = Cells.Data[Vote.Slot];
	if (Cell.Vote != Vote.Vote) { return; }
	uint Rank = RankOfVote(Vote.Vote);
	bool bLucky = (Vote.Vote & (FurtherVotes - 1u)) == 0u;
	if (RadianceCellCount(Cell.State) > 0u && Rank > UnpackRank(Cell.From) && !bLucky) { return; }
	Cells.Data[Vote.Slot].Place = Vote.Place;
	Cells.Data[Vote.Slot].GeometricNormal = Vote.GeometricNormal | (Cell.GeometricNormal & ~NormalMask);
	Cells.Data[Vote.Slot].Normal = Vote.Normal | (Cell.Normal & ~NormalMask);
	Cells.Data[Vote.Slot].From = PackRank(Rank) | (Cell.From & MeanDirectionMask);
}
