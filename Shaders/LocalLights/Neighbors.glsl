// What the rays of neighbours say about a tile's pixels that have asked for none in this frame (Rate.glsl). The includer's Push has
// Depth, Normals, TileLights and Answers.
#ifndef LANTERN_LOCAL_NEIGHBORS_GLSL
#define LANTERN_LOCAL_NEIGHBORS_GLSL

#include "../Rays/RayQueue.glsl"
#include "LocalPoint.glsl"
#include "../Library/Planes.glsl"

const uint SlotAnswer = (1u << ANSWER_LOCAL_SEEN) | (1u << ANSWER_LOCAL_TRACED); // of the first slot

shared uint RingAnswers[RingSize * RingSize]; // in the slots of this tile; 0: the pixel had no turn

// Returns a pixel's answers in the slots of Tile, the work group's. Another tile has its lights in slots of its own.
uint LoadAnswers(FViewConstants View, FTileLights Tile, uvec2 Pixel)
{
	uint Answer = FAnswerRef(Push.Answers).Data[Pixel.y * View.Width + Pixel.x], Out = 0u;
	uvec2 Its = Pixel / TILE_SIZE;
	if (all(equal(Its, gl_WorkGroupID.xy))) { return Answer; }
	uint Index = TileIndex(View, Its), Count = FTileLightsRef(Push.TileLights).Data[Index].Count;
	if (Count > TILE_LIGHTS) { return 0u; }
	for (uint I = 0u; I < Count; ++I)
	{
		uint Light = FTileLightsRef(Push.TileLights).Data[Index].Lights[I];
		for (uint Slot = 0u; Slot < Tile.Count; ++Slot)
		{
			if (Tile.Lights[Slot] == Light) { Out |= ((Answer >> I) & SlotAnswer) << Slot; }
		}
	}
	return Out;
}

// Called by all threads, with a barrier behind it. Of many lights, answers are not loaded.
void LoadNeighbors(FViewConstants View, FTileLights Tile, uint Place)
{
	ivec2 First = ivec2(gl_WorkGroupID.xy) * TILE_SIZE - 1;
	for (uint I = Place; I < uint(RingSize * RingSize); I += TILE_PIXELS)
	{
		ivec2 Pixel = First + ivec2(I % RingSize, I / RingSize);
		bool bInside = all(greaterThanEqual(Pixel, ivec2(0))) && !IsOutsideView(View, uvec2(Pixel));
		float Depth = bInside ? LoadDepth(Push.Depth, Pixel) : 0.0;
		SetPlane(I, false, vec3(0.0), vec3(0.0));
		RingAnswers[I] = 0u;
		if (Depth <= 0.0) { continue; }
		FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
		SetPlane(I, true, Point.Relative, Point.Ng);
		bool bFew = Tile.Count <= TILE_LIGHTS;
		if (bFew && HasTurn(View.FrameIndex, TilePlace(uvec2(Pixel)))) { RingAnswers[I] = LoadAnswers(View, Tile, uvec2(Pixel)); }
	}
}

// Returns the rays that neighbours traced to a slot's light, and how many of them got through. Neighbors: see FindNeighbors.
uvec2 CountNeighborRays(ivec2 InTile, uint Neighbors, uint Slot)
{
	uvec2 Rays = uvec2(0u);
	for (uint I = 0u; I < 9u; ++I)
	{
		if ((Neighbors & (1u << I)) == 0u) { continue; }
		uint Answer = RingAnswers[RingPlace(InTile + ivec2(I % 3u, I / 3u) - 1)] >> Slot;
		Rays += (uvec2(Answer >> ANSWER_LOCAL_TRACED, Answer >> ANSWER_LOCAL_SEEN)) & 1u;
	}
	return Rays;
}

#endif
