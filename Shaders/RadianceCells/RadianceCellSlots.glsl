// What the passes over the whole table share: which slot a thread has, and how urgent its cell is.
#include "../Library/RadianceCells.glsl"

#ifndef GROUP_SIZE
#define GROUP_SIZE RADIANCE_CELL_GROUP_SIZE
#endif
layout(local_size_x = GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FRadianceCellConstants Push; };

uint GetThread() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * RADIANCE_CELL_GROUP_SIZE + gl_LocalInvocationIndex; }

uint GetSlotCount(FRadianceGrid Grid) { return (Grid.BucketMask + 1u) * RADIANCE_CELL_BUCKET; }

const uint YoungBins = 6u;    // of coarse cells, and of fine ones that know little
const uint YoungCoarse = 9u; // count, from about 30 updates, up to which a coarse cell, which stands in for many, comes first

const uint LivelyAhead = 8u;      // frames by which a cell whose light changes comes before those that have waited for as long
const float NoiseOfTrend = 0.1;   // which a trend has without a change

// Returns the bin of cells that have waited for so many frames.
uint GetBinOfWait(uint Frames)
{
	const uint Longest = RADIANCE_CELL_BINS - 2u - YoungBins;
	return YoungBins + Longest - min(Frames, Longest);
}

// Bins in order of urgency: cells that know little, then those that have waited longest. The last one is never updated.
uint GetBin(FRadianceGrid Grid, FRadianceCell Cell)
{
	uint State = Cell.State;
	uint Count = RadianceCellCount(State);
	bool bCoarse = (State & RADIANCE_CELL_COARSE) != 0u;
	if (Count > 0u && RadianceTurnsSince(Grid, RadianceCellAsked(State)) > Grid.AskedTurns) { return RADIANCE_CELL_BINS - 1u; }
	if (bCoarse && Count < YoungCoarse) { return 0u; }
	if (Count + 1u < YoungBins) { return Count + 1u; }
	bool bLively = Grid.Rounds > 1u && abs(UnpackTrend(Cell.Normal)) > NoiseOfTrend;
	return GetBinOfWait(RadianceTurnsSince(Grid, RadianceCellUpdated(State)) + (bLively ? Grid.LeastWait + LivelyAhead : 0u));
}
