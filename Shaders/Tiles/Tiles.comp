// Sorts the screen into tiles, answers what needs no ray, and marks the pixels of the rest, for QueueSun.comp.
#version 460
#include "../Shared/TileTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Rays/RayQueue.glsl"
#include "Tile.glsl"
#ifdef HAS_HOST_SHADOW
#include "HostShadow.glsl"
#endif

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FTilesConstants Push; };

#ifdef ADAPTIVE
#include "Settled.glsl"
#endif

shared uint Classes, SunRays[2], SunRest[2], SunLit[2];

#ifdef HAS_HOST_SHADOW
// Class: without the map.
uint ClassifyByHost(FViewConstants View, uvec2 Pixel, FGBufferPoint Point, uint Class)
{
	if (Push.HostShadow == 0ul) { return Class; }
	FHostShadowAnswer Answer = FHostShadowAnswer(HOST_SHADOW_UNSURE, 0.0);
	if (Class == TILE_SUN_TRACED) { Answer = ClassifyHostShadow(Push.HostShadow, View, Point); }
	// Without a ray nothing else knows how wide the penumbra is.
	float Width = Answer.Class == HOST_SHADOW_DARK ? 2.0 * sqrt(2.0 * Push.SunOneMinusCos) * Answer.BlockerDistance : -1.0;
	if (Push.SunWidths != 0ul) { FWidthRef(Push.SunWidths).Data[Pixel.y * View.Width + Pixel.x] = Width; }
	if (Class != TILE_SUN_TRACED) { return Class; }
	if (Answer.Class == HOST_SHADOW_DARK) { return TILE_SUN_DARK; }
	if (Answer.Class == HOST_SHADOW_LIT) { return Push.LitMask != 0u ? TILE_SUN_LIT | TILE_SUN_TRACED : TILE_SUN_LIT; }
	return Push.SunMask != 0u ? TILE_SUN_TRACED : TILE_SUN_LIT;
}
#endif

// Returns the class of a pixel by the sun.
uint ClassifySun(FViewConstants View, uvec2 Pixel)
{
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	if (Depth <= 0.0) { return TILE_SKY; }
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, ivec2(Pixel), Depth);
	FaceDirection(Point, -Scene.SunDirection);
	// No direction to the disk is farther from that to its centre than this chord, and rounding.
	float Spread = Push.SunOneMinusCos > 0.0 ? sqrt(2.0 * Push.SunOneMinusCos) + 1.0e-6 : 0.0;
	uint Class = LeavesSurface(View, Point, -Scene.SunDirection, Spread) ? TILE_SUN_TRACED : TILE_SUN_BEHIND;
#ifdef HAS_HOST_SHADOW
	Class = ClassifyByHost(View, Pixel, Point, Class);
#endif
	return Class;
}

// An answer is whole without a ray, or starts as none.
void StartAnswer(uint Index, uint Class)
{
	uint Answer = 0u;
	if (Class == TILE_SKY || Class == TILE_SUN_LIT) { Answer = PackSunAnswer(Push.SunSamples, 0u); }
	if (Class == TILE_SUN_BEHIND || Class == TILE_SUN_DARK) { Answer = PackSunAnswer(0u, Push.SunSamples); }
	FAnswerRef(Push.Answers).Data[Index] = Answer;
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uint Place = gl_LocalInvocationIndex, Word = Place >> 5u, Bit = 1u << (Place & 31u);
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place);
	uint Index = Pixel.y * View.Width + Pixel.x;
	if (Place < 2u) { SunRays[Place] = SunRest[Place] = SunLit[Place] = 0u; }
	if (Place == 0u) { Classes = 0u; }
	barrier();
	bool bTraced = false, bLit = false;
	if (!IsOutsideView(View, Pixel))
	{
		uint Class = ClassifySun(View, Pixel);
		bTraced = (Class & TILE_SUN_TRACED) != 0u;
		bLit = (Class & TILE_SUN_LIT) != 0u;
		StartAnswer(Index, Class);
		atomicOr(Classes, Class);
	}
#ifdef ADAPTIVE
	uint Known = Push.Settled != 0ul ? FindSettled(View, Place, Pixel, bTraced) : 0u;
	if (bTraced && Known != 0u)
	{
		atomicOr(Classes, Known);
		bTraced = HasTurn(Place, FSettledRef(Push.Settled).Data.Turn, 0.25);
		if (!bTraced)
		{
			StartAnswer(Index, Known == TILE_SUN_LIT ? TILE_SKY : TILE_SUN_BEHIND);
			atomicOr(SunRest[Word], Bit);
		}
	}
	else if (bTraced && Push.Settled != 0ul) { bTraced = IsTracedFarAway(View, Place, Pixel); }
#endif
	if (bTraced) { atomicOr(SunRays[Word], Bit); }
	if (bTraced && bLit) { atomicOr(SunLit[Word], Bit); }
	barrier();
	if (Place == 0u)
	{
		uint TileAt = TileIndex(View, gl_WorkGroupID.xy);
		FTileRef(Push.Tiles).Data[TileAt] = FTile(Classes, SunRays, SunRest, SunLit);
		FTileMarksRef(Push.Marks).Data[TileAt] = uvec2(SunRays[0], SunRays[1]);
	}
}
