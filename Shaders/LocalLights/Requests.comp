// Finds the lights of a tile, and queues their rays: for all of its lights if they are few, else for one that each pixel chooses.
// MANY_LIGHTS: defined if the scene has more lights than FLocalRequestsConstants::Exact.
// LOCAL_EMISSIVE: emissive triangles shine as lights do. Pixels choose one of them, or of them and all lights where these are many.
// GUIDED: pixels choose from a table of their tile's lights (TileTable.glsl). Not defined: from all, which takes long.
#version 460
#include "../Rays/RayQueue.glsl"
#include "../Tiles/Tile.glsl"
#include "LocalPoint.glsl"
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
shared uint FirstRequest;

uint ToOrdered(float F)
{
	uint Bits = floatBitsToUint(F);
	return (Bits & 0x80000000u) != 0u ? ~Bits : Bits | 0x80000000u;
}
float FromOrdered(uint Bits) { return uintBitsToFloat((Bits & 0x80000000u) != 0u ? Bits & 0x7fffffffu : ~Bits); }
vec3 BoxCorner(uint Bits[3]) { return vec3(FromOrdered(Bits[0]), FromOrdered(Bits[1]), FromOrdered(Bits[2])); }

// Whether the light may reach a box: its range does, and its cone a sphere around the box.
bool MayReach(FSceneConstants Scene, FLightData Light, vec3 Low, vec3 High)
{
	if (LightType(Light) == LIGHT_NONE) { return false; }
	if (LightType(Light) == LIGHT_DIRECTIONAL) { return true; }
	vec3 Center = LightPosition(Scene, Light);
	vec3 Outside = max(max(Low - Center, Center - High), vec3(0.0));
	if (Light.Range > 0.0 && dot(Outside, Outside) >= Light.Range * Light.Range) { return false; }
	if ((Light.Flags & LIGHT_HAS_CONE) == 0u) { return true; }
	float Cosine = -Light.SpotOffset / Light.SpotScale; // of the angle at which it is dark
	if (Cosine <= 0.0) { return true; }
	vec3 To = 0.5 * (Low + High) - Center;
	float Along = dot(To, UnpackOct(Light.Direction)), Across = sqrt(max(dot(To, To) - Along * Along, 0.0));
	float Radius = 0.5 * length(High - Low) * 1.001 + 1.0e-3;
	return Cosine * Across - sqrt(max(1.0 - Cosine * Cosine, 0.0)) * Along < Radius && Along > -Radius;
}

#ifdef GUIDED
#include "TileTable.glsl"
#endif

// Finds lights whose ranges meet the tile. Their order does not depend on that of threads.
void FindCandidates(FSceneConstants Scene, uint Place)
{
	vec3 Low = BoxCorner(LowBits), High = BoxCorner(HighBits);
	FLightRef Lights = FLightRef(Scene.Lights);
	for (uint I = Place; I < Scene.LightCount; I += TILE_PIXELS)
	{
		if (!MayReach(Scene, Lights.Data[I], Low, High)) { continue; }
		uint Number = atomicAdd(CandidateCount, 1u);
		if (Number < MaxCandidates) { Found[Number] = I; }
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
void CountEmitters(FSceneConstants Scene, uint Place)
{
	vec3 Low = BoxCorner(LowBits), High = BoxCorner(HighBits);
	for (uint I = Place; I < Scene.EmissiveClusterCount; I += TILE_PIXELS)
	{
		if (MayReachFromCluster(LoadCluster(I), Low, High)) { atomicAdd(EmitterCount, 1u); }
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
		if (EstimateLight(Scene, Lights.Data[Candidates[I]], Point.P, Point.Horizon) <= 0.0) { continue; }
		atomicOr(Reached[2u * I + (Place >> 5u)], 1u << (Place & 31u));
	}
}

// Keeps the candidates that some pixel is lit by. One thread.
void ListLights(FSceneConstants Scene)
{
	Tile.Count = CandidateCount > MaxCandidates ? TILE_LIGHTS_MANY : 0u;
	Tile.bChooses = EmitterCount > 0u || Tile.Count != 0u ? 1u : 0u;
	Tile.Asking[0] = Tile.Asking[1] = 0u;
	for (uint I = 0u; I < 2u * TILE_LIGHTS; ++I) { Tile.Reached[I] = 0u; }
	if (Tile.Count != 0u) { return; }
	for (uint I = 0u; I < CandidateCount; ++I)
	{
		if ((Reached[2u * I] | Reached[2u * I + 1u]) == 0u) { continue; }
		if (Tile.Count == Push.Exact)
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
		if (Weight <= 0.0) { continue; }
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

#ifdef MANY_LIGHTS
// If the tile has many lights, or emissive triangles, each pixel chooses one. All threads.
void ChooseOfMany(FSceneConstants Scene, FViewConstants View, FLocalPoint Point, bool bSurface, uvec2 Pixel, uint Place)
{
	bool bMany = Tile.bChooses != 0u, bAsks = false;
	FLightChoice Choice = FLightChoice(0u, 0.0);
#ifdef GUIDED
	FLobes Lit = FLobes(vec3(0.0), vec3(0.0));
	if (bMany)
	{
		ChooseSamplers(View, Point, bSurface, Place);
		if (Place == 0u) { FindPreviousTile(View, gl_WorkGroupID.xy); }
		barrier();
		LoadRemembered(View, Place);
		MakeTable(Scene, View, Place, BoxCorner(LowBits), BoxCorner(HighBits));
	}
	WriteGuide(View, Place, bMany);
	if (bMany && bSurface)
	{
		FLocalBrdf Local = LoadLocalBrdf(Point, Push.BaseColor, Push.Material, Pixel, Push.ReflectedRoughness);
		bAsks = ChooseOfTable(Scene, View, Point, Local, Pixel, Choice, Lit);
	}
#else
	if (bMany && bSurface) { bAsks = ChooseLight(Scene, View, Point, Pixel, Choice); }
#endif
	if (!bMany || IsOutsideView(View, Pixel)) { return; }
	if (bAsks) { atomicOr(Tile.Asking[Place >> 5u], 1u << (Place & 31u)); }
	uint Index = Pixel.y * View.Width + Pixel.x;
	FLightChoiceRef(Push.Choices).Data[Index] = Choice;
#ifdef GUIDED
	if (Push.Lit != FAddress(0)) { FLitPixelRef(Push.Lit).Data[Index].Lobes = PackLobes(Lit); }
#endif
}
#endif

// Reserves room for all rays of the tile at once. One thread.
void Reserve()
{
	uint Count = bitCount(Tile.Asking[0]) + bitCount(Tile.Asking[1]), Slots = Tile.Count == TILE_LIGHTS_MANY ? 0u : Tile.Count;
	for (uint I = 0u; I < Slots; ++I)
	{
		bool bUnshadowed = (Tile.Lights[I] & TILE_LIGHT_UNSHADOWED) != 0u;
		Count += bUnshadowed ? 0u : bitCount(Tile.Reached[2u * I]) + bitCount(Tile.Reached[2u * I + 1u]);
	}
	if (Count == 0u) { return; }
	FRayQueueCountersRef Counters = FRayQueueCountersRef(Push.Counters);
	FirstRequest = SegmentEnd(Counters.Data, RAY_SEGMENT_LOCAL - 1u, Push.Capacity);
	FirstRequest += atomicAdd(Counters.Data.Segments[RAY_SEGMENT_LOCAL].Wanted, Count);
	GrowLaunch(Push.Counters, min(FirstRequest + Count, Push.Capacity));
}

// Writes the pixel's request if it is among those of 64 bits. First: number of their first one, and of the first behind them.
void WriteRequest(uint Low, uint High, uint Kind, uint Slot, uint Place, uint PixelIndex, inout uint First)
{
	uint Mine = Place < 32u ? Low : High, Bit = 1u << (Place & 31u);
	uint Number = First + bitCount(Mine & (Bit - 1u)) + (Place < 32u ? 0u : bitCount(Low));
	if ((Mine & Bit) != 0u && Number < Push.Capacity)
	{
		FRayRequestRef(Push.Requests).Data[Number] = MakeRayRequest(Kind, Slot, PixelIndex);
	}
	First += bitCount(Low) + bitCount(High);
}

// Writes the pixel's requests, light by light: rays to one light then start close to each other.
void WriteRequests(uint Place, uint PixelIndex)
{
	uint First = FirstRequest, Slots = Tile.Count == TILE_LIGHTS_MANY ? 0u : Tile.Count;
	for (uint I = 0u; I < Slots; ++I)
	{
		if ((Tile.Lights[I] & TILE_LIGHT_UNSHADOWED) != 0u) { continue; }
		WriteRequest(Tile.Reached[2u * I], Tile.Reached[2u * I + 1u], RAY_KIND_LOCAL, I, Place, PixelIndex, First);
	}
	WriteRequest(Tile.Asking[0], Tile.Asking[1], RAY_KIND_CHOSEN, 0u, Place, PixelIndex, First);
}

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
		for (uint Axis = 0u; Axis < 3u; ++Axis)
		{
			atomicMin(LowBits[Axis], ToOrdered(Point.P[Axis]));
			atomicMax(HighBits[Axis], ToOrdered(Point.P[Axis]));
		}
	}
	barrier();
	bool bEmpty = HighBits[0] < LowBits[0]; // nothing but sky
	if (!bEmpty) { FindCandidates(Scene, Place); }
#ifdef LOCAL_EMISSIVE
	if (!bEmpty) { CountEmitters(Scene, Place); }
#endif
	barrier();
	if (bSurface && CandidateCount <= MaxCandidates) { MarkReached(Scene, Point, Place); }
	barrier();
	if (Place == 0u) { ListLights(Scene); }
	barrier();
#ifdef MANY_LIGHTS
	ChooseOfMany(Scene, View, Point, bSurface, Pixel, Place);
	barrier();
#endif
	if (Place == 0u)
	{
		Reserve();
		FTileLightsRef(Push.TileLights).Data[TileIndex(View, gl_WorkGroupID.xy)] = Tile;
	}
	barrier();
	WriteRequests(Place, PixelIndex);
}
