// Turns requests into arguments of the dispatches that fulfil them, and begins the next turn of requests.
#version 460
#include "LightReach.glsl"

layout(local_size_x = 1) in;
layout(push_constant, scalar) uniform FPush { FLightCellConstants Push; };

uint[3] MakeGroups(uint Count)
{
	return uint[3](min(Count, LIGHT_CELL_ROW_GROUPS), (Count + LIGHT_CELL_ROW_GROUPS - 1u) / LIGHT_CELL_ROW_GROUPS, 1u);
}

void main()
{
	FLightGrid Grid = FLightGridRef(Push.Grid).Data;
	FLightCellCountersRef Counters = FLightCellCountersRef(Grid.Counters);
	FLightCellArgumentsRef Arguments = FLightCellArgumentsRef(Push.Arguments);
	uint Cells = min(Counters.Data.CellRequests, LIGHT_CELLS), Blocks = min(Counters.Data.BlockRequests, LIGHT_CELL_HEADERS - LIGHT_CELLS);
	Arguments.Data.Blocks = MakeGroups(Blocks);
	Arguments.Data.BlockCount = Blocks;
	Arguments.Data.Cells = MakeGroups(Cells);
	Arguments.Data.CellCount = Cells;
	// A grid that begins anew has reserved nothing.
	bool bNew = Counters.Data.Revision != Grid.Revision;
	Counters.Data = FLightCellCounters(Grid.Revision, bNew ? 0u : Counters.Data.PoolNext, 0u, 0u, 0u, Cells + Blocks, 0u, 0u);
}
