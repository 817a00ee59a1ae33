// What the passes over the whole table share: which slot a thread has, and how urgent its cell is.
#include "../Library/RadianceCells.glsl"

#ifndef GROUP_SIZE
#define GROUP_SIZE RADIANCE_CELL_GROUP_SIZE
#endif
layout(local_size_x = GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FRadianceCellConstants Push; };

uint GetThread() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * RADIANCE_CELL_GROUP_SIZE + gl_LocalInvocationIndex; }

uint GetSlotCount(FRadianceGrid Grid) { return (Grid.BucketMask + 1u) * RADIANCE_CELL_BUCKET; }

// Notes of votes: those of this frame's pixels, and of updates of the frame before.
uint CountNotes(FRadianceGrid Grid) { return Grid.VoteCount + RADIANCE_CELL_MOST_UPDATES; }
FAddress GetNote(FRadianceGrid Grid, uint Number)
{
	bool bPixel = Number < Grid.VoteCount;
	return GetVoteNote(bPixel ? Grid.Votes : Grid.UpdateVotes, bPixel ? Number : Number - Grid.VoteCount);
}

// Whether a cell's vote is a claim, of a note that there is.
bool IsClaimed(FRadianceGrid Grid, uint Vote) { return IsVoteClaim(Vote) && NoteOfClaim(Vote) < CountNotes(Grid); }

const uint YoungBins = 6u;   // of coarse cells, and of fine ones that know little
const uint YoungCoarse = 9u; // count, from about 30 updates, up to which a coarse cell, which stands in for many, comes first

const uint Ahead = 8u; // frames by which a cell that is young or changes comes before others that have waited for as long; near ones twice
const float NoiseOfTrend = 0.1; // which a trend has without a change

// Returns the bin of cells that have waited for so many frames.
uint GetBinOfWait(uint Frames)
{
	const uint Longest = RADIANCE_CELL_BINS - 2u - YoungBins;
	return YoungBins + Longest - min(Frames, Longest);
}

// Bins in order of urgency: near cells that know little, then those that have waited longest. The last one is never updated. Cells that updates
// look up ask for more in turn, without an end in an open landscape: they must not keep waiting what pixels look up (NearRank).
uint GetBin(FRadianceGrid Grid, FRadianceCell Cell)
{
	uint State = Cell.State;
	uint Count = RadianceCellCount(State);
	bool bCoarse = (State & RADIANCE_CELL_COARSE) != 0u;
	if (Count > 0u && RadianceTurnsSince(Grid, RadianceCellAsked(State)) > Grid.AskedTurns) { return RADIANCE_CELL_BINS - 1u; }
	// What changes averages over few updates, and has no higher count.
	float Grown = min(float(bCoarse ? YoungCoarse : YoungBins - 1u), Grid.Window);
	bool bNear = UnpackRank(Cell.From) <= NearRank, bYoung = float(Count) < Grown;
	if (bNear && bYoung) { return bCoarse ? 0u : Count + 1u; }
	uint Wait = RadianceTurnsSince(Grid, RadianceCellUpdated(State));
	if (bNear && Wait >= Grid.LeastWait) { Wait += 2u * Ahead; }
	if (bYoung) { Wait += Grid.LeastWait + Ahead; }
	if (Grid.Rounds > 1u && abs(UnpackTrend(Cell.Normal)) > NoiseOfTrend) { Wait += Grid.LeastWait + Ahead; }
	return GetBinOfWait(Wait);
}
