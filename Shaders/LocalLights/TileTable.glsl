// The lights that may reach a tile of many, with the weight that each has for the tile's pixels. A work group makes it.
// The weight is positive for every light that brings anything to a pixel of the tile, so that what pixels choose from it has no bias.
#ifndef LANTERN_TILE_TABLE_GLSL
#define LANTERN_TILE_TABLE_GLSL

#include "../Library/Motion.glsl"
#include "Guide.glsl"
#include "LightBox.glsl"
#include "Regions.glsl"

const uint TileSamplers = 4u; // pixels that weights are made for
const float BoundShare = 0.5; // of the weight of a sampler: what bounds weigh
const float LeastVisibility = 0.05; // that is expected: a hidden light is asked less often, but never never

shared float Cumulative[TILE_TABLE_MOST]; // sum of the weights up to and with a light's
shared uint TableEntries[TILE_TABLE_MOST]; // light, and its expected visibility in the highest 8 bits
shared float TableStands[TILE_TABLE_MOST]; // see FLightRegion::Stands
shared uint Estimates[TILE_TABLE_MOST]; // of what each sampler receives, a byte each
shared float Totals[TileSamplers + 1u][TILE_PIXELS]; // over the run of each thread: of samplers, and of bounds
shared float RunSums[TILE_PIXELS];
shared uint TableCount;
shared uint SamplerKeys[TileSamplers]; // 0: there is no surface; else the lowest byte is the place
shared vec3 SamplerP[TileSamplers], SamplerN[TileSamplers];
#ifdef HAS_LIGHT_CHANNELS
shared uint SamplerChannels[TileSamplers];
#endif
#ifdef BACK_PIXELS
shared bool bSamplerBack[TileSamplers]; // see FGBufferPoint::bBack
#endif
shared float SamplerReach[TileSamplers]; // metres: how far the pixels may lie from it that it stands for
shared uvec2 PreviousTile; // x = NoTile: none
shared FGuideLight Remembered[TILE_GUIDE_LIGHTS]; // of PreviousTile
shared uint RememberedTraced, RememberedSeen;
shared uint GuideKeys[TILE_GUIDE_LIGHTS];

#ifdef LIGHT_MASK
shared uint bDrawnMask; // the lights of the tile's mask are of those that it remembers

bool IsInMask(uint Light)
{
	bool bFound = false;
	for (uint I = 0u; I < TILE_LIGHTS; ++I) { bFound = bFound || (Tile.Lights[I] & ~TILE_LIGHT_UNSHADOWED) == Light; }
	return bFound && ChoosesOfLights(Tile);
}
#endif

const uint NoTile = 0xffffffffu, NoGuideLight = 0xffffffffu;

#ifdef LOCAL_EMISSIVE
#include "EmitterTable.glsl"
#endif

uint EntryLight(uint Entry) { return Entry & ((1u << LIGHT_INDEX_BITS) - 1u); }
float EntryVisibility(uint Entry) { return float(Entry >> LIGHT_INDEX_BITS) / 255.0; }

// Returns a number by which samplers change from frame to frame. Those that rank the lights of a mask do not, so that these stay.
uint SamplerTurn(FViewConstants View)
{
#ifdef LIGHT_MASK
	return 0u;
#else
	return View.FrameIndex;
#endif
}

// Chooses a pixel of each quarter of the tile, another one in each frame.
void ChooseSamplers(FViewConstants View, FLocalPoint Point, bool bSurface, uint Place)
{
	if (Place < TileSamplers) { SamplerKeys[Place] = 0u; }
	barrier();
	const uint Pixels = TILE_PIXELS / TileSamplers;
	uint Mine = Place / Pixels, Turn = Pixels | ((Place ^ (SamplerTurn(View) * 3u)) % Pixels);
	if (bSurface) { atomicMax(SamplerKeys[Mine], (Turn << 8u) | Place); }
	if ((Place & 1u) == (View.FrameIndex & 1u))
	{
		float Size = bSurface ? PixelHeight(View, length(Point.Surface.Relative)) : 0.0;
		BoxSamples[Place >> 1u] = bSurface ? vec4(Point.P, Size) : vec4(0.0);
	}
	barrier();
	if (bSurface && (SamplerKeys[Mine] & 255u) == Place)
	{
		SamplerP[Mine] = Point.P;
		SamplerN[Mine] = Point.Surface.BentN;
#ifdef HAS_LIGHT_CHANNELS
		SamplerChannels[Mine] = Point.Channels;
#endif
#ifdef BACK_PIXELS
		bSamplerBack[Mine] = Point.Surface.bBack;
#endif
		float Distance = length(Point.Surface.Relative), Cosine = max(abs(dot(Point.Surface.Ng, Point.Surface.V)), 0.1);
		SamplerReach[Mine] = 2.5 * PixelHeight(View, Distance) / Cosine;
	}
	barrier();
}

uint PreviousGuidePlace() { return (Push.Limits >> 8u) & 0xffu; }

// Finds the tile of the previous frame that showed a point of this one, as if nothing but the camera had moved. One thread. Place: of the
// pixel that shows the point.
void FindPreviousTile(FViewConstants View, uvec2 Tile, uint Place, vec3 P)
{
	PreviousTile = uvec2(NoTile);
	if (PreviousGuidePlace() == PREVIOUS_GUIDE_NONE) { return; }
	vec3 Relative = P - View.CameraPosition;
	vec3 Motion = ComputeMotion(View, Relative, Relative + View.CameraMotion);
	vec2 Previous = vec2(TilePixel(Tile, Place)) + 0.5 + Motion.xy;
	if (Motion.z > 0.0 && all(greaterThanEqual(Previous, vec2(0.0))) && all(lessThan(Previous, vec2(View.Width, View.Height))))
	{
		PreviousTile = uvec2(Previous) / TILE_SIZE;
	}
}

// Returns the address of FTileGuide[] of the previous frame, if there is one.
FAddress PreviousGuide(FViewConstants View)
{
	const uint SizeOfGuide = 8u * TILE_GUIDE_LIGHTS;
	FAddress Bytes = FAddress(TileIndex(View, uvec2(0u, (View.Height + TILE_SIZE - 1u) / TILE_SIZE))) * SizeOfGuide;
	return PreviousGuidePlace() == PREVIOUS_GUIDE_BEFORE ? Push.Guide - Bytes : Push.Guide + Bytes;
}

void LoadRemembered(FViewConstants View, uint Place)
{
	if (Place == 0u) { RememberedTraced = RememberedSeen = 0u; }
	barrier();
	if (Place < TILE_GUIDE_LIGHTS)
	{
		Remembered[Place] = FGuideLight(NoGuideLight, 0u);
		GuideKeys[Place] = 0u;
		if (PreviousTile.x != NoTile)
		{
			FGuideLight Light = FTileGuideRef(PreviousGuide(View)).Data[TileIndex(View, PreviousTile)].Lights[Place];
			Remembered[Place] = Light;
			atomicAdd(RememberedTraced, GuideTraced(Light.Counts));
			atomicAdd(RememberedSeen, GuideSeen(Light.Counts));
		}
	}
	barrier();
}

// What the table needs before it is made. All threads.
void PrepareTable(FViewConstants View, FLocalPoint Point, bool bSurface, uint Place)
{
	ChooseSamplers(View, Point, bSurface, Place);
	if (Place == 0u)
	{
		uint First = 0u;
		while (First < TileSamplers - 1u && SamplerKeys[First] == 0u) { ++First; }
		PreviousTile = uvec2(NoTile);
		if (SamplerKeys[First] != 0u) { FindPreviousTile(View, GROUP_TILE, SamplerKeys[First] & 255u, SamplerP[First]); }
	}
	barrier();
	LoadRemembered(View, Place);
}

// Returns what the guides of the tile and of those around it know: rays traced, and rays that got through.
vec2 RecallRays(FViewConstants View, uint Light)
{
	vec2 Rays = vec2(0.0);
	if (PreviousTile.x == NoTile) { return Rays; }
	ivec2 Last = ivec2((uvec2(View.Width, View.Height) - 1u) / TILE_SIZE);
	[[dont_unroll]] for (int I = 0; I < 9; ++I)
	{
		ivec2 Tile = ivec2(PreviousTile) + ivec2(I % 3, I / 3) - 1;
		if (any(lessThan(Tile, ivec2(0))) || any(greaterThan(Tile, Last))) { continue; }
		uint Index = TileIndex(View, uvec2(Tile));
		FGuideLight Found = FTileGuideRef(PreviousGuide(View)).Data[Index].Lights[GuidePlace(Light, GuideTileHash(Index))];
		if (Found.Light == Light) { Rays += vec2(GuideTraced(Found.Counts), GuideSeen(Found.Counts)) * (I == 4 ? 1.0 : 0.25); }
	}
	return Rays / float(TILE_GUIDE_RAY);
}

float ExpectVisibility(FViewConstants View, uint Light)
{
	const float Doubts = 2.0; // rays that what is unknown counts as
	vec2 All = (vec2(RememberedTraced, RememberedSeen) / float(TILE_GUIDE_RAY)) + vec2(8.0, 4.0);
	vec2 Rays = RecallRays(View, Light) + Doubts * vec2(1.0, All.y / All.x);
	return Rays.y / Rays.x;
}

// A byte for a positive number of any size: some bits of its exponent, and two of what follows. 0 stays 0.
const uint EstimateShift = 21u, LeastEstimate = (127u - 40u) << 2u;
uint PackEstimate(float Estimate)
{
	return Estimate > 0.0 ? uint(clamp(int(floatBitsToUint(Estimate) >> EstimateShift) - int(LeastEstimate), 1, 255)) : 0u;
}
float UnpackEstimate(uint Packed) { return Packed > 0u ? uintBitsToFloat((Packed + LeastEstimate) << EstimateShift) : 0.0; }
float UnpackEstimate(uint Packed, uint I) { return UnpackEstimate((Packed >> (8u * I)) & 255u); }

// Returns about what the pixels that a sampler stands for receive of a light.
float EstimateAround(FSceneConstants Scene, FLightData Light, uint I)
{
	if (SamplerKeys[I] == 0u) { return 0.0; }
#ifdef HAS_LIGHT_CHANNELS
	if (!SharesChannel(Light, SamplerChannels[I])) { return 0.0; }
#endif
	vec3 N = SamplerN[I];
	float Estimate = EstimateLight(Scene, Light, SamplerP[I], N);
#ifdef BACK_PIXELS
	if (Estimate <= 0.0 && bSamplerBack[I])
	{
		N = -N;
		Estimate = EstimateLight(Scene, Light, SamplerP[I], N);
	}
#endif
	if (Estimate <= 0.0 || LightType(Light) == LIGHT_DIRECTIONAL) { return Estimate; }
	vec3 To = LightPosition(Scene, Light) - SamplerP[I];
	float Distance = max(length(To), 1.0e-4), Closest = max(Distance - SamplerReach[I], 0.3 * SamplerReach[I]);
	float Cosine = clamp((dot(To, N) + SamplerReach[I]) / Distance, 0.1, 1.0), Nearer = max(Distance / Closest, 1.0);
	return Estimate * (Cosine * Nearer * Nearer);
}

// Returns what each sampler receives, a byte each. OutBound: about the most that any pixel does.
uint EstimateEntry(FSceneConstants Scene, uint Entry, vec3 Low, vec3 High, out float OutBound)
{
	uint Packed = 0u;
#ifdef LOCAL_EMISSIVE
	if (IsTriangle(Entry))
	{
		FEmitterCluster Cluster = LoadCluster(Push.Emitters, Entry);
		OutBound = min(BoundCluster(Cluster, Low, High), 1.0e30);
		[[dont_unroll]] for (uint S = 0u; S < TileSamplers; ++S)
		{
			float Estimate = SamplerKeys[S] != 0u ? EstimateCluster(Cluster, SamplerP[S], SamplerN[S], SamplerReach[S]) : 0.0;
#ifdef BACK_PIXELS
			if (SamplerKeys[S] != 0u && bSamplerBack[S]) { Estimate = max(Estimate, EstimateCluster(Cluster, SamplerP[S], -SamplerN[S], SamplerReach[S])); }
#endif
			Packed |= PackEstimate(Estimate) << (8u * S);
		}
		return Packed;
	}
#endif
	FLightData Light = FLightRef(Scene.Lights).Data[Entry];
	OutBound = min(BoundLight(Scene, Light, Low, High), 1.0e30);
	[[dont_unroll]] for (uint S = 0u; S < TileSamplers; ++S) { Packed |= PackEstimate(EstimateAround(Scene, Light, S)) << (8u * S); }
	return Packed;
}

#include "TileSources.glsl"

// Fills RunSums with the sums over each thread and those before it, by doubling steps (Hillis and Steele 1986). All threads.
void SumUpTo(uint Place, float Mine)
{
	RunSums[Place] = Mine;
	barrier();
	[[dont_unroll]] for (uint Step = 1u; Step < TILE_PIXELS; Step <<= 1u)
	{
		float Before = Place >= Step ? RunSums[Place - Step] : 0.0;
		barrier();
		RunSums[Place] += Before;
		barrier();
	}
}

// Lists the table's lights. Their order does not depend on that of threads.
void ListTable(FSceneConstants Scene, FViewConstants View, uint Place, vec3 Low, vec3 High)
{
	FTableSources Sources = FindSources(Scene, View);
	uint Most = CountProposals(Sources), Found = 0u; // Found: a bit for each of the thread's proposals
	float Stands;
	[[dont_unroll]] for (uint I = Place, Bit = 1u; I < Most; I += TILE_PIXELS, Bit <<= 1u)
	{
		uint Light = ProposeLight(Scene, View, Sources, I, Stands);
		if (Light != NoGuideLight && MayReachEntry(Scene, Light, Low, High)) { Found |= Bit; }
	}
	SumUpTo(Place, float(bitCount(Found)));
	uint Before = Place > 0u ? uint(RunSums[Place - 1u]) : 0u;
	[[dont_unroll]] for (uint I = Place, Bit = 1u; I < Most && Before < TILE_TABLE_MOST; I += TILE_PIXELS, Bit <<= 1u)
	{
		if ((Found & Bit) == 0u) { continue; }
		uint Light = ProposeLight(Scene, View, Sources, I, Stands);
#ifdef LIGHT_MASK
		if (IsInMask(Light)) { Stands = 0.0; } // never chosen
#endif
		TableEntries[Before] = Light;
		TableStands[Before++] = Stands;
	}
	if (Place == 0u) { TableCount = min(uint(RunSums[TILE_PIXELS - 1u]), TILE_TABLE_MOST); }
	barrier();
}

// The entries of the table that a thread works on.
struct FRun
{
	uint Begin, End;
};

// Estimates what lights bring, and adds it up. Cumulative[] gets their bounds.
void EstimateLights(FSceneConstants Scene, FViewConstants View, FRun Run, uint Place, vec3 Low, vec3 High)
{
	[[dont_unroll]] for (uint S = 0u; S <= TileSamplers; ++S) { Totals[S][Place] = 0.0; }
	[[dont_unroll]] for (uint I = Run.Begin; I < Run.End; ++I)
	{
		uint Light = TableEntries[I];
		float Visibility = CastsShadow(Scene, Light) ? max(ExpectVisibility(View, Light), LeastVisibility) : 1.0;
		uint Packed = EstimateEntry(Scene, Light, Low, High, Cumulative[I]);
		[[dont_unroll]] for (uint S = 0u; S < TileSamplers; ++S)
		{
			Totals[S][Place] += UnpackEstimate(Packed, S) * (Visibility * TableStands[I]);
		}
		Totals[TileSamplers][Place] += Cumulative[I] * (Visibility * TableStands[I]);
		Estimates[I] = Packed;
		TableEntries[I] = Light | (uint(Visibility * 255.0 + 0.5) << LIGHT_INDEX_BITS);
	}
	barrier();
	[[dont_unroll]] for (uint Half = TILE_PIXELS / 2u; Half > 0u; Half >>= 1u)
	{
		[[dont_unroll]] for (uint S = 0u; S <= TileSamplers && Place < Half; ++S) { Totals[S][Place] += Totals[S][Place + Half]; }
		barrier();
	}
}

// Weighs lights: each sampler has the same say, however dark it is there, and so have bounds a part of it. Proposes lights for the
// tile's guide.
float WeighLights(FSceneConstants Scene, FRun Run, uint TileHash)
{
	float Sum = 0.0, BoundScale = BoundShare / max(Totals[TileSamplers][0], 1.0e-30);
	[[dont_unroll]] for (uint I = Run.Begin; I < Run.End; ++I)
	{
		float Bound = Cumulative[I] * BoundScale, Weight = Bound;
		uint Packed = Estimates[I];
#ifdef ONE_SAMPLER // r.RT.Debug.Lights.CellTarget
		Weight = UnpackEstimate(Packed, 0u);
#else
		[[dont_unroll]] for (uint S = 0u; S < TileSamplers; ++S)
		{
			Weight += Totals[S][0] > 0.0 ? UnpackEstimate(Packed, S) / Totals[S][0] : 0.0;
		}
#endif
		uint Entry = TableEntries[I], Light = EntryLight(Entry);
		float Visibility = EntryVisibility(Entry);
		bool bProposed = Weight > 0.0 && CastsShadow(Scene, Light);
#ifdef LIGHT_MASK
		bProposed = bProposed && (TableStands[I] > 0.0 || bDrawnMask != 0u); // where lists are drawn, what the mask holds is found by memory
#endif
		if (bProposed)
		{
			atomicMax(GuideKeys[GuidePlace(Light, TileHash)], (floatBitsToUint(Weight * max(Visibility, 0.25)) & ~(TILE_TABLE_MOST - 1u)) | I);
		}
		Sum += Weight * Visibility * TableStands[I];
		Cumulative[I] = Sum;
	}
	return Sum;
}

// Fills the table, and proposes lights for the tile's guide.
void MakeTable(FSceneConstants Scene, FViewConstants View, uint Place, vec3 Low, vec3 High)
{
	ListTable(Scene, View, Place, Low, High);
	uint Length = (TableCount + TILE_PIXELS - 1u) / TILE_PIXELS, Begin = min(Place * Length, TableCount);
	FRun Run = FRun(Begin, min(Begin + Length, TableCount));
	EstimateLights(Scene, View, Run, Place, Low, High);
	SumUpTo(Place, WeighLights(Scene, Run, GuideTileHash(TileIndex(View, GROUP_TILE))));
	float Before = Place > 0u ? RunSums[Place - 1u] : 0.0;
	[[dont_unroll]] for (uint I = Run.Begin; I < Run.End; ++I) { Cumulative[I] += Before; }
	barrier();
}

// Writes the tile's guide without this frame's rays, which the shading adds. bMade: there is a table.
void WriteGuide(FViewConstants View, uint Place, bool bMade)
{
	if (Place >= TILE_GUIDE_LIGHTS) { return; }
	FGuideLight Out = FGuideLight(NoGuideLight, 0u);
	if (bMade && all(equal(PreviousTile, GROUP_TILE))) // a lamp that is dark now may shine again
	{
		uint Counts = Remembered[Place].Counts;
		Out = FGuideLight(Remembered[Place].Light, PackGuideCounts(float(GuideTraced(Counts)) * Push.GuideKept, float(GuideSeen(Counts)) * Push.GuideKept));
	}
	if (bMade && GuideKeys[Place] != 0u)
	{
		Out.Light = EntryLight(TableEntries[GuideKeys[Place] & (TILE_TABLE_MOST - 1u)]);
		vec2 Rays = vec2(0.0);
		if (IsRemembered(View, Out.Light))
		{
			uint Counts = Remembered[GuidePlace(Out.Light, GuideTileHash(TileIndex(View, PreviousTile)))].Counts;
			Rays = vec2(GuideTraced(Counts), GuideSeen(Counts)) * Push.GuideKept;
		}
		else
		{
			Rays = RecallRays(View, Out.Light); // of others: less certain
			Rays *= float(TILE_GUIDE_RAY) * min(1.0, 4.0 / max(Rays.x, 1.0e-3));
		}
		Out.Counts = PackGuideCounts(Rays.x, Rays.y);
	}
	FTileGuideRef(Push.Guide).Data[TileIndex(View, GROUP_TILE)].Lights[Place] = Out;
}

// Keeps what the tile remembers in a frame without a table. All threads, behind LoadRemembered.
void CarryGuide(FViewConstants View, uint Place)
{
	uint Index = TileIndex(View, GROUP_TILE);
	bool bMine = Place < TILE_GUIDE_LIGHTS;
	if (bMine && Remembered[Place].Light != NoGuideLight)
	{
		uint Key = (GuideTraced(Remembered[Place].Counts) << 8u) | (Place + 1u);
		atomicMax(GuideKeys[GuidePlace(Remembered[Place].Light, GuideTileHash(Index))], Key);
	}
	barrier();
	if (!bMine) { return; }
	FGuideLight Out = FGuideLight(NoGuideLight, 0u);
	if (GuideKeys[Place] != 0u)
	{
		FGuideLight Kept = Remembered[(GuideKeys[Place] & 255u) - 1u];
		vec2 Rays = vec2(GuideTraced(Kept.Counts), GuideSeen(Kept.Counts)) * Push.GuideKept;
		Out = FGuideLight(Kept.Light, PackGuideCounts(Rays.x, Rays.y));
	}
	FTileGuideRef(Push.Guide).Data[Index].Lights[Place] = Out;
}

// Returns the first entry whose cumulative weight exceeds X.
uint FindEntry(float X)
{
	uint First = 0u, Last = TableCount - 1u;
	while (First < Last)
	{
		uint Middle = (First + Last) >> 1u;
		if (Cumulative[Middle] > X) { Last = Middle; }
		else { First = Middle + 1u; }
	}
	return First;
}

// Returns the lobes with the luminance of Chosen · Weight in each, and with the colour of Mean.
FLobes WeighLobes(FLobes Mean, FLobes Chosen, float Weight)
{
	Mean.Diffuse *= Weight * Luminance(Chosen.Diffuse) / max(Luminance(Mean.Diffuse), 1.0e-30);
	Mean.Specular *= Weight * Luminance(Chosen.Specular) / max(Luminance(Mean.Specular), 1.0e-30);
	return Mean;
}

uint MostCandidates() { return Push.Limits >> 16u; }

// Chooses lights of the table by what they are expected to bring.
// Candidates: how many each looks at, from 1 to MostCandidates().
// Count: how many, at most CHOSEN_RAYS.
// Choices: each alone stands for all of the light.
// Lit: what the pixel reflects if the light is visible. It has the luminance of the chosen light, without bias, and the mean colour of
// all candidates, which are many and have less noise.
// bAsks: whether it asks for a ray.
// Resampled importance sampling (Talbot et al. 2005) of stratified candidates. Choices are stratified, too.
void ChooseOfTable(FSceneConstants Scene, FViewConstants View, FLocalPoint Point, FLocalBrdf Local, uvec2 Pixel, uint Candidates, uint Count,
                   inout FLightChoice Choices[CHOSEN_RAYS], out FLobes Lit[CHOSEN_RAYS], inout bool bAsks[CHOSEN_RAYS])
{
	float All = TableCount > 0u ? Cumulative[TableCount - 1u] : 0.0, Target[CHOSEN_RAYS], Which[CHOSEN_RAYS], Total = 0.0;
	vec2 U = LocalNumbers(View, Pixel, 0xffffffffu);
	FLobes Mean = FLobes(vec3(0.0), vec3(0.0)), Chosen[CHOSEN_RAYS];
	for (uint C = 0u; C < CHOSEN_RAYS; ++C)
	{
		Target[C] = 0.0;
		Which[C] = (float(C) + U.y) / float(Count);
		Lit[C] = Chosen[C] = Mean;
	}
	[[dont_unroll]] for (uint I = 0u; I < Candidates && All > 0.0; ++I)
	{
		float At = (float(I) + U.x) / float(Candidates) * All, Chance = 1.0;
		uint Number = FindEntry(At), Entry = TableEntries[Number], Light = EntryLight(Entry);
		float Below = Number > 0u ? Cumulative[Number - 1u] : 0.0, Weight = Cumulative[Number] - Below;
		if (Weight <= 0.0) { continue; }
#ifdef LOCAL_EMISSIVE
		if (IsTriangle(Light))
		{
			float In = clamp((At - Below) / Weight, 0.0, 0.99999994);
			Light = ChooseTriangle(Scene, LoadCluster(Push.Emitters, Light), In, Chance) | LIGHT_TRIANGLE;
		}
		if (Chance <= 0.0) { continue; }
#endif
		FLightSample Sample = SampleLocalLight(Scene, View, Point, Pixel, Light, 0u);
		if (!ReachesLight(View, Point, Sample)) { continue; }
		FLobes Lobes = ReflectLight(Point, Local, Sample, Light);
		// Times the inverse of the density with which the light came here, over all candidates.
		float Visibility = EntryVisibility(Entry), Stands = Visibility * TableStands[Number] * All / (Weight * Chance * float(Candidates));
		Mean.Diffuse += Lobes.Diffuse * Stands;
		Mean.Specular += Lobes.Specular * Stands;
		float Brightness = Luminance(Lobes.Diffuse + Lobes.Specular), Mine = Brightness * Stands;
		if (Mine <= 0.0) { continue; }
		Total += Mine;
		float Probability = Mine / Total;
		for (uint C = 0u; C < CHOSEN_RAYS; ++C)
		{
			bool bTake = Which[C] < Probability;
			Which[C] = min(bTake ? Which[C] / Probability : (Which[C] - Probability) / (1.0 - Probability), 0.99999994);
			if (!bTake) { continue; }
			Choices[C].Light = Light;
			Chosen[C] = Lobes;
			Target[C] = Brightness * Visibility;
		}
	}
	for (uint C = 0u; C < CHOSEN_RAYS; ++C)
	{
		if (C >= Count || Target[C] <= 0.0) { continue; }
		Choices[C].Weight = Total / Target[C];
#ifdef NO_CHOICE_WEIGHT // r.RT.Debug.Lights.Weight
		Choices[C].Weight = 1.0;
#endif
		Lit[C] = WeighLobes(Mean, Chosen[C], Choices[C].Weight);
		bAsks[C] = CastsShadow(Scene, Choices[C].Light);
	}
}

#endif
