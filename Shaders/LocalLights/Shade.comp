// Lights pixels by local lights, from the answers of their rays.
// LIGHT_MASK: lights in slots are in the light mask (Mask.comp), and the rest counts here.
#version 460
#include "../Shared/DenoiseTypes.h"
#include "../Tiles/Tile.glsl"
#include "Demodulate.glsl"
#include "LocalPoint.glsl"
#ifdef GUIDED
#include "Guide.glsl"
#endif

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FLocalShadeConstants Push; };

#include "SlotAnswers.glsl"
#if defined(SPARSE) && defined(MANY_LIGHTS)
#include "FillFromTile.glsl"
#endif

#ifdef GUIDED
shared uint GuideTracedNow[TILE_GUIDE_LIGHTS], GuideSeenNow[TILE_GUIDE_LIGHTS];

// Adds what the tile's rays saw to its guide. All threads. Count: of what pixels chose.
void Remember(FSceneConstants Scene, FViewConstants View, uint PixelIndex, uint Count, uint Answer, uint Place)
{
	if (Place < TILE_GUIDE_LIGHTS) { GuideTracedNow[Place] = GuideSeenNow[Place] = 0u; }
	barrier();
	uint Index = TileIndex(View, gl_WorkGroupID.xy);
	FTileGuideRef Guides = FTileGuideRef(Push.Guide);
	for (uint I = 0u; I < Count; ++I)
	{
		if ((Answer & (1u << ChosenTracedBit(I))) == 0u) { continue; }
		uint Choice = FLightChoiceRef(Push.Choices).Data[ChoiceIndex(View, PixelIndex, I)].Light;
		uint Light = GuideNumber(Scene, Choice), Slot = GuidePlace(Light, GuideTileHash(Index));
		bool bSeen = (Answer & (1u << ChosenSeenBit(I))) != 0u;
		if (Guides.Data[Index].Lights[Slot].Light == Light)
		{
			atomicAdd(GuideTracedNow[Slot], 1u);
			atomicAdd(GuideSeenNow[Slot], bSeen ? 1u : 0u);
		}
	}
	barrier();
	if (Place >= TILE_GUIDE_LIGHTS || GuideTracedNow[Place] == 0u) { return; }
	uint Old = Guides.Data[Index].Lights[Place].Counts;
	vec2 Rays = vec2(GuideTraced(Old), GuideSeen(Old)) + vec2(GuideTracedNow[Place], GuideSeenNow[Place]) * float(TILE_GUIDE_RAY);
	Guides.Data[Index].Lights[Place].Counts = PackGuideCounts(Rays.x, Rays.y);
}
#endif

// Whether no chance is in what a light brings: it shines from one point, and Answer has the pixel's own ray to it, or neighbours agree.
// Neighbors: their rays to it, and those that got through.
bool IsCertain(FSceneConstants Scene, uint Light, uint Answer, uint Slot, uvec2 Neighbors)
{
	if (HasExtent(FLightRef(Scene.Lights).Data[Light & ~TILE_LIGHT_UNSHADOWED])) { return false; }
	bool bOwnRay = (Answer & (1u << (ANSWER_LOCAL_TRACED + Slot))) != 0u, bAgree = Neighbors.y == 0u || Neighbors.y == Neighbors.x;
	return (Light & TILE_LIGHT_UNSHADOWED) != 0u || bOwnRay || (Neighbors.x > 0u && bAgree);
}

// More: see LocalNumbers.
void AddLight(inout FLobes Sum, FSceneConstants Scene, FViewConstants View, FLocalPoint Point, FLocalBrdf Local, uvec2 Pixel, uint Light,
              uint More, float Weight)
{
	FLightSample Sample = SampleLocalLight(Scene, View, Point, Pixel, Light, More);
	if (!ReachesLight(View, Point, Sample)) { return; }
	FLobes Lobes = ReflectLight(Point, Local, Sample, Light);
	Sum.Diffuse += Lobes.Diffuse * Weight;
	Sum.Specular += Lobes.Specular * Weight;
}

#ifdef MANY_LIGHTS
void AddChosen(inout FLobes Sum, FTileLights Tile, FSceneConstants Scene, FViewConstants View, uvec2 Pixel, uint Place, uint Answer,
               FLocalPoint Point, FLocalBrdf Local)
{
	uint Count = CountChosen(Tile), Before = 0xffffffffu;
	float Share = 1.0 / float(Count), Visibility = 1.0;
	for (uint I = 0u; I < Count; ++I)
	{
		uint Index = ChoiceIndex(View, Pixel.y * View.Width + Pixel.x, I);
		FLightChoice Choice = FLightChoiceRef(Push.Choices).Data[Index];
		if (Choice.Weight <= 0.0) { continue; }
		bool bAsked = (Tile.Asking[2u * I + (Place >> 5u)] & (1u << (Place & 31u))) != 0u;
		if (bAsked) { Visibility = SlotVisibility(Answer, ChosenSlot, ChosenSeenBit(I), ChosenTracedBit(I), uvec2(0u)); }
		else if (Choice.Light != Before) { Visibility = 1.0; }
		Before = Choice.Light;
		if (Visibility <= 0.0) { continue; }
#ifdef GUIDED
		if (Push.Lit != FAddress(0))
		{
			FLobes Lit = UnpackLobes(FLitPixelRef(Push.Lit).Data[Index].Lobes);
			Sum.Diffuse += Lit.Diffuse * (Visibility * Share);
			Sum.Specular += Lit.Specular * (Visibility * Share);
			continue;
		}
#endif
		AddLight(Sum, Scene, View, Point, Local, Pixel, Choice.Light, 0u, Choice.Weight * Visibility * Share);
	}
}
#endif

// Answer, More: of the pixel's rays, and of its further ones. bCertain: gets whether another frame's rays would bring the same.
FLobes ShadePixel(FTileLights Tile, FSceneConstants Scene, FViewConstants View, uvec2 Pixel, uint Place, uint Answer, uint More,
                  FLocalPoint Point, FLocalBrdf Local, out bool bCertain)
{
	FLobes Sum = FLobes(vec3(0.0), vec3(0.0));
	bCertain = Tile.bChooses == 0u;
#ifdef MANY_LIGHTS
	if (HaveChosen(Tile)) { AddChosen(Sum, Tile, Scene, View, Pixel, Place, Answer, Point, Local); }
#endif
#ifndef LIGHT_MASK
	uint Neighbors = 0u;
#ifdef SPARSE
	if (!HasTurn(View.FrameIndex, Place)) { Neighbors = FindNeighbors(View, ivec2(TilePixel(uvec2(0u), Place)), false); }
#endif
	uint Slots = CountSlots(Tile);
	for (uint I = 0u; I < Slots; ++I)
	{
		if ((Tile.Reached[2u * I + (Place >> 5u)] & (1u << (Place & 31u))) == 0u) { continue; }
		bool bUnshadowed = (Tile.Lights[I] & TILE_LIGHT_UNSHADOWED) != 0u;
		uvec2 Rays = uvec2(0u);
#ifdef SPARSE
		Rays = CountNeighborRays(ivec2(TilePixel(uvec2(0u), Place)), Neighbors, I);
#endif
		bCertain = bCertain && IsCertain(Scene, Tile.Lights[I], Answer, I, Rays);
		float Visibility = bUnshadowed ? 1.0 : SlotVisibility(Answer, I, ANSWER_LOCAL_SEEN + I, ANSWER_LOCAL_TRACED + I, Rays);
		bool bMore = (More & (1u << I)) != 0u;
		const float Share = 1.0 / float(LOCAL_MORE_RAYS + 1u); // of each ray, if the pixel has more
		if (bMore) { Visibility *= Share; }
		uint Light = Tile.Lights[I] & ~TILE_LIGHT_UNSHADOWED;
		if (Visibility > 0.0) { AddLight(Sum, Scene, View, Point, Local, Pixel, Light, 0u, Visibility); }
		for (uint J = 0u; bMore && J < LOCAL_MORE_RAYS; ++J)
		{
			if ((More & MoreSeenBit(I, J)) == 0u) { continue; }
			AddLight(Sum, Scene, View, Point, Local, Pixel, Light, J + 1u, Share);
		}
	}
#endif
	return Sum;
}

// Chance: CHANCE_…, for filters.
void WriteLobes(uvec2 Pixel, FLobes Lobes, float Chance)
{
	const float MaxHalf = 65504.0;
	if (Push.OutDiffuse != NO_TEXTURE) { imageStore(Images[Push.OutDiffuse], ivec2(Pixel), RoundToHalf(vec4(min(Lobes.Diffuse, MaxHalf), Chance))); }
	if (Push.OutSpecular != NO_TEXTURE) { imageStore(Images[Push.OutSpecular], ivec2(Pixel), RoundToHalf(vec4(min(Lobes.Specular, MaxHalf), Chance))); }
}

FLobes ShadeSurface(FTileLights Tile, FSceneConstants Scene, FViewConstants View, uvec2 Pixel, uint Place, uint Answer, uint More,
                    float Depth, out bool bCertain)
{
	FLocalPoint Point = LoadLocalPoint(Scene, View, Push.Normals, Push.Channels, Pixel, Depth);
	FLocalBrdf Local = LoadLocalBrdf(Point, Push.BaseColor, Push.Material, Push.BackAlbedo, Pixel, Push.ReflectedRoughness);
	FLobes Sum = ShadePixel(Tile, Scene, View, Pixel, Place, Answer, More, Point, Local, bCertain);
	float Roughness = texelFetch(Textures[Push.Material], ivec2(Pixel), 0).x;
	return Demodulate(Sum, Local.Brdf, dot(Point.Surface.BentN, Point.Surface.V), Roughness);
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	uint Place = gl_LocalInvocationIndex;
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place);
	bool bInside = !IsOutsideView(View, Pixel);
	uint Answer = bInside ? FAnswerRef(Push.Answers).Data[Pixel.y * View.Width + Pixel.x] : 0u;
	uint More = bInside && Push.MoreAnswers != FAddress(0) ? FAnswerRef(Push.MoreAnswers).Data[Pixel.y * View.Width + Pixel.x] : 0u;
	FTileLights Tile = FTileLightsRef(Push.TileLights).Data[TileIndex(View, gl_WorkGroupID.xy)];
	CountAnswers(Tile, View, Answer, Place);
#ifdef GUIDED
	Remember(Scene, View, Pixel.y * View.Width + Pixel.x, CountChosen(Tile), HaveChosen(Tile) ? Answer : 0u, Place);
#endif
	barrier();
	float Depth = bInside ? LoadDepth(Push.Depth, ivec2(Pixel)) : 0.0;
	FLobes Lobes = FLobes(vec3(0.0), vec3(0.0));
	bool bCertain = Depth <= 0.0 || Tile.bChooses != TILE_CHOOSES_NOBODY, bOfOthers = false;
	if (Depth > 0.0 && (Tile.Count != 0u || HaveChosen(Tile))) { Lobes = ShadeSurface(Tile, Scene, View, Pixel, Place, Answer, More, Depth, bCertain); }
#ifdef SPARSE
	bOfOthers = !bCertain && !HasTurn(View.FrameIndex, Place);
#ifdef MANY_LIGHTS
	if (ChoosesOfLights(Tile)) { Lobes = FillFromTile(View, Tile, Place, Lobes, bOfOthers); }
#endif
#endif
	bool bAsked = (Tile.Asking[Place >> 5u] & (1u << (Place & 31u))) != 0u;
	bool bSeldom = Tile.bChooses != 0u && !ChoosesOfLights(Tile) && !bAsked; // of an emitter; dim ones get rays in some frames alone
	float Chance = bOfOthers && Tile.Count != 0u ? CHANCE_OF_OTHERS : bSeldom ? CHANCE_OF_NOBODY : Tile.bChooses != 0u ? CHANCE_OF_MANY : CHANCE_SOME;
	if (Tile.bChooses == 0u && !bOfOthers && (More & ANSWER_MORE_SLOTS) != 0u) { Chance = CHANCE_OF_SEVERAL + float(LOCAL_MORE_RAYS + 1u); }
	if (bInside) { WriteLobes(Pixel, Lobes, bCertain ? CHANCE_NONE : Chance); }
}
