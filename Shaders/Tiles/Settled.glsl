// Which pixels need few sun rays, because they and those around them have been all lit or all dark for a while, and nothing says that this
// has changed.
// Tiles.comp includes this with ADAPTIVE.
#ifndef LANTERN_SETTLED_GLSL
#define LANTERN_SETTLED_GLSL

#include "../Shared/SettledTypes.h"
#include "../Library/GroupBounds.glsl"
#include "Tile.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FSettledRef { FSettledConstants Data; };

// What a pixel that asks for rays has known before; 0: it asks for none.
const uint KnownLit = 1u, KnownDark = 2u, NotSettled = 4u;

shared uint Knowledge[TILE_PIXELS]; // row by row
shared uint bTouched;

uint LoadSettled(uint Texture, ivec2 Pixel) { return uint(texelFetch(Textures[Texture], Pixel, 0).x * 255.0 + 0.5); }
uint SettledFrames(uint Settled) { return Settled & (SETTLED_LIT - 1u); }

uint Classify(uint Settled)
{
	if (SettledFrames(Settled) < SETTLED_FRAMES) { return NotSettled; }
	return (Settled & SETTLED_LIT) != 0u ? KnownLit : KnownDark;
}

// What is known of a pixel: the texel that carries on the history of its surface. OutClass: KnownLit, KnownDark or anything else. Also notes
// the distance for the tile.
uint Recall(FViewConstants View, FSettledConstants Settled, uvec2 Pixel, out uint OutClass)
{
	FSurface Surface = LoadSurface(Settled.Surface, ivec2(Pixel));
	NoteDistance(Surface.Distance);
	OutClass = NotSettled;
	uint Carried = 0u;
	if (Settled.Previous != NO_TEXTURE)
	{
		vec4 Motion = texelFetch(Textures[Settled.Motion], ivec2(Pixel), 0);
		FReprojection R = LoadReprojection(Settled.Reprojection, ivec2(Pixel));
		float Best = 0.01; // a texel of less weight is there by rounding
		uint Classes = 0u;
		for (int Tap = 0; Tap < 4; ++Tap)
		{
			if (R.Weights[Tap] < 0.01) { continue; }
			uint Texel = LoadSettled(Settled.Previous, GetTap(R, Tap));
			Classes |= Classify(Texel);
			if (R.Weights[Tap] < Best) { continue; }
			Best = R.Weights[Tap];
			Carried = Texel;
		}
		if (Classes != 0u && !MovedItself(View, Surface.Distance, Pixel, Motion)) { OutClass = Classes; }
	}
	return Carried;
}

// Finds whether a moved caster's shadow may touch the tile; the work group shares the casters.
void FindMovedCasters(FViewConstants View, FSettledConstants Settled, uvec2 Tile)
{
	if (Settled.CasterCount == 0u || !HasBounds()) { return; }
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	vec4 Bound = BoundGroup(View, Tile * TILE_SIZE, TILE_SIZE);
	FCasterList List = FCasterList(Settled.Casters, Settled.CasterCount, GetShadowSpread(Push.SunOneMinusCos));
	if (MayAnyShadow(Scene, View, List, Bound)) { bTouched = 1u; }
}

// Whether a pixel is among the Share of a tile's pixels that are traced, in turn; Share: 1/4 or more. A quarter is one of each 2 × 2, and all
// of them in four frames. In each frame every row and every column of the tile has some.
bool HasTurn(uint Place, uint Turn, float Share)
{
	const uint Rank[4] = uint[4](0u, 2u, 3u, 1u); // ordered dither (Bayer 1973)
	uint Block = (Place >> 2u) & 3u;
	uint Phase = (Rank[Place & 3u] - Turn - Block) & 3u;
	return float(4u * Phase + Rank[Block]) < 16.0 * Share;
}

// Whether a pixel of which nothing is known is traced. The share of those that are halves with each doubling of the distance, down to a
// quarter. If it is not, Fill.glsl has its value.
bool IsTracedFarAway(FViewConstants View, uint Place, uvec2 Pixel)
{
	FSettledConstants Settled = FSettledRef(Push.Settled).Data;
	if (Settled.RateDistance <= 0.0) { return true; }
	float Distance = DistanceFromDepth(View, LoadDepth(Push.Depth, ivec2(Pixel)));
	return HasTurn(Place, Settled.Turn, clamp(Settled.RateDistance / Distance, 0.25, 1.0));
}

// Whether the pixels of the tile around a pixel know the same. In a penumbra some know otherwise, or nothing: a pixel alone may see the sun by
// chance for 16 frames if it sees 97 % of the disk, but nine of them do not.
bool AgreesWithNeighbors(uint Place, uint Class)
{
	ivec2 At = ivec2(TilePixel(uvec2(0u), Place));
	for (int Neighbor = 0; Neighbor < 9; ++Neighbor)
	{
		ivec2 P = At + ivec2(Neighbor % 3, Neighbor / 3) - 1;
		if (any(lessThan(P, ivec2(0))) || any(greaterThanEqual(P, ivec2(TILE_SIZE)))) { continue; }
		uint Other = Knowledge[P.y * TILE_SIZE + P.x];
		if (Other != 0u && Other != Class) { return false; }
	}
	return true;
}

// Returns the known class of a pixel that asks for rays, TILE_SUN_LIT or TILE_SUN_DARK; 0: rays must tell. Called by all threads.
uint FindSettled(FViewConstants View, uint Place, uvec2 Pixel, bool bTraced)
{
	FSettledConstants Settled = FSettledRef(Push.Settled).Data;
	if (Settled.Current == NO_TEXTURE) { return 0u; }
	if (Place == 0u)
	{
		bTouched = Settled.bAnywhere;
		StartBounds();
	}
	barrier();
	uint Class = 0u, Known = bTraced ? Recall(View, Settled, Pixel, Class) : 0u;
	uvec2 At = TilePixel(uvec2(0u), Place);
	Knowledge[At.y * TILE_SIZE + At.x] = Class;
	barrier();
	FindMovedCasters(View, Settled, gl_WorkGroupID.xy);
	barrier();
	bool bTraceAll = bTouched != 0u;
	if (bTraceAll) { Known = (Known & SETTLED_LIT) | min(SettledFrames(Known), SETTLED_FRAMES - SETTLED_FRAMES_AFTER); }
	if (!IsOutsideView(View, Pixel)) { imageStore(Images[Settled.Current], ivec2(Pixel), vec4(float(Known) / 255.0)); }
	if (bTraceAll || (Class != KnownLit && Class != KnownDark) || !AgreesWithNeighbors(Place, Class)) { return 0u; }
	return Class == KnownLit ? TILE_SUN_LIT : TILE_SUN_DARK;
}

#endif
