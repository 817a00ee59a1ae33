// The grid of light cells: which lights matter where in the world. Structures that C++ and GLSL share.
#ifndef LANTERN_LIGHT_CELL_TYPES_H
#define LANTERN_LIGHT_CELL_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

// Levels of 32 × 16 × 32 cells. Cells of a level are twice as large as those of the level before.
#define LIGHT_CELL_LEVELS 6
#define LIGHT_CELL_BITS_X 5
#define LIGHT_CELL_BITS_Y 4
#define LIGHT_CELL_BITS_Z 5
#define LIGHT_CELLS_PER_LEVEL 16384
#define LIGHT_CELLS (LIGHT_CELL_LEVELS * LIGHT_CELLS_PER_LEVEL)
// Blocks of 4 × 4 × 4 cells gather from all lights, and cells from their block.
#define LIGHT_BLOCK_BITS 2
#define LIGHT_BLOCKS_PER_LEVEL 256
#define LIGHT_BLOCKS (LIGHT_CELL_LEVELS * LIGHT_BLOCKS_PER_LEVEL)
// FLightCell[]: cells, blocks, and one that holds the lights that reach everywhere.
#define LIGHT_CELL_EVERYWHERE (LIGHT_CELLS + LIGHT_BLOCKS)
#define LIGHT_CELL_HEADERS (LIGHT_CELL_EVERYWHERE + 1)
#define LIGHT_CELL_MOST 64 // lights in the list of a cell; lists of blocks have no limit but their memory
#define LIGHT_CELL_OFFSET 2743 // steps to the grid's own origin: floors at whole metres would lie on borders, and rounding scatter them
#define LIGHT_CELL_GROUP_SIZE 64
#define LIGHT_CELL_ROW_GROUPS 1024 // of a dispatch: devices may have no more than 65,535 in x
#define LIGHT_CELL_MARK_SIZE 8     // threads in x and y

// FLightCell::State. Below: number of lights that reach the cell, of which the list has all or none.
#define LIGHT_CELL_COUNT_MASK 0x01ffffffu
#define LIGHT_CELL_ROOM_SHIFT 25      // log2 of the entries that are reserved
#define LIGHT_CELL_ROOM_MASK 31u
#define LIGHT_CELL_NO_ROOM 31u
#define LIGHT_CELL_OVERFLOW 0x40000000u // the list had no room
#define LIGHT_CELL_FILLED 0x80000000u   // no light that reaches the cell has changed since

// A list of lights. Its entries are slots of lights, in their order.
struct FLightCell
{
	uint First;    // entry in the pool
	uint State;    // LIGHT_CELL_…
	uint Key;      // which cell of the world it is, of those that share this place
	uint Revision; // FLightGrid::Revision when it was made; another one: it is empty, and nothing is reserved
};
LANTERN_ASSERT_SIZE(FLightCell, 16);

struct FLightCellCounters
{
	uint Revision;        // that PoolNext belongs to
	uint PoolNext;        // entries of the pool that are reserved
	uint Missing;         // entries that found no room in this frame
	uint CellRequests;    // since the last frame prepared its lists
	uint BlockRequests;
	uint Filled;          // cells and blocks that this frame fills
	uint Pad0, Pad1;
};
LANTERN_ASSERT_SIZE(FLightCellCounters, 32);

// Arguments of the dispatches that fill lists.
struct FLightCellArguments
{
	uint Blocks[3];
	uint BlockCount;
	uint Cells[3];
	uint CellCount;
};
LANTERN_ASSERT_SIZE(FLightCellArguments, 32);

// Where the influence of a light begins or ends to reach.
struct FLightReach
{
	ivec3 Position; // see FLightData
	float Radius;   // metres; 0: it reaches everywhere
};
LANTERN_ASSERT_SIZE(FLightReach, 16);

// The grid of a view in this frame.
struct FLightGrid
{
	FAddress Cells;    // FLightCell[LIGHT_CELL_HEADERS]
	FAddress Pool;     // uint[PoolEntries]: slots of lights
	FAddress Counters; // FLightCellCounters
	FAddress Stamps;   // uint[LIGHT_CELL_HEADERS]: Turn in which a list was last asked for
	FAddress Requests; // uint[LIGHT_CELL_HEADERS]: cells that are asked for, and from LIGHT_CELLS on blocks
	uint PoolEntries;
	uint Revision; // no earlier grid has had it
	uint Turn;     // of requests that this frame fulfils; later ones of this frame are of the next turn
	uint Shift;    // log2 of the steps of a finest cell (LIGHT_POSITION_STEPS)
	ivec3 Origin;  // of the scene, steps from the grid's own origin; so is First
	ivec3 First[LIGHT_CELL_LEVELS]; // lowest corner of each level, steps; levels begin with a block
};
LANTERN_ASSERT_SIZE(FLightGrid, 144);

struct FLightCellConstants
{
	FPassConstants Pass;
	FAddress Grid;      // FLightGrid
	FAddress Changes;   // FLightReach[ChangeCount]: where lights were and are that changed
	FAddress Arguments; // FLightCellArguments
	uint ChangeCount;
	uint Depth;  // sampled index
	uint Output; // storage index
	uint Pad;
};
LANTERN_ASSERT_SIZE(FLightCellConstants, 56);

LANTERN_SHARED_END

#endif
