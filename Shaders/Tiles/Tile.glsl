// Where the tiles of a view lie, and the pixels of a tile.
#ifndef LANTERN_TILE_GLSL
#define LANTERN_TILE_GLSL

#include "../Shared/TileTypes.h"
#include "../Library/Bindings.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FTileRef { FTile Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer FTileMarksRef { uvec2 Data[]; };

// The tile of a work group.
#ifndef GROUP_TILE
#define GROUP_TILE gl_WorkGroupID.xy
#endif

uint TileIndex(FViewConstants View, uvec2 Tile) { return Tile.y * ((View.Width + TILE_SIZE - 1u) / TILE_SIZE) + Tile.x; }

// Returns the tile of an index.
uvec2 TileOf(FViewConstants View, uint Index)
{
	uint Columns = (View.Width + TILE_SIZE - 1u) / TILE_SIZE;
	return uvec2(Index % Columns, Index / Columns);
}

// Whether a tile's mask has the bit of the pixel at Place.
bool IsMarked(uint Mask[2], uint Place) { return (Mask[Place >> 5u] & (1u << (Place & 31u))) != 0u; }

// Returns the pixel at Place, 0 to 63, of a tile. Places are in Z order: rays that are traced together then start close to each other.
uvec2 TilePixel(uvec2 Tile, uint Place)
{
	uvec2 P = uvec2(Place, Place >> 1u) & 0x15u;
	P = (P | (P >> 1u)) & 0x33u;
	return Tile * TILE_SIZE + ((P | (P >> 2u)) & 7u);
}

// Returns the Place of a pixel in its tile.
uint TilePlace(uvec2 Pixel)
{
	uvec2 P = Pixel & (TILE_SIZE - 1u);
	P = (P | (P << 2u)) & 0x33u;
	P = (P | (P << 1u)) & 0x55u;
	return P.x | (P.y << 1u);
}

#endif
