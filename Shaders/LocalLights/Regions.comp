// Lists the lights that may reach a region of the screen, for its tiles. If they are too many, it draws some of them with probabilities
// by what they may bring, as "Rendering Many Lights with Grid-Based Reservoirs" (Boksansky et al. 2021) does for cells of the world.
// A work group makes a region's list. Its order does not depend on that of threads.
// EMITTERS: the same of clusters of emissive triangles.
#version 460
#include "../Tiles/Tile.glsl"
#include "LightBox.glsl"
#include "LocalPoint.glsl"
#include "Regions.glsl"
#ifdef EMITTERS
#include "EmitterTable.glsl"
#endif

layout(local_size_x = REGION_THREADS) in;
layout(push_constant, scalar) uniform FPush { FLightRegionsConstants Push; };

const uint RegionSize = REGION_TILES * TILE_SIZE; // pixels
const uint RegionPixels = RegionSize * RegionSize;
const uint RegionSamplers = 4u;     // pixels that weights are made for, one of each quarter
const float BoundShare = 1.0; // of the weight, in samplers: what bounds weigh

shared uint LowBits[3], HighBits[3]; // corners of the box of all surfaces, in an order that integers keep
shared uint PointKeys[BoxPoints];    // 0: there is no surface; else the lowest bits are the pixel's number
shared vec3 SamplerP[RegionSamplers], SamplerN[RegionSamplers];
shared bool bSampler[RegionSamplers];
#ifdef BACK_PIXELS
shared bool bSamplerBack[RegionSamplers]; // see FGBufferPoint::bBack
#endif
shared float Totals[RegionSamplers + 1u][REGION_THREADS]; // over the run of each thread: of samplers, and of bounds
shared float RunSums[REGION_THREADS];
shared uint RunCounts[REGION_THREADS];

#ifdef EMITTERS
const uint MostListed = REGION_EMITTERS, ListedBit = LIGHT_TRIANGLE;
#else
const uint MostListed = REGION_LIGHTS, ListedBit = 0u;
#endif

ivec2 RegionPixel(FViewConstants View, uint Number)
{
	ivec2 First = ivec2(gl_WorkGroupID.xy * RegionSize) - ivec2(RegionShift(View) * TILE_SIZE);
	return First + ivec2(Number % RegionSize, Number / RegionSize);
}

// Returns 0 for a pixel without a surface.
float RegionDepth(FViewConstants View, ivec2 Pixel)
{
	bool bInside = all(greaterThanEqual(Pixel, ivec2(0))) && !IsOutsideView(View, uvec2(Pixel));
	return bInside ? LoadDepth(Push.Depth, Pixel) : 0.0;
}

// Measures the box of all surfaces, and chooses a pixel of each 8 x 4.
void MeasureRegion(FViewConstants View, uint Thread)
{
	uint Seed = HashPcg(View.FrameIndex ^ HashPcg(View.Seed));
	[[dont_unroll]] for (uint Number = Thread; Number < RegionPixels; Number += REGION_THREADS)
	{
		ivec2 Pixel = RegionPixel(View, Number);
		float Depth = RegionDepth(View, Pixel);
		if (Depth <= 0.0) { continue; }
		vec3 P = View.CameraPosition + RelativePositionFromDepth(View, uvec2(Pixel), Depth);
		for (uint Axis = 0u; Axis < 3u; ++Axis)
		{
			atomicMin(LowBits[Axis], ToOrdered(P[Axis]));
			atomicMax(HighBits[Axis], ToOrdered(P[Axis]));
		}
		uint Point = (Number % RegionSize) / 8u + 4u * (Number / RegionSize / 4u);
		atomicMax(PointKeys[Point], ((HashPcg(Number ^ Seed) | 1024u) & ~(RegionPixels - 1u)) | Number);
	}
}

void LoadPoint(FSceneConstants Scene, FViewConstants View, uint Point)
{
	BoxSamples[Point] = vec4(0.0);
	if (PointKeys[Point] == 0u) { return; }
	ivec2 Pixel = RegionPixel(View, PointKeys[Point] & (RegionPixels - 1u));
	FLocalPoint Surface = LoadLocalPoint(Scene, View, Push.Normals, uvec2(Pixel), RegionDepth(View, Pixel));
	BoxSamples[Point] = vec4(Surface.P, PixelHeight(View, length(Surface.Surface.Relative)));
	// A quarter has eight points. Its sampler is another one in each frame, unless that shows the sky.
	uint Quarter = (Point & 3u) / 2u + 2u * (Point / 16u), Chosen = 32u;
	for (uint I = 0u; I < 8u && Chosen == 32u; ++I)
	{
		uint Turn = (I + View.FrameIndex) & 7u, Other = (Quarter & 1u) * 2u + (Turn & 1u) + 4u * ((Quarter >> 1u) * 4u + (Turn >> 1u));
		if (PointKeys[Other] != 0u) { Chosen = Other; }
	}
	if (Chosen != Point) { return; }
	bSampler[Quarter] = true;
	SamplerP[Quarter] = Surface.P;
	SamplerN[Quarter] = Surface.Surface.BentN;
#ifdef BACK_PIXELS
	bSamplerBack[Quarter] = Surface.Surface.bBack;
#endif
}

// Whether light on the other side of a sampler's surface counts as well.
bool ShowsBack(uint S)
{
#ifdef BACK_PIXELS
	return bSamplerBack[S];
#else
	return false;
#endif
}

// Returns what a light may bring: to each sampler, and at most. All are 0 if it does not reach the region.
float[RegionSamplers + 1u] MeasureLight(FSceneConstants Scene, uint Light, vec3 Low, vec3 High)
{
	float Brings[RegionSamplers + 1u];
#ifdef EMITTERS
	FEmitterCluster Cluster = LoadCluster(Push.Regions, Light);
	bool bReaches = MayReachFromCluster(Cluster, Low, High);
	for (uint S = 0u; S < RegionSamplers; ++S)
	{
		float Estimate = bReaches && bSampler[S] ? EstimateCluster(Cluster, SamplerP[S], SamplerN[S], 0.0) : 0.0;
		if (bReaches && bSampler[S] && ShowsBack(S)) { Estimate = max(Estimate, EstimateCluster(Cluster, SamplerP[S], -SamplerN[S], 0.0)); }
		Brings[S] = min(Estimate, 1.0e30);
	}
	Brings[RegionSamplers] = bReaches ? clamp(BoundCluster(Cluster, Low, High), 1.0e-30, 1.0e30) : 0.0;
	return Brings;
#else
	FLightData Data = FLightRef(Scene.Lights).Data[Light];
	bool bReaches = MayReach(Scene, Data, Low, High);
	for (uint S = 0u; S < RegionSamplers; ++S)
	{
		float Estimate = bReaches && bSampler[S] ? EstimateLight(Scene, Data, SamplerP[S], SamplerN[S]) : 0.0;
		if (bReaches && bSampler[S] && ShowsBack(S)) { Estimate = max(Estimate, EstimateLight(Scene, Data, SamplerP[S], -SamplerN[S])); }
		Brings[S] = min(Estimate, 1.0e30);
	}
	Brings[RegionSamplers] = bReaches ? clamp(BoundLight(Scene, Data, Low, High), 1.0e-30, 1.0e30) : 0.0;
	return Brings;
#endif
}

// Each sampler has the same say, however dark it is there.
float WeighLight(FSceneConstants Scene, uint Light, vec3 Low, vec3 High)
{
	float Brings[RegionSamplers + 1u] = MeasureLight(Scene, Light, Low, High);
	float Weight = Totals[RegionSamplers][0] > 0.0 ? BoundShare * Brings[RegionSamplers] / Totals[RegionSamplers][0] : 0.0;
	for (uint S = 0u; S < RegionSamplers; ++S) { Weight += Totals[S][0] > 0.0 ? Brings[S] / Totals[S][0] : 0.0; }
	return Weight;
}

// Adds up what lights bring, and counts those that reach the region. Returns the number of those before the thread's run.
uint CountLights(FSceneConstants Scene, uint Begin, uint End, uint Thread, vec3 Low, vec3 High, out uint Total)
{
	float Sums[RegionSamplers + 1u];
	uint Mine = 0u;
	for (uint S = 0u; S <= RegionSamplers; ++S) { Sums[S] = 0.0; }
	[[dont_unroll]] for (uint I = Begin; I < End; ++I)
	{
		float Brings[RegionSamplers + 1u] = MeasureLight(Scene, I, Low, High);
		for (uint S = 0u; S <= RegionSamplers; ++S) { Sums[S] += Brings[S]; }
		Mine += Brings[RegionSamplers] > 0.0 ? 1u : 0u;
	}
	for (uint S = 0u; S <= RegionSamplers; ++S) { Totals[S][Thread] = Sums[S]; }
	RunCounts[Thread] = Mine;
	barrier();
	if (Thread <= RegionSamplers)
	{
		float Sum = 0.0;
		[[dont_unroll]] for (uint I = 0u; I < REGION_THREADS; ++I) { Sum += Totals[Thread][I]; }
		Totals[Thread][0] = Sum;
	}
	uint Before = 0u;
	Total = 0u;
	[[dont_unroll]] for (uint I = 0u; I < REGION_THREADS; ++I)
	{
		Before += I < Thread ? RunCounts[I] : 0u;
		Total += RunCounts[I];
	}
	barrier();
	return Before;
}

void DrawLights(FSceneConstants Scene, FLightRegionRef Out, float Offset, uint Begin, uint End, uint Thread, vec3 Low, vec3 High)
{
	float Mine = 0.0, Before = 0.0, All = 0.0;
	[[dont_unroll]] for (uint I = Begin; I < End; ++I) { Mine += WeighLight(Scene, I, Low, High); }
	RunSums[Thread] = Mine;
	barrier();
	[[dont_unroll]] for (uint I = 0u; I < REGION_THREADS; ++I)
	{
		Before = I == Thread ? All : Before;
		All += RunSums[I];
	}
	// The next thread's first draw is where this one's end, however sums are rounded.
	uint Draw = DrawsBelow(Before, All, Offset, MostListed), LastDraw = DrawsBelow(Before + Mine, All, Offset, MostListed);
	uint Last = Begin;
	float LastWeight = 0.0;
	[[dont_unroll]] for (uint I = Begin; I <= End && Draw < LastDraw; ++I)
	{
		float Weight = I < End ? WeighLight(Scene, I, Low, High) : LastWeight;
		if (Weight <= 0.0) { continue; }
		Before += I < End ? Weight : 0.0;
		Last = I < End ? I : Last;
		LastWeight = Weight;
		uint Until = I < End ? min(DrawsBelow(Before, All, Offset, MostListed), LastDraw) : LastDraw;
		[[dont_unroll]] for (; Draw < Until; ++Draw)
		{
			Out.Data.Lights[Draw] = Last | ListedBit;
			Out.Data.Stands[Draw] = All / (Weight * float(MostListed));
		}
	}
}

void Start(uint Thread)
{
	if (Thread < 3u)
	{
		LowBits[Thread] = 0xffffffffu;
		HighBits[Thread] = 0u;
	}
	if (Thread < RegionSamplers) { bSampler[Thread] = false; }
	if (Thread < BoxPoints) { PointKeys[Thread] = 0u; }
	barrier();
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	uint Thread = gl_LocalInvocationIndex, Region = gl_WorkGroupID.y * RegionColumns(View) + gl_WorkGroupID.x;
#ifdef EMITTERS
	uint Items = Scene.EmissiveClusterCount;
	FAddress Regions = EmitterRegions(Scene, Push.Regions);
#else
	uint Items = Scene.LightCount;
	FAddress Regions = Push.Regions;
#endif
	FLightRegionRef Out = FLightRegionRef(Regions + Region * SizeOfRegion);
	Start(Thread);
	MeasureRegion(View, Thread);
	barrier();
	if (Thread < BoxPoints) { LoadPoint(Scene, View, Thread); }
	barrier();
	if (HighBits[0] < LowBits[0]) // nothing but sky
	{
		if (Thread == 0u) { Out.Data.Count = 0u; }
		return;
	}
	vec3 Low = BoxCorner(LowBits), High = BoxCorner(HighBits);
	uint Length = (Items + REGION_THREADS - 1u) / REGION_THREADS, Total;
	uint Begin = min(Thread * Length, Items), End = min(Begin + Length, Items);
	uint Before = CountLights(Scene, Begin, End, Thread, Low, High, Total);
	if (Thread == 0u) { Out.Data.Count = Total; }
	if (Total > MostListed)
	{
		float Offset = float(HashPcg(Region ^ HashPcg(View.FrameIndex ^ HashPcg(View.Seed))) >> 8u) * (1.0 / 16777216.0);
		DrawLights(Scene, Out, Offset, Begin, End, Thread, Low, High);
		return;
	}
	[[dont_unroll]] for (uint I = Begin; I < End; ++I)
	{
		if (MeasureLight(Scene, I, Low, High)[RegionSamplers] <= 0.0) { continue; }
		Out.Data.Lights[Before] = I | ListedBit;
		Out.Data.Stands[Before++] = 1.0;
	}
}
