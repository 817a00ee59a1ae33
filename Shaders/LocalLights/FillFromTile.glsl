// Light of pixels of a tile of many lights that have chosen none in this frame: the mean of neighbours that have.
#ifndef LANTERN_FILL_FROM_TILE_GLSL
#define LANTERN_FILL_FROM_TILE_GLSL

#include "LocalPoint.glsl"
#include "../Library/Planes.glsl"

shared uint OfferedLobes[TILE_PIXELS][3];

// All threads. Lobes: of the pixel, over their albedos.
// bFilled: gets whether they are of others.
FLobes FillFromTile(FViewConstants View, FTileLights Tile, uint Place, FLobes Lobes, out bool bFilled)
{
	OfferedLobes[Place] = PackLobes(Lobes);
	barrier();
	uint Chose = Tile.Chose[Place >> 5u];
	bFilled = (Chose & (1u << (Place & 31u))) == 0u;
	if (!bFilled) { return Lobes; }
	ivec2 InTile = ivec2(TilePixel(uvec2(0u), Place));
	uint Neighbors = FindNeighbors(View, InTile, true);
	FLobes Sum = FLobes(vec3(0.0), vec3(0.0));
	for (uint I = 0u; I < 9u; ++I)
	{
		if ((Neighbors & (1u << I)) == 0u) { continue; }
		FLobes Its = UnpackLobes(OfferedLobes[TilePlace(uvec2(InTile + ivec2(I % 3u, I / 3u) - 1))]);
		Sum.Diffuse += Its.Diffuse;
		Sum.Specular += Its.Specular;
	}
	float Share = 1.0 / float(max(bitCount(Neighbors), 1));
	return FLobes(Sum.Diffuse * Share, Sum.Specular * Share);
}

#endif
