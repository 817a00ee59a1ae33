// Finds the look-up that won the vote of each cell, whose place Age.comp gives to the cell. Look-ups that are further from the camera than the one
// that a cell has its place from must be lucky. What overlaps, as floors do that run on under walls, has parts that only rays within it reach.
// Its light is not that of the rest of their cells, and these rays look up cells as often as others.
#version 460
#include "RadianceCellSlots.glsl"
#include "../Library/MovedShare.glsl"

const uint FurtherVotes = 64u; // of which one counts: what has nearer ones no longer follows the others

// Whether something has moved around a place, so that the cell's own place may now lie in the air or in an object.
bool IsInMover(FRadianceGrid Grid, vec3 P)
{
	for (uint I = 0u; I < Grid.MoverCount; ++I)
	{
		FMovedCaster Mover = FMovedCasterRef(Grid.Movers).Data[I];
		if (Mover.bCasts != 0u && distance(NearestOnWay(Mover, P), P) <= Mover.Radius) { return true; }
	}
	return false;
}

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	uint Number = GetThread();
	if (Number >= CountNotes(Grid)) { return; }
	FRadianceVote Vote = FRadianceVoteRef(GetNote(Grid, Number)).Data[0];
	if (Vote.Vote == 0u || Vote.Slot >= GetSlotCount(Grid)) { return; } // a table begins with zeroes
	FRadianceCellRef Cells = FRadianceCellRef(Grid.Cells);
	FRadianceCell Cell = Cells.Data[Vote.Slot];
	uint Greatest = IsClaimed(Grid, Cell.Vote) ? FRadianceVoteRef(GetNote(Grid, NoteOfClaim(Cell.Vote))).Data[0].Vote : Cell.Vote;
	if (Greatest != Vote.Vote) { return; }
	uint Rank = RankOfVote(Vote.Vote);
	bool bLucky = (Vote.Vote & (FurtherVotes - 1u)) == 0u;
	if (RadianceCellCount(Cell.State) > 0u && Rank > UnpackRank(Cell.From) && !bLucky &&
	    !IsInMover(Grid, FromRadianceSteps(Grid, Vote.Place))) { return; }
	atomicMax(Cells.Data[Vote.Slot].Vote, MakeVoteClaim(Number));
}
