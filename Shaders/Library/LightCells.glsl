// Which lights may matter at a point: the look-up in the grid of light cells.
//
//   FLightWalk Walk = WalkLights(Scene, P, false);
//   for (uint I = NextLight(Walk); I < Scene.LightCount; I = NextLight(Walk)) { … Lights.Data[I] … }
//
// A walk visits every light that reaches P, each once, in the order of slots. It may visit others.
#ifndef LANTERN_LIGHT_CELLS_GLSL
#define LANTERN_LIGHT_CELLS_GLSL

#include "../Shared/LightCellTypes.h"
#include "Bindings.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FLightGridRef { FLightGrid Data; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FLightCellRef { FLightCell Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FLightCellCountersRef { FLightCellCounters Data; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FLightCellWordRef { uint Data[]; };

const uint NoLight = 0xffffffffu;

// A cell of the world: where its list and that of its block lie, and the key that both must have.
struct FLightCellPlace
{
	uint Cell, Block, Key; // the first two: into FLightCell[]; NoLight: the point lies outside of the grid
};

// Corner: a cell's corner of lowest coordinates, in steps, or any point in it.
FLightCellPlace PlaceLightCell(FLightGrid Grid, uint Level, ivec3 Corner)
{
	uvec3 C = uvec3(Corner) >> (Grid.Shift + Level);
	uvec3 Bits = uvec3(LIGHT_CELL_BITS_X, LIGHT_CELL_BITS_Y, LIGHT_CELL_BITS_Z);
	uvec3 Place = C & ((uvec3(1u) << Bits) - 1u), Around = C >> Bits, Block = Place >> LIGHT_BLOCK_BITS;
	FLightCellPlace Out;
	Out.Cell = Level * LIGHT_CELLS_PER_LEVEL + (Place.x | (Place.y << Bits.x) | (Place.z << (Bits.x + Bits.y)));
	uint InLevel = Block.x | (Block.y << (Bits.x - LIGHT_BLOCK_BITS)) | (Block.z << (Bits.x + Bits.y - 2 * LIGHT_BLOCK_BITS));
	Out.Block = LIGHT_CELLS + Level * LIGHT_BLOCKS_PER_LEVEL + InLevel;
	Out.Key = (Around.x & 0x7ffu) | ((Around.y & 0x3ffu) << 11u) | (Around.z << 21u);
	return Out;
}

// Returns the finest cell that holds P, relative to the scene's origin. Jitter: metres, added to P.
FLightCellPlace FindLightCell(FLightGrid Grid, vec3 P, vec3 Jitter)
{
	FLightCellPlace None = FLightCellPlace(NoLight, NoLight, 0u);
	vec3 Steps = floor((P + Jitter) * LIGHT_POSITION_STEPS);
	if (!all(lessThan(abs(Steps), vec3(2.0e9)))) { return None; } // also of what is no number
	ivec3 Position = Grid.Origin + ivec3(Steps);
	const uvec3 Cells = uvec3(1u << LIGHT_CELL_BITS_X, 1u << LIGHT_CELL_BITS_Y, 1u << LIGHT_CELL_BITS_Z);
	for (uint Level = 0u; Level < LIGHT_CELL_LEVELS; ++Level)
	{
		uvec3 FromFirst = uvec3(Position - Grid.First[Level]) >> (Grid.Shift + Level);
		if (all(lessThan(FromFirst, Cells))) { return PlaceLightCell(Grid, Level, Position); }
	}
	return None;
}

bool IsLightCellFilled(FLightGrid Grid, FLightCell Cell, uint Key)
{
	return Cell.Revision == Grid.Revision && Cell.Key == Key && (Cell.State & LIGHT_CELL_FILLED) != 0u;
}

bool HasLightCellList(FLightGrid Grid, FLightCell Cell, uint Key)
{
	return IsLightCellFilled(Grid, Cell, Key) && (Cell.State & LIGHT_CELL_OVERFLOW) == 0u;
}

void RequestLightList(FLightGrid Grid, uint Index, uint Turn)
{
	FLightCellWordRef Stamps = FLightCellWordRef(Grid.Stamps);
	if (Stamps.Data[Index] == Turn || atomicExchange(Stamps.Data[Index], Turn) == Turn) { return; }
	FLightCellCountersRef Counters = FLightCellCountersRef(Grid.Counters);
	bool bCell = Index < LIGHT_CELLS;
	uint Number = bCell ? atomicAdd(Counters.Data.CellRequests, 1u) : atomicAdd(Counters.Data.BlockRequests, 1u);
	if (Number < (bCell ? LIGHT_CELLS : LIGHT_CELL_HEADERS - LIGHT_CELLS))
	{
		FLightCellWordRef(Grid.Requests).Data[Number + (bCell ? 0u : LIGHT_CELLS)] = Index;
	}
}

// Asks for what a look-up at Place lacks. Cell: at Place.Cell.
void RequestLightCell(FLightGrid Grid, FLightCellPlace Place, FLightCell Cell, uint Turn)
{
	FLightCellRef Cells = FLightCellRef(Grid.Cells);
	if (!IsLightCellFilled(Grid, Cells.Data[LIGHT_CELL_EVERYWHERE], 0u)) { RequestLightList(Grid, LIGHT_CELL_EVERYWHERE, Turn); }
	if (IsLightCellFilled(Grid, Cell, Place.Key)) { return; }
	RequestLightList(Grid, Place.Cell, Turn);
	if (!IsLightCellFilled(Grid, Cells.Data[Place.Block], Place.Key)) { RequestLightList(Grid, Place.Block, Turn); }
}

// Two ascending lists of slots, which are visited as one.
struct FLightWalk
{
	FAddress Pool; // 0: all lights are visited
	uint Next, End;
	uint EverywhereNext, EverywhereEnd;
	uint Near, Everywhere; // slots at Next and EverywhereNext
};

FLightWalk WalkAllLights(FSceneConstants Scene) { return FLightWalk(FAddress(0), 0u, Scene.LightCount, 0u, 0u, 0u, 0u); }

uint LoadListedLight(FAddress Pool, uint Entry, uint End) { return Entry < End ? FLightCellWordRef(Pool).Data[Entry] : NoLight; }

// Where a cell's list has no room or is not filled, its block's serves. Where that has none either, all lights are visited.
// bRequest: asks for the cell if it is not filled. Later: 0 before the frame makes its lists, so that this frame has it; 1 behind.
FLightWalk WalkLightsOfTurn(FSceneConstants Scene, vec3 P, bool bRequest, uint Later)
{
	if (Scene.LightCells == FAddress(0)) { return WalkAllLights(Scene); }
	FLightGrid Grid = FLightGridRef(Scene.LightCells).Data;
	FLightCellPlace Place = FindLightCell(Grid, P, vec3(0.0));
	if (Place.Cell == NoLight) { return WalkAllLights(Scene); }
	FLightCellRef Cells = FLightCellRef(Grid.Cells);
	FLightCell Everywhere = Cells.Data[LIGHT_CELL_EVERYWHERE], Cell = Cells.Data[Place.Cell];
	if (bRequest) { RequestLightCell(Grid, Place, Cell, Grid.Turn + Later); }
	if (!HasLightCellList(Grid, Everywhere, 0u)) { return WalkAllLights(Scene); }
	if (!HasLightCellList(Grid, Cell, Place.Key))
	{
		Cell = Cells.Data[Place.Block];
		if (!HasLightCellList(Grid, Cell, Place.Key)) { return WalkAllLights(Scene); }
	}
	FLightWalk Walk;
	Walk.Pool = Grid.Pool;
	Walk.Next = Cell.First;
	Walk.End = Cell.First + (Cell.State & LIGHT_CELL_COUNT_MASK);
	Walk.EverywhereNext = Everywhere.First;
	Walk.EverywhereEnd = Everywhere.First + (Everywhere.State & LIGHT_CELL_COUNT_MASK);
	Walk.Near = LoadListedLight(Walk.Pool, Walk.Next, Walk.End);
	Walk.Everywhere = LoadListedLight(Walk.Pool, Walk.EverywhereNext, Walk.EverywhereEnd);
	return Walk;
}

// bRequest: asks for the cell if it is not filled, so that the next frame has it.
FLightWalk WalkLights(FSceneConstants Scene, vec3 P, bool bRequest) { return WalkLightsOfTurn(Scene, P, bRequest, 1u); }

// Returns the next light's slot; NoLight: there is none.
uint NextLight(inout FLightWalk Walk)
{
	if (Walk.Pool == FAddress(0)) { return Walk.Next < Walk.End ? Walk.Next++ : NoLight; }
	uint Slot = min(Walk.Near, Walk.Everywhere);
	if (Walk.Near <= Walk.Everywhere) { Walk.Near = LoadListedLight(Walk.Pool, ++Walk.Next, Walk.End); }
	else { Walk.Everywhere = LoadListedLight(Walk.Pool, ++Walk.EverywhereNext, Walk.EverywhereEnd); }
	return Slot;
}

#endif
