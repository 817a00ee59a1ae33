// Asks for more rays to lamps with an extent where one ray cannot tell and no history helps: in tiles that a penumbra may cross, for pixels
// that have just come into view, or whose history has been given up. Tiles decide, and not a pixel's neighbours: whether few rays differ
// depends on what each has seen. Rays of the rare kind would ask for others more often, and the mean would have a bias.
#version 460
#include "../Shared/MoreLocalRaysTypes.h"
#include "../Library/History.glsl"
#include "../Tiles/Tile.glsl"
#define REQUEST_THREADS LOCAL_MORE_RAYS
#include "TileRequests.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FMoreLocalRaysConstants Push; };

shared uint SeenSlots, UnseenSlots; // of which some pixel of the tile has such an answer

// Returns how many frames of one ray the pixel's history is worth.
float LoadFrames(ivec2 Pixel)
{
	if (Push.History == NO_TEXTURE) { return 0.0; }
	FAnchor Anchor = LoadAnchor(Push.Anchors, Pixel);
	float Frames = Anchor.bFound ? GetAnchoredFrames(Anchor, texelFetch(Textures[Push.History], Anchor.Texel, 0).w) : 0.0;
	return Frames > 0.0 ? Frames : 0.0; // not a number is no history
}

// Returns a bit for each slot that some rays of the tile see and others do not. Lamps without an extent have no penumbra.
uint FindMixedSlots(FSceneConstants Scene, FTileLights Tile)
{
	uint Mixed = SeenSlots & UnseenSlots;
	for (uint Slots = Mixed; Slots != 0u; Slots &= Slots - 1u)
	{
		uint Slot = uint(findLSB(Slots));
		if (!HasExtent(FLightRef(Scene.Lights).Data[Tile.Lights[Slot]])) { Mixed &= ~(1u << Slot); }
	}
	return Mixed;
}

// Marks slots whose lights the pixel wants more rays to.
void Ask(uint Slots, uint Place)
{
	for (; Slots != 0u; Slots &= Slots - 1u) { atomicOr(Asking[2u * uint(findLSB(Slots)) + (Place >> 5u)], 1u << (Place & 31u)); }
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FTileLights Tile = FTileLightsRef(Push.TileLights).Data[TileIndex(View, gl_WorkGroupID.xy)];
	uint Place = gl_LocalInvocationIndex;
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place);
	uint PixelIndex = Pixel.y * View.Width + Pixel.x;
	bool bInside = !IsOutsideView(View, Pixel);
	uint Answer = bInside && Tile.Count <= TILE_LIGHTS ? FAnswerRef(Push.Answers).Data[PixelIndex] : 0u;
	uint Traced = (Answer >> ANSWER_LOCAL_TRACED) & ANSWER_MORE_SLOTS, Seen = (Answer >> ANSWER_LOCAL_SEEN) & Traced;
	if (Place == 0u) { SeenSlots = UnseenSlots = 0u; }
	if (Place < 2u * TILE_LIGHTS) { Asking[Place] = 0u; }
	barrier();
	if (Seen != 0u) { atomicOr(SeenSlots, Seen); }
	if (Seen != Traced) { atomicOr(UnseenSlots, Seen ^ Traced); }
	barrier();
	uint Mixed = FindMixedSlots(FSceneRef(Push.Pass.Scene).Data, Tile), Slots = 0u;
	// Each light's first ray has had room in the queue, so that all further ones have.
	if ((Mixed & Traced) != 0u && LoadFrames(ivec2(Pixel)) < Push.EnoughFrames) { Slots = Mixed & Traced; }
	if (bInside) { FAnswerRef(Push.MoreAnswers).Data[PixelIndex] = Slots; }
	if (Mixed == 0u) { return; }
	Ask(Slots, Place);
	barrier();
	if (Place == 0u) { Reserve(Tile.Count, Push.Counters, Push.Capacity); }
	barrier();
	WriteRequests(Tile.Count, Tile.Count, Push.Requests, Push.Capacity, Place, PixelIndex);
}
