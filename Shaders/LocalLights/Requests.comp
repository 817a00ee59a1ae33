// Finds the lights of a tile, and queues their rays: for all of its lights if they are few, else for one that each pixel chooses.
// CHOSEN_RAYS: lights that each pixel of a tile of many chooses.
// MANY_LIGHTS: defined if the scene has more lights than FLocalRequestsConstants::Exact.
// LOCAL_EMISSIVE: emissive triangles shine as lights do. Pixels choose one of them, or of them and all lights where these are many.
// LIGHT_MASK: a tile of many lights has rays to TILE_LIGHTS of them all the same, and pixels choose of the rest (MaskSlots.glsl).
// MASK_ALONE: nobody reads what pixels would choose.
// GUIDED: pixels choose from a table of their tile's lights (TileTable.glsl). Not defined: from all, which takes long.
// LISTS_CHOOSERS: tiles whose pixels choose are marked, for Choose.comp.
#version 460
#include "../Tiles/Tile.glsl"
#include "TileRequests.glsl"
#include "TileBox.glsl"
#if defined(MANY_LIGHTS) && !defined(GUIDED)
#include "../Library/LightCells.glsl"
#endif

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FLocalRequestsConstants Push; };

const uint MaxCandidates = 32u; // lights whose ranges meet the tile; a tile of more has many

shared uint CandidateCount, Found[MaxCandidates], Candidates[MaxCandidates];
shared uint Reached[2u * MaxCandidates];
shared FTileLights Tile;

#ifdef GUIDED
#include "TileTable.glsl"
#ifdef LOCAL_EMISSIVE
#include "EmitterSearch.glsl"
#endif
#else
struct FTileSource
{
	uint Count;
	bool bDrawn;
};
FTileSource FindSource(FSceneConstants Scene, FViewConstants View) { return FTileSource(Scene.LightCount, false); }
uint SourceLight(FTileSource Source, uint I) { return I; }
#endif

// Whether a light may bring something to the pixel.
bool MayLight(FSceneConstants Scene, FLightData Light, FLocalPoint Point)
{
	return SharesChannel(Light, Point.Channels) && EstimateLightAt(Scene, Light, Point) > 0.0;
}

#ifdef LIGHT_MASK
#include "MaskSlots.glsl"
#endif

// Finds lights whose ranges meet the tile. Their order does not depend on that of threads.
void FindCandidates(FSceneConstants Scene, FViewConstants View, uint Place)
{
	vec3 Low = BoxCorner(LowBits), High = BoxCorner(HighBits);
	FLightRef Lights = FLightRef(Scene.Lights);
	FTileSource Source = FindSource(Scene, View);
	if (Source.bDrawn && Place == 0u) { CandidateCount = MaxCandidates + 1u; }
	for (uint I = Place; I < Source.Count && !Source.bDrawn; I += TILE_PIXELS)
	{
		uint Light = SourceLight(Source, I);
		if (!MayReach(Scene, Lights.Data[Light], Low, High)) { continue; }
		uint Number = atomicAdd(CandidateCount, 1u);
		if (Number < MaxCandidates) { Found[Number] = Light; }
	}
	barrier();
	if (Place < CandidateCount && CandidateCount <= MaxCandidates)
	{
		uint Rank = 0u;
		for (uint I = 0u; I < CandidateCount; ++I) { Rank += Found[I] < Found[Place] ? 1u : 0u; }
		Candidates[Rank] = Found[Place];
	}
	barrier();
}

// Marks the candidates that the pixel may be lit by.
void MarkReached(FSceneConstants Scene, FLocalPoint Point, uint Place)
{
	FLightRef Lights = FLightRef(Scene.Lights);
	for (uint I = 0u; I < CandidateCount; ++I)
	{
		if (!MayLight(Scene, Lights.Data[Candidates[I]], Point)) { continue; }
		atomicOr(Reached[2u * I + (Place >> 5u)], 1u << (Place & 31u));
	}
}

// Keeps the candidates that some pixel is lit by. One thread.
void ListLights(FSceneConstants Scene)
{
	Tile.Count = CandidateCount > MaxCandidates ? TILE_LIGHTS_MANY : 0u;
	Tile.bChooses = Tile.Count != 0u ? 1u : 0u;
#ifdef LOCAL_EMISSIVE
	if (EmitterCount > 0u) { Tile.bChooses = 1u; }
#endif
	for (uint I = 0u; I < 2u * TILE_CHOSEN_MOST; ++I) { Tile.Asking[I] = 0u; }
	Tile.Chose[0] = Tile.Chose[1] = 0u;
	for (uint I = 0u; I < 2u * TILE_LIGHTS; ++I) { Tile.Reached[I] = 0u; }
	if (Tile.Count != 0u) { return; }
	for (uint I = 0u; I < CandidateCount; ++I)
	{
		if ((Reached[2u * I] | Reached[2u * I + 1u]) == 0u) { continue; }
		if (Tile.Count == (Push.Limits & 0xffu))
		{
			Tile.Count = TILE_LIGHTS_MANY;
			Tile.bChooses = 1u;
			break;
		}
		bool bCasts = (FLightRef(Scene.Lights).Data[Candidates[I]].Flags & LIGHT_CASTS_SHADOW) != 0u;
		Tile.Lights[Tile.Count] = Candidates[I] | (bCasts ? 0u : TILE_LIGHT_UNSHADOWED);
		Tile.Reached[2u * Tile.Count] = Reached[2u * I];
		Tile.Reached[2u * Tile.Count + 1u] = Reached[2u * I + 1u];
		++Tile.Count;
	}
	if (Tile.Count != TILE_LIGHTS_MANY) { return; }
	for (uint I = 0u; I < 2u * TILE_LIGHTS; ++I) { Tile.Reached[I] = 0u; }
}

#ifdef MANY_LIGHTS
#if defined(MASK_ALONE)
// What is drawn makes a table, so that the tile remembers lights for its mask. All threads.
void RememberForMask(FSceneConstants Scene, FViewConstants View, uint Place)
{
	bool bMade = bDrawnMask != 0u;
	if (bMade) { MakeTable(Scene, View, Place, BoxCorner(LowBits), BoxCorner(HighBits)); }
	WriteGuide(View, Place, bMade);
	barrier();
	if (Place == 0u) { Tile.bChooses = 0u; }
}
#elif defined(LISTS_CHOOSERS)
#include "ListChooser.glsl"
#else
#include "ChooseOfMany.glsl"
#endif
#endif

void Start(uint Place)
{
	StartBox(Place);
	Reached[Place] = 0u; // as many words as threads
	if (Place == 0u)
	{
		CandidateCount = Tile.Count = 0u;
#ifdef LOCAL_EMISSIVE
		EmitterCount = 0u;
#endif
	}
	barrier();
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	uint Place = gl_LocalInvocationIndex;
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place);
	uint PixelIndex = Pixel.y * View.Width + Pixel.x;
	float Depth = IsOutsideView(View, Pixel) ? 0.0 : LoadDepth(Push.Depth, ivec2(Pixel));
	if (Push.Answers != 0ul && !IsOutsideView(View, Pixel)) { FAnswerRef(Push.Answers).Data[PixelIndex] = 0u; }
	bool bSurface = Depth > 0.0;
	FLocalPoint Point;
	Start(Place);
	if (bSurface)
	{
		Point = LoadLocalPoint(Scene, View, Push.Normals, Push.Channels, Pixel, Depth);
		GrowBox(Point.P);
	}
	barrier();
	bool bEmpty = IsBoxEmpty();
	if (!bEmpty) { FindCandidates(Scene, View, Place); }
#ifdef LOCAL_EMISSIVE
	if (!bEmpty) { CountEmitters(Scene, View, Place); }
#endif
	barrier();
	if (bSurface && CandidateCount <= MaxCandidates) { MarkReached(Scene, Point, Place); }
	barrier();
	if (Place == 0u) { ListLights(Scene); }
	barrier();
#ifdef LIGHT_MASK
	ListMask(Scene, View, Point, bSurface, Pixel, Place);
#endif
#ifdef MASK_ALONE
#ifdef MANY_LIGHTS
	RememberForMask(Scene, View, Place);
	barrier();
#endif
#elif defined(LISTS_CHOOSERS)
	ListChooser(View, Point, bSurface, Pixel, Place);
	barrier();
#elif defined(MANY_LIGHTS)
	ChooseOfMany(Scene, View, Point, bSurface, Pixel, Place);
	barrier();
#endif
	uint Slots = CountSlots(Tile), All = Slots + CountChosen(Tile); // what pixels chose comes last
	if (Place < 2u * All) { Asking[Place] = AskingPixels(Tile, Place >> 1u, Place & 1u, View.FrameIndex); }
	barrier();
	if (Place == 0u)
	{
		Reserve(All, Push.Counters, Push.Capacity);
		FTileLightsRef(Push.TileLights).Data[TileIndex(View, gl_WorkGroupID.xy)] = Tile;
	}
	barrier();
	WriteRequests(All, Slots, Push.Requests, Push.Capacity, Place, PixelIndex);
}
