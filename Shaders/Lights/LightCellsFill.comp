// Makes the lists of lights that were asked for. A group for each list; each thread tests a run of lights, so that the list is in the
// order of slots whatever the order of threads.
// BLOCKS: lists of blocks, and of lights that reach everywhere, from all lights. Not defined: lists of cells, from their block's.
#version 460
#include "LightReach.glsl"

layout(local_size_x = LIGHT_CELL_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FLightCellConstants Push; };

shared uint Counts[LIGHT_CELL_GROUP_SIZE], FirstEntry;

// What a list is made of.
struct FSource
{
	bool bEverywhere;
	FAddress Slots; // 0: all
	uint First, Count;
	FLightBox Box;
};

bool Belongs(FSceneConstants Scene, FSource Source, uint Number, out uint Slot)
{
	Slot = Source.Slots == FAddress(0) ? Number : FLightCellWordRef(Source.Slots).Data[Source.First + Number];
	if (Slot >= Scene.LightCount) { return false; }
	FLightData Light = FLightRef(Scene.Lights).Data[Slot];
	if (LightType(Light) == LIGHT_NONE) { return false; }
	if (ReachesEverywhere(Light) || Source.bEverywhere) { return ReachesEverywhere(Light) && Source.bEverywhere; }
	return ReachesBox(Light, Source.Box);
}

// Reserves room for Count entries, unless the list has it. Returns the state of the list; its entries begin at FirstEntry.
uint Reserve(FLightGrid Grid, FLightCell Old, uint Count)
{
	bool bOld = Old.Revision == Grid.Revision;
	uint Room = bOld ? (Old.State >> LIGHT_CELL_ROOM_SHIFT) & LIGHT_CELL_ROOM_MASK : LIGHT_CELL_NO_ROOM;
	FirstEntry = bOld ? Old.First : 0u;
	if (Count > 0u && (Room == LIGHT_CELL_NO_ROOM || (1u << Room) < Count))
	{
		uint Wanted = max(uint(findMSB(Count - 1u) + 1), 2u); // log2, at least 4 entries
		FLightCellCountersRef Counters = FLightCellCountersRef(Grid.Counters);
		uint First = atomicAdd(Counters.Data.PoolNext, 1u << Wanted);
		if (First + (1u << Wanted) > Grid.PoolEntries)
		{
			atomicAdd(Counters.Data.PoolNext, 0u - (1u << Wanted));
			atomicAdd(Counters.Data.Missing, 1u << Wanted);
			return LIGHT_CELL_FILLED | LIGHT_CELL_OVERFLOW | (Room << LIGHT_CELL_ROOM_SHIFT) | Count;
		}
		Room = Wanted;
		FirstEntry = First;
	}
	return LIGHT_CELL_FILLED | (Room << LIGHT_CELL_ROOM_SHIFT) | Count;
}

// Fills list Index of FLightCell[].
void Fill(FLightGrid Grid, FSceneConstants Scene, FSource Source, uint Index, uint Key, uint Most)
{
	uint Lane = gl_LocalInvocationIndex, PerLane = (Source.Count + LIGHT_CELL_GROUP_SIZE - 1u) / LIGHT_CELL_GROUP_SIZE, Slot;
	uint Begin = min(Lane * PerLane, Source.Count), End = min(Begin + PerLane, Source.Count), Mine = 0u;
	for (uint Number = Begin; Number < End; ++Number) { Mine += Belongs(Scene, Source, Number, Slot) ? 1u : 0u; }
	Counts[Lane] = Mine;
	barrier();
	uint Before = 0u, Total = 0u;
	for (uint Other = 0u; Other < LIGHT_CELL_GROUP_SIZE; ++Other)
	{
		Before += Other < Lane ? Counts[Other] : 0u;
		Total += Counts[Other];
	}
	barrier();
	FLightCellRef Cells = FLightCellRef(Grid.Cells);
	if (Lane == 0u)
	{
		FLightCell Old = Cells.Data[Index];
		uint State = Reserve(Grid, Old, Total > Most ? 0u : Total);
		if (Total > Most) { State |= LIGHT_CELL_OVERFLOW | Total; }
		Cells.Data[Index] = FLightCell(FirstEntry, State, Key, Grid.Revision);
		Counts[0] = State;
	}
	barrier();
	if ((Counts[0] & LIGHT_CELL_OVERFLOW) != 0u) { return; }
	FLightCellWordRef Pool = FLightCellWordRef(Grid.Pool);
	uint Entry = FirstEntry + Before;
	for (uint Number = Begin; Number < End; ++Number)
	{
		if (Belongs(Scene, Source, Number, Slot)) { Pool.Data[Entry++] = Slot; }
	}
}

void main()
{
	FLightGrid Grid = FLightGridRef(Push.Grid).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FLightCellArguments Arguments = FLightCellArgumentsRef(Push.Arguments).Data;
	uint Number = gl_WorkGroupID.y * LIGHT_CELL_ROW_GROUPS + gl_WorkGroupID.x;
#ifdef BLOCKS
	if (Number >= Arguments.BlockCount) { return; }
	uint Index = FLightCellWordRef(Grid.Requests).Data[LIGHT_CELLS + Number];
	if (Index < LIGHT_CELLS || Index >= LIGHT_CELL_HEADERS) { return; } // requests may have been overwritten: r.RT.Debug.PoisonHistory
	FSource Source = FSource(Index == LIGHT_CELL_EVERYWHERE, FAddress(0), 0u, Scene.LightCount, FLightBox(ivec3(0), 0.0, 0.0));
	if (Source.bEverywhere)
	{
		Fill(Grid, Scene, Source, Index, 0u, LIGHT_CELL_COUNT_MASK);
		return;
	}
	uint Most = LIGHT_CELL_COUNT_MASK;
#else
	if (Number >= Arguments.CellCount) { return; }
	uint Index = FLightCellWordRef(Grid.Requests).Data[Number];
	if (Index >= LIGHT_CELLS) { return; }
	FSource Source = FSource(false, Grid.Pool, 0u, 0u, FLightBox(ivec3(0), 0.0, 0.0));
	uint Most = LIGHT_CELL_MOST;
#endif
	uint Level, EdgeShift;
	ivec3 Corner = FindLightCorner(Grid, Index, Level, EdgeShift);
	FLightCellPlace Place = PlaceLightCell(Grid, Level, Corner);
	Source.Box = MakeLightBox(Grid, Corner, EdgeShift);
#ifndef BLOCKS
	FLightCell Block = FLightCellRef(Grid.Cells).Data[Place.Block];
	if (!IsLightCellFilled(Grid, Block, Place.Key)) { return; } // asked for by a ray, and changed since
	if (!HasLightCellList(Grid, Block, Place.Key)) { Source.Slots = FAddress(0); }
	Source.First = Block.First;
	Source.Count = Source.Slots == FAddress(0) ? Scene.LightCount : Block.State & LIGHT_CELL_COUNT_MASK;
#endif
	Fill(Grid, Scene, Source, Index, Place.Key, Most);
}
