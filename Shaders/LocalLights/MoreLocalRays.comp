// Asks for more rays to lamps with an extent where one ray cannot tell and no history helps: in penumbrae that have just come into view,
// or whose history has been given up. A penumbra shows by rays of the neighbourhood that differ.
#version 460
#include "../Shared/MoreLocalRaysTypes.h"
#include "../Library/History.glsl"
#define REQUEST_THREADS LOCAL_MORE_RAYS
#include "TileRequests.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FMoreLocalRaysConstants Push; };

#include "Neighbors.glsl"

const float EnoughFrames = 16.0; // of one ray each, that a history is relied on from

shared uint bAnyNeeds;

// Returns how many frames of one ray the pixel's history is worth.
float LoadFrames(ivec2 Pixel)
{
	if (Push.History == NO_TEXTURE) { return 0.0; }
	FAnchor Anchor = LoadAnchor(Push.Anchors, Pixel);
	float Frames = Anchor.bFound ? GetAnchoredFrames(Anchor, texelFetch(Textures[Push.History], Anchor.Texel, 0).w) : 0.0;
	return Frames > 0.0 ? Frames : 0.0; // not a number is no history
}

// Marks the slots whose lights the pixel wants more rays to, and returns a bit for each. Answer: the pixel's own. Each request is for a ray
// that has had room in the queue, so that all have.
uint MarkBorders(FSceneConstants Scene, FViewConstants View, FTileLights Tile, uint Place, uint Answer)
{
	ivec2 InTile = ivec2(TilePixel(uvec2(0u), Place));
	uint Neighbors = FindNeighbors(View, InTile, false), Found = 0u;
	for (uint Slot = 0u; Slot < Tile.Count; ++Slot)
	{
		uvec2 Own = uvec2(Answer >> (ANSWER_LOCAL_TRACED + Slot), Answer >> (ANSWER_LOCAL_SEEN + Slot)) & 1u;
		if (Own.x == 0u || !HasExtent(FLightRef(Scene.Lights).Data[Tile.Lights[Slot]])) { continue; }
		uvec2 Rays = CountNeighborRays(InTile, Neighbors, Slot) + Own;
		if (Rays.y == 0u || Rays.y == Rays.x) { continue; }
		atomicOr(Asking[2u * Slot + (Place >> 5u)], 1u << (Place & 31u));
		Found |= 1u << Slot;
	}
	return Found;
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FTileLights Tile = FTileLightsRef(Push.TileLights).Data[TileIndex(View, gl_WorkGroupID.xy)];
	uint Place = gl_LocalInvocationIndex;
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place);
	uint PixelIndex = Pixel.y * View.Width + Pixel.x;
	bool bInside = !IsOutsideView(View, Pixel), bFew = Tile.Count > 0u && Tile.Count <= TILE_LIGHTS;
	uint Answer = bInside && bFew ? FAnswerRef(Push.Answers).Data[PixelIndex] : 0u;
	const uint AnyTraced = ((1u << TILE_LIGHTS) - 1u) << ANSWER_LOCAL_TRACED;
	bool bNeeds = (Answer & AnyTraced) != 0u && LoadFrames(ivec2(Pixel)) < EnoughFrames;
	if (Place == 0u) { bAnyNeeds = 0u; }
	if (Place < 2u * TILE_LIGHTS) { Asking[Place] = 0u; }
	barrier();
	if (bNeeds) { bAnyNeeds = 1u; }
	barrier();
	uint Slots = 0u;
	if (bAnyNeeds != 0u)
	{
		LoadNeighbors(View, Tile, Place);
		barrier();
		if (bNeeds) { Slots = MarkBorders(FSceneRef(Push.Pass.Scene).Data, View, Tile, Place, Answer); }
	}
	if (bInside) { FAnswerRef(Push.MoreAnswers).Data[PixelIndex] = Slots; }
	if (bAnyNeeds == 0u) { return; }
	barrier();
	if (Place == 0u) { Reserve(Tile.Count, Push.Counters, Push.Capacity); }
	barrier();
	WriteRequests(Tile.Count, Tile.Count, Push.Requests, Push.Capacity, Place, PixelIndex);
}
