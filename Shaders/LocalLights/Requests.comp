// Finds the lights of a tile, and queues their rays: for all of its lights if they are few, else for one that each pixel chooses.
// CHOSEN_RAYS: lights that each pixel of a tile of many chooses.
// MANY_LIGHTS: defined if the scene has more lights than FLocalRequestsConstants::Exact.
// LOCAL_EMISSIVE: emissive triangles shine as lights do. Pixels choose one of them, or of them and all lights where these are many.
// LIGHT_MASK: a tile of many lights has rays to TILE_LIGHTS of them all the same, and pixels choose of the rest (MaskSlots.glsl).
// MASK_ALONE: nobody reads what pixels would choose.
// GUIDED: pixels choose from a table of their tile's lights (TileTable.glsl). Not defined: from all, which takes long.
#version 460
#include "../Tiles/Tile.glsl"
#include "TileRequests.glsl"
#include "LightBox.glsl"
#if defined(MANY_LIGHTS) && !defined(GUIDED)
#include "../Library/LightCells.glsl"
#endif

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FLocalRequestsConstants Push; };

const uint MaxCandidates = 32u; // lights whose ranges meet the tile; a tile of more has many

shared uint LowBits[3], HighBits[3]; // corners of the box of all surfaces in the tile, in an order that integers keep
shared uint EmitterCount; // clusters of emissive triangles that may light the tile
shared uint CandidateCount, Found[MaxCandidates], Candidates[MaxCandidates];
shared uint Reached[2u * MaxCandidates];
shared FTileLights Tile;

#ifdef GUIDED
#include "TileTable.glsl"
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
	return SharesChannel(Light, Point.Channels) && EstimateLight(Scene, Light, Point.P, Point.Horizon) > 0.0;
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

#ifdef LOCAL_EMISSIVE
// Counts clusters of emissive triangles that may light the tile.
void CountEmitters(FSceneConstants Scene, FViewConstants View, uint Place)
{
	vec3 Low = BoxCorner(LowBits), High = BoxCorner(HighBits);
	FTileSource Source = FindEmitterSource(Scene, View);
	[[dont_unroll]] for (uint I = Place; I < Source.Count; I += TILE_PIXELS)
	{
		if (Source.bDrawn || MayReachFromCluster(LoadCluster(Push.Emitters, SourceCluster(Source, I)), Low, High)) { atomicAdd(EmitterCount, 1u); }
	}
	barrier();
}
#endif

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
	Tile.bChooses = EmitterCount > 0u || Tile.Count != 0u ? 1u : 0u;
	for (uint I = 0u; I < 2u * TILE_CHOSEN_MOST; ++I) { Tile.Asking[I] = 0u; }
	Tile.Chose[0] = Tile.Chose[1] = 0u;
	for (uint I = 0u; I < 2u * TILE_LIGHTS; ++I) { Tile.Reached[I] = 0u; }
	if (Tile.Count != 0u) { return; }
	for (uint I = 0u; I < CandidateCount; ++I)
	{
		if ((Reached[2u * I] | Reached[2u * I + 1u]) == 0u) { continue; }
		if (Tile.Count == (Push.Limits & 0xffffu))
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

#if defined(MANY_LIGHTS) && !defined(GUIDED)
// Chooses a light with a probability proportional to EstimateLight, by weighted reservoir sampling over all that reach
// the pixel. Returns whether it asks for a ray.
bool ChooseLight(FSceneConstants Scene, FViewConstants View, FLocalPoint Point, uvec2 Pixel, out FLightChoice Choice)
{
	FLightRef Lights = FLightRef(Scene.Lights);
	float U = LocalNumbers(View, Pixel, 0xffffffffu).x, Total = 0.0, Chosen = 0.0;
	Choice = FLightChoice(0u, 0.0);
	FLightWalk Walk = WalkLights(Scene, Point.P, false); // the cells of all pixels are asked for
	for (uint I = NextLight(Walk); I < Scene.LightCount; I = NextLight(Walk))
	{
		float Weight = EstimateLight(Scene, Lights.Data[I], Point.P, Point.Horizon);
		if (Weight <= 0.0 || !SharesChannel(Lights.Data[I], Point.Channels)) { continue; }
		Total += Weight;
		float Probability = Weight / Total;
		bool bTake = U < Probability;
		U = bTake ? U / Probability : (U - Probability) / (1.0 - Probability);
		U = min(U, 0.99999994);
		if (bTake)
		{
			Choice.Light = I;
			Chosen = Weight;
		}
	}
	if (Chosen <= 0.0) { return false; }
	Choice.Weight = Total / Chosen;
#ifdef NO_CHOICE_WEIGHT // r.RT.Debug.Lights.Weight
	Choice.Weight = 1.0;
#endif
	return (Lights.Data[Choice.Light].Flags & LIGHT_CASTS_SHADOW) != 0u;
}
#endif

#ifdef LOCAL_EMISSIVE
const float DimEmitter = 1.0 / 256.0; // of white, as the picture is exposed

// Drops most choices of emitters that would hardly be seen, and lets the others stand for them: a dim flame far away shines on every
// pixel of the picture. The mean stays (Russian roulette, Arvo and Kirk 1990).
void DropDim(FViewConstants View, uvec2 Pixel, uint Which, inout FLightChoice Choice, inout FLobes Lit, inout bool bAsks)
{
	if (!bAsks || View.Exposure <= 0.0 || (Choice.Light & LIGHT_TRIANGLE) == 0u) { return; }
	float Kept = Luminance(Lit.Diffuse + Lit.Specular) * View.Exposure / DimEmitter;
	if (!(Kept < 1.0)) { return; }
	bAsks = LocalNumbers(View, Pixel, 0x7fffffffu - Which).x < Kept;
	float Scale = bAsks ? 1.0 / Kept : 0.0;
	Choice.Weight *= Scale;
	Lit.Diffuse *= Scale;
	Lit.Specular *= Scale;
}
#endif

#ifdef MANY_LIGHTS
#ifdef SPARSE
#include "../Library/Planes.glsl"

// Returns whether the pixel chooses a light in this frame: it has its turn, or no neighbour of its tile can stand for it. All threads.
bool Chooses(FViewConstants View, FLocalPoint Point, bool bSurface, uint Place)
{
	ivec2 InTile = ivec2(TilePixel(uvec2(0u), Place));
	SetPlane(RingPlace(InTile), false, vec3(0.0), vec3(0.0));
	if (bSurface) { SetPlane(RingPlace(InTile), true, Point.Surface.Relative, Point.Surface.Ng); }
	barrier();
	bool bChooses = bSurface && (HasTurn(View.FrameIndex, Place) || FindNeighbors(View, InTile, true) == 0u);
	if (bChooses) { atomicOr(Tile.Chose[Place >> 5u], 1u << (Place & 31u)); }
	return bChooses;
}
#endif

#ifdef MASK_ALONE
// What is drawn makes a table, so that the tile remembers lights for its mask. All threads.
void RememberForMask(FSceneConstants Scene, FViewConstants View, uint Place)
{
	bool bMade = bDrawnMask != 0u;
	if (bMade) { MakeTable(Scene, View, Place, BoxCorner(LowBits), BoxCorner(HighBits)); }
	WriteGuide(View, Place, bMade);
	barrier();
	if (Place == 0u) { Tile.bChooses = 0u; }
}
#else
// If the tile has many lights, or emissive triangles, each pixel chooses of them. All threads.
void ChooseOfMany(FSceneConstants Scene, FViewConstants View, FLocalPoint Point, bool bSurface, uvec2 Pixel, uint Place)
{
	bool bMany = Tile.bChooses != 0u, bAsks[CHOSEN_RAYS];
	FLightChoice Choices[CHOSEN_RAYS];
	for (uint I = 0u; I < CHOSEN_RAYS; ++I)
	{
		bAsks[I] = false;
		Choices[I] = FLightChoice(0u, 0.0);
	}
	uint Count = CountChosen(Tile);
	bool bChooses = bMany && bSurface;
#ifdef SPARSE
	if (ChoosesOfLights(Tile)) { bChooses = Chooses(View, Point, bSurface, Place); } // emitters alone: each pixel
#endif
#ifdef GUIDED
	FLobes Lit[CHOSEN_RAYS];
	for (uint I = 0u; I < CHOSEN_RAYS; ++I) { Lit[I] = FLobes(vec3(0.0), vec3(0.0)); }
	if (bMany)
	{
#ifndef LIGHT_MASK // which has done so
		PrepareTable(View, Point, bSurface, Place);
#endif
		MakeTable(Scene, View, Place, BoxCorner(LowBits), BoxCorner(HighBits));
	}
	WriteGuide(View, Place, bMany);
	if (bChooses)
	{
		float Reflected = 0.0;
#ifdef LOCAL_EMISSIVE
		Reflected = ReflectedRoughness(Push.Emitters);
#endif
		FLocalBrdf Local = LoadLocalBrdf(Point, Push.BaseColor, Push.Material, Pixel, Reflected);
		ChooseOfTable(Scene, View, Point, Local, Pixel, Count, Choices, Lit, bAsks);
#ifdef LOCAL_EMISSIVE
		for (uint I = 0u; I < CHOSEN_RAYS; ++I) { DropDim(View, Pixel, I, Choices[I], Lit[I], bAsks[I]); }
#endif
	}
#else
	if (bChooses) { bAsks[0] = ChooseLight(Scene, View, Point, Pixel, Choices[0]); }
#endif
	if (!bMany || IsOutsideView(View, Pixel)) { return; }
	for (uint I = 0u; I < CHOSEN_RAYS; ++I)
	{
		if (I >= Count) { break; }
		uint Index = ChoiceIndex(View, Pixel.y * View.Width + Pixel.x, I);
		FLightChoiceRef(Push.Choices).Data[Index] = Choices[I];
#ifdef GUIDED
		if (Push.Lit != FAddress(0)) { FLitPixelRef(Push.Lit).Data[Index].Lobes = PackLobes(Lit[I]); }
#endif
		// One ray answers for neighbouring choices of one light.
		bool bAnswered = I > 0u && bAsks[max(I, 1u) - 1u] && Choices[max(I, 1u) - 1u].Light == Choices[I].Light;
		if (bAsks[I] && !bAnswered) { atomicOr(Tile.Asking[2u * I + (Place >> 5u)], 1u << (Place & 31u)); }
	}
}
#endif
#endif

void Start(uint Place)
{
	if (Place < 3u)
	{
		LowBits[Place] = 0xffffffffu;
		HighBits[Place] = 0u;
	}
	Reached[Place] = 0u; // as many words as threads
	if (Place == 0u)
	{
		CandidateCount = EmitterCount = 0u;
		Tile.Count = 0u;
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
		Point = LoadLocalPoint(Scene, View, Push.Normals, Pixel, Depth);
#ifdef HAS_LIGHT_CHANNELS
		Point.Channels = LoadPixelChannels(Push.Channels, Pixel);
#endif
		for (uint Axis = 0u; Axis < 3u; ++Axis)
		{
			atomicMin(LowBits[Axis], ToOrdered(Point.P[Axis]));
			atomicMax(HighBits[Axis], ToOrdered(Point.P[Axis]));
		}
	}
	barrier();
	bool bEmpty = HighBits[0] < LowBits[0]; // nothing but sky
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
