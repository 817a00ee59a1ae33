// Asks for the rest of a tile's rays, in this very frame (QueueSun.comp), if a settled pixel that was traced has another answer than was known.
#version 460
#include "../Shared/SettledTypes.h"
#include "../Rays/RayQueue.glsl"
#include "Settle.glsl"
#include "Tile.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FCheckSettledConstants Push; };

shared uint bDisagrees;

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uint Place = gl_LocalInvocationIndex, Word = Place >> 5u, Bit = 1u << (Place & 31u);
	FTileRef Tiles = FTileRef(Push.Tiles);
	uint TileAt = TileIndex(View, gl_WorkGroupID.xy);
	FTile Tile = Tiles.Data[TileAt];
	uint Count = bitCount(Tile.SunRest[0]) + bitCount(Tile.SunRest[1]);
	if (Place == 0u) { bDisagrees = 0u; }
	barrier();
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place);
	uint Index = Pixel.y * View.Width + Pixel.x;
	if (Count > 0u && (Tile.SunRays[Word] & Bit) != 0u)
	{
		uint Answer = FAnswerRef(Push.Answers).Data[Index], Known = LoadKnown(Push.Settled, ivec2(Pixel));
		uint Other = (Known & SETTLED_LIT) != 0u ? SunUnseen(Answer) : SunSeen(Answer);
		if ((Known & (SETTLED_LIT - 1u)) >= SETTLED_FRAMES && Other > 0u) { bDisagrees = 1u; }
	}
	barrier();
	if (Place == 0u) { FTileMarksRef(Push.Marks).Data[TileAt] = bDisagrees != 0u ? uvec2(Tile.SunRest[0], Tile.SunRest[1]) : uvec2(0u); }
	if (bDisagrees == 0u) { return; }
	if (Place == 0u)
	{
		Tiles.Data[TileAt].Classes = Tile.Classes | TILE_SUN_DISAGREES;
		for (uint I = 0u; I < 2u; ++I) { Tiles.Data[TileAt].SunRays[I] = Tile.SunRays[I] | Tile.SunRest[I]; }
	}
	if ((Tile.SunRest[Word] & Bit) == 0u) { return; }
	FAnswerRef(Push.Answers).Data[Index] &= (1u << ANSWER_SUN_SEEN) - 1u; // what was known is void; answers are combined by or
}
