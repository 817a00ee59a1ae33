// Asks for more sun rays where one cannot tell and no history helps: in penumbrae that have just come into view, in all but wide ones
// while the picture moves, and in those that move. A penumbra shows by rays of the neighbourhood that differ, or by what the history has seen.
// Without a history it shows by rays of the tile.
#version 460
#include "../Shared/MoreRaysTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/GroupBounds.glsl"
#include "../Rays/RayQueue.glsl"
#include "Tile.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FMoreRaysConstants Push; };

const int RingSize = TILE_SIZE + 2;       // the tile with a ring of neighbours
const uint SeesSun = 1u, SeesNone = 2u;   // answers of a pixel; 0: it had none to give
const float WideEnough = 12.0;             // pixels: a penumbra that histories can be resampled in
const float LeastCoverage = 0.5;          // of a history
const float LeastShare = 0.03;            // of the sun, that a history has seen, or not seen, in a penumbra

shared uint States[RingSize * RingSize], Wanted[2], bTouched;
shared uint RingStates; // of the tile and its ring together

// The answers of a pixel that faces the sun.
uint LoadState(FViewConstants View, ivec2 Pixel)
{
	if (any(lessThan(Pixel, ivec2(0))) || IsOutsideView(View, uvec2(Pixel))) { return 0u; }
	FTile Tile = FTileRef(Push.Tiles).Data[TileIndex(View, uvec2(Pixel) / TILE_SIZE)];
	uint Place = TilePlace(uvec2(Pixel));
	if (!IsMarked(Tile.SunRays, Place) && !IsMarked(Tile.SunRest, Place)) { return 0u; }
	uint Answer = FAnswerRef(Push.Answers).Data[uint(Pixel.y) * View.Width + uint(Pixel.x)];
	return (SunSeen(Answer) > 0u ? SeesSun : 0u) | (SunUnseen(Answer) > 0u ? SeesNone : 0u);
}

void LoadStates(FViewConstants View, uint Place)
{
	ivec2 First = ivec2(gl_WorkGroupID.xy) * TILE_SIZE - 1;
	uint Mine = 0u;
	for (uint I = Place; I < uint(RingSize * RingSize); I += TILE_PIXELS)
	{
		States[I] = LoadState(View, First + ivec2(I % RingSize, I / RingSize));
		Mine |= States[I];
	}
	if (Mine != 0u) { atomicOr(RingStates, Mine); }
}

// Joins the answers of the 3 × 3 pixels around one.
uint JoinStates(uvec2 At)
{
	uint Joined = 0u;
	for (uint I = 0u; I < 9u; ++I) { Joined |= States[(At.y + I / 3u) * RingSize + At.x + I % 3u]; }
	return Joined;
}

// Returns the penumbra's mean width around a pixel, in pixels; 0: no ray knows.
float MeasureWidth(FViewConstants View, ivec2 Pixel, FSurface Surface)
{
	float Sum = 0.0, Count = 0.0;
	for (int I = 0; I < 9; ++I)
	{
		ivec2 P = Pixel + ivec2(I % 3, I / 3) - 1;
		if ((LoadState(View, P) & SeesNone) == 0u) { continue; }
		float Width = FWidthRef(Push.Widths).Data[uint(P.y) * View.Width + uint(P.x)];
		if (!(Width >= 0.0)) { continue; }
		Sum += Width;
		Count += 1.0;
	}
	float Facing = abs(dot(Surface.Normal, CameraRay(View, vec2(Pixel) + 0.5)));
	return Count > 0.0 ? Sum / Count * Facing / PixelHeight(View, Surface.Distance) : 0.0;
}

// Whether a penumbra was at the pixel's place. Where all rays of the neighbourhood agree by chance, nothing else tells.
bool WasPenumbra(FReprojection R)
{
	if (Push.History == NO_TEXTURE) { return false; }
	float Low = 1.0, High = 0.0;
	for (int Tap = 0; Tap < 4; ++Tap)
	{
		if (R.Weights[Tap] < 0.01) { continue; }
		float Seen = texelFetch(Textures[Push.History], GetTap(R, Tap), 0).x;
		Low = min(Low, Seen);
		High = max(High, Seen);
	}
	return High > LeastShare && Low < 1.0 - LeastShare;
}

// bBorder: rays of the neighbourhood differ.
bool NeedsMore(FViewConstants View, ivec2 Pixel, bool bBorder)
{
	if (Push.Reprojection == NO_TEXTURE || bTouched != 0u) { return bBorder; }
	FSurface Surface = LoadSurface(Push.Surface, Pixel);
	vec4 Motion = texelFetch(Textures[Push.Motion], Pixel, 0);
	FReprojection R = LoadReprojection(Push.Reprojection, Pixel);
	if (MovedItself(View, Surface.Distance, uvec2(Pixel), Motion)) { return bBorder; }
	if (R.Coverage < LeastCoverage) { return RingStates == (SeesSun | SeesNone); }
	// A history of the very same point needs no interpolation.
	if (!any(greaterThan(R.Fraction * (1.0 - R.Fraction), vec2(1.0e-4)))) { return false; }
	if (!bBorder && !WasPenumbra(R)) { return false; }
	return MeasureWidth(View, Pixel, Surface) < WideEnough;
}

// Called by all threads.
void FindTouched(FViewConstants View, bool bAsked, ivec2 Pixel)
{
	if (Push.CasterCount == 0u) { return; }
	if (bAsked) { NoteDistance(LoadSurface(Push.Surface, Pixel).Distance); }
	barrier();
	if (HasBounds())
	{
		vec4 Bound = BoundGroup(View, gl_WorkGroupID.xy * TILE_SIZE, TILE_SIZE);
		FCasterList List = FCasterList(Push.Casters, Push.CasterCount, Push.CasterSpread);
		if (MayAnyShadow(FSceneRef(Push.Pass.Scene).Data, View, List, Bound)) { bTouched = 1u; }
	}
	barrier();
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uint Place = gl_LocalInvocationIndex, Word = Place >> 5u, Bit = 1u << (Place & 31u);
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place), At = TilePixel(uvec2(0u), Place);
	uint TileAt = TileIndex(View, gl_WorkGroupID.xy);
	FTile Tile = FTileRef(Push.Tiles).Data[TileAt];
	if ((Tile.SunRays[0] | Tile.SunRays[1]) == 0u)
	{
		if (Place == 0u) { FTileMarksRef(Push.Marks).Data[TileAt] = uvec2(0u); }
		return;
	}
	if (Place == 0u)
	{
		Wanted[0] = Wanted[1] = 0u;
		bTouched = 0u;
		RingStates = 0u;
		StartBounds();
	}
	barrier();
	LoadStates(View, Place);
	barrier();
	bool bAsked = IsMarked(Tile.SunRays, Place) && States[(At.y + 1u) * RingSize + At.x + 1u] != 0u;
	FindTouched(View, bAsked, ivec2(Pixel));
	bool bWanted = bAsked && NeedsMore(View, ivec2(Pixel), JoinStates(At) == (SeesSun | SeesNone));
	if (bWanted) { atomicOr(Wanted[Word], Bit); }
	barrier();
	if (Place == 0u) { FTileMarksRef(Push.Marks).Data[TileAt] = uvec2(Wanted[0], Wanted[1]); }
}
