// Tells cells and blocks that a light which reaches them has changed, or did reach them. A thread for each block.
#version 460
#include "LightReach.glsl"

layout(local_size_x = LIGHT_CELL_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FLightCellConstants Push; };

void Forget(FLightGrid Grid, uint Index) { FLightCellRef(Grid.Cells).Data[Index].State &= ~LIGHT_CELL_FILLED; }

// Returns the lowest corner of cell Place, 0 to 63, of a block.
ivec3 CellCorner(ivec3 BlockCorner, uint CellShift, uint Place)
{
	return BlockCorner + (ivec3(uvec3(Place, Place >> 2u, Place >> 4u) & 3u) << CellShift);
}

void main()
{
	if (gl_GlobalInvocationID.x >= LIGHT_BLOCKS) { return; }
	FLightGrid Grid = FLightGridRef(Push.Grid).Data;
	FLightReachRef Changes = FLightReachRef(Push.Changes);
	uint Block = LIGHT_CELLS + gl_GlobalInvocationID.x, Level, BlockShift;
	ivec3 Corner = FindLightCorner(Grid, Block, Level, BlockShift);
	FLightBox BlockBox = MakeLightBox(Grid, Corner, BlockShift);
	uint CellShift = BlockShift - LIGHT_BLOCK_BITS, Touched[2] = uint[2](0u, 0u); // a bit for each cell
	bool bBlockTouched = false, bEverywhere = false;
	[[dont_unroll]] for (uint First = 0u; First < Push.ChangeCount; First += 32u)
	{
		uint Touching = 0u;
		[[dont_unroll]] for (uint I = First; I < min(First + 32u, Push.ChangeCount); ++I)
		{
			FLightReach Change = Changes.Data[I];
			bEverywhere = bEverywhere || Change.Radius <= 0.0;
			bool bTouches = Change.Radius > 0.0 && TouchesBox(BlockBox, FromBox(BlockBox, Change.Position), Change.Radius);
			Touching |= bTouches ? 1u << (I - First) : 0u;
		}
		bBlockTouched = bBlockTouched || Touching != 0u;
		[[dont_unroll]] for (; Touching != 0u; Touching &= Touching - 1u)
		{
			FLightReach Change = Changes.Data[First + uint(findLSB(Touching))];
			[[dont_unroll]] for (uint Place = 0u; Place < 64u; ++Place)
			{
				FLightBox Box = MakeLightBox(Grid, CellCorner(Corner, CellShift, Place), CellShift);
				if (TouchesBox(Box, FromBox(Box, Change.Position), Change.Radius)) { Touched[Place >> 5u] |= 1u << (Place & 31u); }
			}
		}
	}
	// Cells that left the grid may come back, and nobody follows what changes around them meanwhile.
	FLightCellRef Cells = FLightCellRef(Grid.Cells);
	[[dont_unroll]] for (uint Place = 0u; Place < 64u; ++Place)
	{
		FLightCellPlace Cell = PlaceLightCell(Grid, Level, CellCorner(Corner, CellShift, Place));
		bool bTouched = (Touched[Place >> 5u] & (1u << (Place & 31u))) != 0u;
		if (bTouched || Cells.Data[Cell.Cell].Key != Cell.Key) { Forget(Grid, Cell.Cell); }
	}
	if (bBlockTouched || Cells.Data[Block].Key != PlaceLightCell(Grid, Level, Corner).Key) { Forget(Grid, Block); }
	if (Block == LIGHT_CELLS && bEverywhere) { Forget(Grid, LIGHT_CELL_EVERYWHERE); }
}
