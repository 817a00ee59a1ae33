// The planes that the pixels of a tile and of a ring around it show: whether what one pixel sees of a light may stand for another.
#ifndef LANTERN_PLANES_GLSL
#define LANTERN_PLANES_GLSL

#include "GBuffer.glsl"
#include "../Tiles/Tile.glsl"
#include "Rate.glsl"

const int RingSize = TILE_SIZE + 2; // of the tile with a ring around it

shared vec3 RingPoints[RingSize * RingSize]; // relative to the camera
shared uint RingNormals[RingSize * RingSize]; // octahedral, 2 × snorm16; NoRingNormal: no surface

const uint NoRingNormal = 0x80008000u; // which packing never gives

uint RingPlace(ivec2 InTile) { return uint((InTile.y + 1) * RingSize + InTile.x + 1); }

// Normal: geometric.
void SetPlane(uint RingPlace, bool bSurface, vec3 Relative, vec3 Normal)
{
	RingPoints[RingPlace] = Relative;
	RingNormals[RingPlace] = bSurface ? PackOct(Normal) : NoRingNormal;
}

// Sets the planes of all pixels of the ring. A barrier must follow. Depth, Normals: sampled indices.
void LoadPlanes(FViewConstants View, uint Depths, uint Normals)
{
	ivec2 First = ivec2(gl_WorkGroupID.xy) * TILE_SIZE - 1;
	for (uint I = gl_LocalInvocationIndex; I < uint(RingSize * RingSize); I += TILE_PIXELS)
	{
		ivec2 Pixel = First + ivec2(I % RingSize, I / RingSize);
		bool bInside = all(greaterThanEqual(Pixel, ivec2(0))) && !IsOutsideView(View, uvec2(Pixel));
		float Depth = bInside ? LoadDepth(Depths, Pixel) : 0.0;
		SetPlane(I, false, vec3(0.0), vec3(0.0));
		if (Depth <= 0.0) { continue; }
		FGBufferPoint Point = LoadGBufferPoint(View, Normals, Pixel, Depth);
		SetPlane(I, true, Point.Relative, Point.Ng);
	}
}

// Whether two pixels next to each other show one plane, or a surface that is nearly one.
bool SharePlane(FViewConstants View, uint A, uint B)
{
	if (RingNormals[A] == NoRingNormal || RingNormals[B] == NoRingNormal) { return false; }
	vec3 Normal = UnpackOct(RingNormals[A]), To = RingPoints[B] - RingPoints[A];
	if (dot(Normal, UnpackOct(RingNormals[B])) < 0.9) { return false; }
	return abs(dot(Normal, To)) <= 0.1 * length(To) + 0.25 * PixelHeight(View, length(RingPoints[A]));
}

// Returns which of the 3×3 pixels around one have their turn in this frame and show its plane: a bit for each. bOwnTile: those beyond the
// tile do not count.
uint FindNeighbors(FViewConstants View, ivec2 InTile, bool bOwnTile)
{
	uint Found = 0u;
	for (uint I = 0u; I < 9u; ++I)
	{
		ivec2 At = InTile + ivec2(I % 3u, I / 3u) - 1, Inside = At & (TILE_SIZE - 1);
		if (I == 4u || (bOwnTile && any(notEqual(At, Inside)))) { continue; }
		if (!HasTurn(View.FrameIndex, TilePlace(uvec2(Inside)))) { continue; } // turns are the same in all tiles
		if (SharePlane(View, RingPlace(InTile), RingPlace(At))) { Found |= 1u << I; }
	}
	return Found;
}

#endif
