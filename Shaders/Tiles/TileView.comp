// Draws the sun's tiles for r.RT.Debug.View: their classes, or the rays of each pixel.
#version 460
#include "../Shared/SettledTypes.h"
#include "../Library/View.glsl"
#include "Tile.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FTileViewConstants Push; };

vec3 ClassColor(FTile Tile)
{
	if ((Tile.Classes & TILE_SUN_DISAGREES) != 0u) { return vec3(1.0, 0.85, 0.1); }
	if ((Tile.Classes & TILE_SUN_TRACED) != 0u)
	{
		// The more pixels are known, the greener.
		vec3 Known = (Tile.Classes & TILE_SUN_LIT) != 0u ? vec3(0.4, 0.85, 0.4) : vec3(0.05, 0.3, 0.1);
		return mix(vec3(0.85, 0.2, 0.15), Known, float(bitCount(Tile.SunRest[0]) + bitCount(Tile.SunRest[1])) / 48.0);
	}
	return (Tile.Classes & TILE_SUN_BEHIND) != 0u ? vec3(0.1) : vec3(0.1, 0.15, 0.35);
}

// White: traced. Yellow: traced because a neighbour disagreed. Black: not traced.
vec3 RayColor(FTile Tile, uint Place)
{
	if (!IsMarked(Tile.SunRays, Place)) { return vec3(0.0); }
	return IsMarked(Tile.SunRest, Place) ? vec3(1.0, 0.85, 0.1) : vec3(1.0);
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uint Place = gl_LocalInvocationIndex;
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place);
	if (IsOutsideView(View, Pixel)) { return; }
	FTile Tile = FTileRef(Push.Tiles).Data[TileIndex(View, gl_WorkGroupID.xy)];
	vec3 Color = Push.bRays != 0u ? RayColor(Tile, Place) : ClassColor(Tile);
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(Color, 1.0));
}
