// Finds how urgent a cell must be to be updated in this frame. One thread, and the counts are zero again behind it.
#version 460
#define GROUP_SIZE 1
#include "RadianceCellSlots.glsl"

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	FRadianceCountersRef Counters = FRadianceCountersRef(Grid.Counters);
	// What knows its light, and has not waited for long, waits on.
	uint Sum = 0u, Young = 0u, End = GetBinOfWait(Grid.LeastWait) + 1u, Cutoff = End;
	float Share = 0.0;
	for (uint Bin = 0u; Bin < RADIANCE_CELL_BINS; ++Bin)
	{
		uint Count = Counters.Data.Bins[Bin];
		Counters.Data.Bins[Bin] = 0u;
		if (Cutoff == End && Bin < End && Sum + Count > Grid.Budget)
		{
			Cutoff = Bin;
			Share = float(Grid.Budget - Sum) / float(Count);
		}
		Sum += Count;
		Young += Bin < YoungBins ? Count : 0u;
	}
	uint Further = 0u, Wanted = 0u;
	for (uint Round = 1u; Round < RADIANCE_CELL_MOST_ROUNDS; ++Round)
	{
		Wanted += Counters.Data.Lively[Round - 1u];
		Further += CountListed(Grid, Round);
	}
	Counters.Data.Further = Wanted > 0u ? min(float(Further) / float(Wanted), 1.0) : 1.0;
	for (uint Round = 0u; Round < RADIANCE_CELL_MOST_ROUNDS; ++Round) { Counters.Data.Listed[Round] = Counters.Data.Lively[Round] = 0u; }
	Counters.Data.Cutoff = Cutoff;
	Counters.Data.Share = Share;
	if (Grid.Statistics == FAddress(0)) { return; }
	FRadianceStatisticsRef Statistics = FRadianceStatisticsRef(Grid.Statistics);
	Statistics.Data.Live = Sum;
	Statistics.Data.Young = Young;
}
