// Pixels of listed tiles choose lights, and queue their rays. Requests.comp has marked the tiles, and says what is defined. Apart from it,
// because few tiles need it, and it takes many registers.
#version 460
uvec2 ListedTile;
#define GROUP_TILE ListedTile
#include "../Tiles/Tile.glsl"
#include "TileRequests.glsl"
#include "TileBox.glsl"
#include "../Rays/ThreadList.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FLocalRequestsConstants Push; };

shared FTileLights Tile;

#include "TileTable.glsl"
#ifdef LOCAL_EMISSIVE
#include "EmitterSearch.glsl"
#endif
#include "ChooseOfMany.glsl"

// Whether the work group has a tile.
bool FindListedTile(FViewConstants View)
{
	uint Index;
	if (!FindThread(Push.Answers, gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x, Index)) { return false; }
	ListedTile = TileOf(View, Index);
	return true;
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	if (!FindListedTile(View)) { return; }
	uint Place = gl_LocalInvocationIndex, Index = TileIndex(View, ListedTile);
	uvec2 Pixel = TilePixel(ListedTile, Place);
	float Depth = IsOutsideView(View, Pixel) ? 0.0 : LoadDepth(Push.Depth, ivec2(Pixel));
	bool bSurface = Depth > 0.0;
	FLocalPoint Point;
	StartBox(Place);
	if (Place == 0u)
	{
		Tile = FTileLightsRef(Push.TileLights).Data[Index];
#ifdef LOCAL_EMISSIVE
		EmitterCount = 0u;
#endif
	}
	barrier();
	if (bSurface)
	{
		Point = LoadLocalPoint(Scene, View, Push.Normals, Push.Channels, Pixel, Depth);
		GrowBox(Point.P);
	}
	barrier();
#ifdef LOCAL_EMISSIVE
	if (!ChoosesOfLights(Tile)) { CountEmitters(Scene, View, Place); }
#endif
	ChooseOfMany(Scene, View, Point, bSurface, Pixel, Place);
	barrier();
	uint Count = CountChosen(Tile);
	if (Place < 2u * Count) { Asking[Place] = Tile.Asking[Place]; }
	barrier();
	if (Place == 0u)
	{
		Reserve(Count, Push.Counters, Push.Capacity);
		FTileLightsRef(Push.TileLights).Data[Index] = Tile;
	}
	barrier();
	WriteRequests(Count, 0u, Push.Requests, Push.Capacity, Place, Pixel.y * View.Width + Pixel.x);
}
