// Lights froxels by pairs of slices: a thread has two of one column, and one of them has its turn. The includer has Push, with Grid and Counts as in
// FFogShadowConstants, and
//   void BeginPair(FViewConstants View, ivec2 Column, uint Pair)   what comes before the thread's froxels
//   void LightFroxel(FSceneConstants Scene, FViewConstants View, ivec3 Froxel, uint Count, float End, bool bTurn)
//     Count: of slices that are lit. End: see PlaceInFroxel.
#ifndef LANTERN_FROXEL_PAIRS_GLSL
#define LANTERN_FROXEL_PAIRS_GLSL

// Place: as the texels of an atlas of pairs of slices.
void LightPair(uvec2 Place)
{
	uvec2 Size = uvec2(Push.Grid.Columns, Push.Grid.Rows), Tile = Place / Size;
	uint Pair = Tile.y * Push.Grid.PerRow + Tile.x;
	if (Tile.x >= Push.Grid.PerRow || 2u * Pair >= Push.Grid.Slices) { return; }
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Column = ivec2(Place % Size);
	vec2 Counts = texelFetch(Textures[Push.Counts], Column, 0).xy;
	uint Turn = uint(Counts.x) & 1u, Count = uint(Counts.x) >> 1u;
	BeginPair(View, Column, Pair);
	[[dont_unroll]] for (uint I = 0u; I < 2u; ++I)
	{
		ivec3 Froxel = ivec3(Column, 2u * Pair + I);
		if (uint(Froxel.z) < Push.Grid.Slices) { LightFroxel(Scene, View, Froxel, Count, Counts.y, I == Turn); }
	}
}

#endif
