// Tells cells and blocks that a light which reaches them has changed, or did reach them. A group for each block.
#version 460
#include "LightReach.glsl"

layout(local_size_x = LIGHT_CELL_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FLightCellConstants Push; };

shared uint Touching[LIGHT_CELL_GROUP_SIZE], TouchingCount;

// Cells that left the grid may come back, and nobody follows what changes around them meanwhile.
void Forget(FLightGrid Grid, uint Index) { FLightCellRef(Grid.Cells).Data[Index].State &= ~LIGHT_CELL_FILLED; }

void main()
{
	FLightGrid Grid = FLightGridRef(Push.Grid).Data;
	FLightReachRef Changes = FLightReachRef(Push.Changes);
	uint Lane = gl_LocalInvocationIndex, Block = LIGHT_CELLS + gl_WorkGroupID.x;
	uint Level, BlockShift;
	ivec3 BlockCorner = FindLightCorner(Grid, Block, Level, BlockShift);
	FLightBox BlockBox = MakeLightBox(Grid, BlockCorner, BlockShift);
	uint CellShift = BlockShift - LIGHT_BLOCK_BITS;
	ivec3 Corner = BlockCorner + (ivec3(uvec3(Lane, Lane >> 2u, Lane >> 4u) & 3u) << CellShift);
	FLightBox Box = MakeLightBox(Grid, Corner, CellShift);
	FLightCellPlace Place = PlaceLightCell(Grid, Level, Corner);
	bool bBlockTouched = false, bTouched = false, bEverywhere = false;
	for (uint First = 0u; First < Push.ChangeCount; First += LIGHT_CELL_GROUP_SIZE)
	{
		if (Lane == 0u) { TouchingCount = 0u; }
		barrier();
		if (First + Lane < Push.ChangeCount)
		{
			FLightReach Change = Changes.Data[First + Lane];
			bEverywhere = bEverywhere || Change.Radius <= 0.0;
			if (Change.Radius > 0.0 && TouchesBox(BlockBox, FromBox(BlockBox, Change.Position), Change.Radius))
			{
				Touching[atomicAdd(TouchingCount, 1u)] = First + Lane;
			}
		}
		barrier();
		bBlockTouched = bBlockTouched || TouchingCount > 0u;
		for (uint I = 0u; I < TouchingCount && !bTouched; ++I)
		{
			FLightReach Change = Changes.Data[Touching[I]];
			bTouched = TouchesBox(Box, FromBox(Box, Change.Position), Change.Radius);
		}
		barrier();
	}
	FLightCellRef Cells = FLightCellRef(Grid.Cells);
	if (bTouched || Cells.Data[Place.Cell].Key != Place.Key) { Forget(Grid, Place.Cell); }
	if (Lane == 0u && (bBlockTouched || Cells.Data[Block].Key != Place.Key)) { Forget(Grid, Block); }
	if (Block == LIGHT_CELLS && bEverywhere) { Forget(Grid, LIGHT_CELL_EVERYWHERE); }
}
