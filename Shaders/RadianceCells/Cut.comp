// Finds how urgent a cell must be to be updated in this frame. One thread, and the counts are zero again behind it.
#version 460
#include "../Library/RadianceCells.glsl"

layout(local_size_x = 1) in;
layout(push_constant, scalar) uniform FPush { FRadianceCellConstants Push; };

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	FRadianceCountersRef Counters = FRadianceCountersRef(Grid.Counters);
	uint Sum = 0u, Cutoff = RADIANCE_CELL_BINS;
	float Share = 0.0;
	for (uint Bin = 0u; Bin < RADIANCE_CELL_BINS; ++Bin)
	{
		uint Count = Counters.Data.Bins[Bin];
		Counters.Data.Bins[Bin] = 0u;
		if (Cutoff == RADIANCE_CELL_BINS && Sum + Count > Grid.Budget)
		{
			Cutoff = Bin;
			Share = float(Grid.Budget - Sum) / float(Count);
		}
		Sum += Count;
	}
	Counters.Data.Listed = 0u;
	Counters.Data.Cutoff = Cutoff;
	Counters.Data.Share = Share;
	Counters.Data.Live = Sum;
}
