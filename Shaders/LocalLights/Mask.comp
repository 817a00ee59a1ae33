// Packs what each pixel sees of the lights in its tile's slots, for a host that lights by itself (FRTModuleLightMask).
// MASK_HISTORY: lights with an extent are accumulated over frames (MaskHistory.glsl).
#version 460
#include "../Shared/LightMaskTypes.h"
#include "../Library/UintTextures.glsl"
#include "../Tiles/Tile.glsl"
#include "LocalPoint.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FLightMaskConstants Push; };

#include "SlotAnswers.glsl"

// What a pixel sees of a slot's light.
struct FSlotValue
{
	float Visibility;
	bool bOwn;     // a ray of this frame says so, of the pixel or of others on its plane
	bool bCertain; // no chance is in it, or no ray
};

shared uint Numbers[TILE_LIGHTS]; // FLightData::Number; 0: a free slot
shared uint Extended;             // a bit for each slot whose light has an extent

// Rounds up or down by chance, so that means over time are exact. U: a byte of chance.
uint Dither(float Value, uint U) { return uint(Value + (float(U & 255u) + 0.5) * (1.0 / 256.0)); }

// Chance: 8 bytes of it.
uint ChanceByte(uvec2 Chance, uint Slot) { return (Slot < 4u ? Chance.x : Chance.y) >> (8u * (Slot & 3u)); }

#ifdef MASK_HISTORY
#include "MaskHistory.glsl"
#endif

void LoadLights(FSceneConstants Scene, FTileLights Tile, uint Place)
{
	if (Place == 0u) { Extended = 0u; }
	barrier();
	if (Place >= TILE_LIGHTS) { return; }
	Numbers[Place] = 0u;
	if (Place >= Tile.Count || Tile.Lights[Place] == TILE_LIGHT_NONE) { return; }
	FLightData Light = FLightRef(Scene.Lights).Data[Tile.Lights[Place] & ~TILE_LIGHT_UNSHADOWED];
	Numbers[Place] = Light.Number;
	if (HasExtent(Light)) { atomicOr(Extended, 1u << Place); }
}

FSlotValue GetSlotValue(FTileLights Tile, uint Slot, uint Place, uint Answer, uvec2 Neighbors)
{
	if (Numbers[Slot] == 0u) { return FSlotValue(0.0, false, true); }
	if ((Tile.Lights[Slot] & TILE_LIGHT_UNSHADOWED) != 0u) { return FSlotValue(1.0, false, true); }
	if ((Tile.Reached[2u * Slot + (Place >> 5u)] & (1u << (Place & 31u))) == 0u) { return FSlotValue(0.0, false, true); }
	FSlotValue Value;
	Value.Visibility = SlotVisibility(Answer, Slot, ANSWER_LOCAL_SEEN + Slot, ANSWER_LOCAL_TRACED + Slot, Neighbors);
	bool bTraced = (Answer & (1u << (ANSWER_LOCAL_TRACED + Slot))) != 0u;
	Value.bOwn = bTraced || Neighbors.x > 0u;
	Value.bCertain = Value.bOwn && (Extended & (1u << Slot)) == 0u;
	return Value;
}

// 16 bytes of chance: for the mask those of x and y, for the history those of z and w.
uvec4 LoadChance(FViewConstants View, uvec2 Pixel) { return HashPcg4(uvec4(Pixel, View.FrameIndex, View.Seed ^ 0x5bd1e995u)); }

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	uint Place = gl_LocalInvocationIndex;
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place);
	bool bInside = !IsOutsideView(View, Pixel);
	uint Answer = bInside ? FAnswerRef(Push.Answers).Data[Pixel.y * View.Width + Pixel.x] : 0u;
	FTileLights Tile = FTileLightsRef(Push.TileLights).Data[TileIndex(View, gl_WorkGroupID.xy)];
	CountAnswers(Tile, View, Answer, Place);
	LoadLights(Scene, Tile, Place);
	barrier();
	if (Place < TILE_LIGHTS)
	{
		imageStore(UintImages[Push.OutLights], ivec2(gl_WorkGroupID.x * TILE_SIZE + Place, gl_WorkGroupID.y), uvec4(Numbers[Place]));
	}
	bool bSurface = bInside && LoadDepth(Push.Depth, ivec2(Pixel)) > 0.0;
	uint Neighbors = 0u;
#ifdef SPARSE
	if (!HasTurn(View.FrameIndex, Place)) { Neighbors = FindNeighbors(View, ivec2(TilePixel(uvec2(0u), Place)), false); }
#endif
	FSlotValue Values[TILE_LIGHTS];
	for (uint Slot = 0u; Slot < TILE_LIGHTS; ++Slot)
	{
		uvec2 Rays = uvec2(0u);
#ifdef SPARSE
		Rays = CountNeighborRays(ivec2(TilePixel(uvec2(0u), Place)), Neighbors, Slot);
#endif
		Values[Slot] = GetSlotValue(Tile, Slot, Place, Answer, Rays);
	}
	uvec4 Chance = LoadChance(View, Pixel);
#ifdef MASK_HISTORY
	AccumulateSlots(Scene, View, Tile, bSurface, Pixel, Place, Chance.zw, Values);
#endif
	if (!bInside) { return; }
	uint Mask = 0u;
	for (uint Slot = 0u; Slot < TILE_LIGHTS; ++Slot) { Mask |= Dither(Values[Slot].Visibility * 15.0, ChanceByte(Chance.xy, Slot)) << (4u * Slot); }
	imageStore(UintImages[Push.OutMask], ivec2(Pixel), uvec4(bSurface ? Mask : 0u));
}
