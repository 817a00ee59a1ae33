// Traces the rays of screen probes and short rays of pixels: a thread for each. They end in radiance cells.
#ifndef LANTERN_SCREEN_PROBE_TRACE_GLSL
#define LANTERN_SCREEN_PROBE_TRACE_GLSL

#include "Near.glsl"
#include "../Rays/IndirectSampling.glsl"

// Sums of products of what it returns are finite.
vec3 ClampProbeLight(vec3 L) { return mix(clamp(L, vec3(0.0), vec3(1.0e15)), vec3(0.0), isnan(L)); }

// Returns the radiance that arrives along a ray, as Gather has it for a white Lambert lobe.
// MaxDistance: below Infinity, what is missed has no light.
FScreenProbeRay TraceProbeRay(FSceneConstants Scene, vec3 P, vec3 Direction, float MaxDistance, uint MaxBounces, inout FRandom Random)
{
	FMaterialHit Hit = TraceMaterial(Scene, GatherMask, P, Direction, MaxDistance, SHOWS_NOTHING);
	if (Hit.Distance < 0.0 && MaxDistance < Infinity) { return FScreenProbeRay(vec3(0.0), 0.0); }
	if (Hit.Distance < 0.0)
	{
#ifdef HAS_SKY
		return FScreenProbeRay(ClampProbeLight(SampleSkyRadiance(Scene, Direction)), Infinity);
#else
		return FScreenProbeRay(vec3(0.0), Infinity);
#endif
	}
#ifdef EMISSIVE_IS_DIRECT
	if (Hit.EmissiveWeight > 0.0) { Hit.Emissive = vec3(0.0); } // light sampling has found it
#ifdef HAS_TRANSMISSION
	FirstEmissionShare = 0.0; // also behind glass
#endif
#endif
	const float Alone = 1.0 / 0.0; // pdf: nothing else finds what this ray finds
	vec3 L = FollowPath(Scene, Hit, P, Direction, Alone, 1.0, 1u, MaxBounces, false, Random);
	return FScreenProbeRay(ClampProbeLight(L), Hit.Distance);
}

// bMayVote: a ray of a probe.
void BeginProbeLookUps(FViewConstants View, FScreenProbeGrid Grid, FAddress Cells, uint Number, uvec2 Thread, bool bMayVote)
{
	if (Cells == FAddress(0)) { return; }
	FAddress Votes = FRadianceGridRef(Cells).Data.Votes;
	uint Vote = Number / Grid.RaysPerVote;
	bool bVotes = bMayVote && Number % Grid.RaysPerVote == View.FrameIndex % Grid.RaysPerVote;
#ifdef DEFERRED_PATHS
	bVotes = false; // the first launch has
#endif
	if (bVotes) { FRadianceVoteRef(Votes).Data[Vote].Slot = NO_RADIANCE_CELL; }
	uint Hash = HashPcg(Number + HashPcg(View.FrameIndex + View.Seed));
	BeginRadianceLookUps(Cells, View, bVotes ? Votes : FAddress(0), Vote, 1u, Hash);
	RadianceNear = FRadianceGridRef(Cells).Data.NearCells;
	ChooseRadianceRest(Thread, View);
}

// What both kinds of rays need of the pass.
struct FProbeTrace
{
	FPassConstants Pass;
	FScreenProbeGrid Grid;
	FAddress Cells;
	uint Depth, Normals, MaxBounces, ToonPixels;
};

// Thread: x / SCREEN_PROBE_TEXELS and y are the probe's tile.
void TraceFromProbe(FProbeTrace Trace, FViewConstants View, uvec2 Thread, out uint OutNumber, out FScreenProbeRay Found)
{
	uint Probe = Thread.y * Trace.Grid.Columns + Thread.x / ProbeTexels, Ray = Thread.x % ProbeTexels;
	OutNumber = Probe * ProbeTexels + Ray;
	Found = FScreenProbeRay(vec3(0.0), 0.0);
	BeginProbeLookUps(View, Trace.Grid, Trace.Cells, OutNumber, Thread, true);
	FScreenProbeRef Probes = FScreenProbeRef(Trace.Grid.Probes);
	if (Probes.Data[Probe].Distance <= 0.0) { return; }
	FSceneConstants Scene = FSceneRef(Trace.Pass.Scene).Data;
	FRandom Random = MakeRandom(Thread, View.FrameIndex, HashPcg(View.Seed + 0x3c6ef372u));
	uint Texel = FScreenProbePlanRef(Trace.Grid.Plans).Data[Probe].Rays[Ray];
	vec3 Direction = OctMapDirection(Texel, NextRandom4(Random).xy);
	ivec2 Pixel = ivec2(ProbePixel(Probes.Data[Probe].Pixel));
	FGBufferPoint Point = LoadGBufferPoint(View, Trace.Normals, Pixel, LoadDepth(Trace.Depth, Pixel));
	if (dot(Direction, Point.Ng) <= 0.0) { return; }
	ChooseGatherMask(Trace.ToonPixels, Pixel);
	Found = TraceProbeRay(Scene, RasterRayOrigin(Scene, View, Point), Direction, Infinity, Trace.MaxBounces, Random);
}

// Number: of the pixel among those that have their turn.
void TraceFromPixel(FProbeTrace Trace, FViewConstants View, uint Number, out FScreenProbeRay Found)
{
	Found = FScreenProbeRay(vec3(0.0), 0.0);
	uint Columns = TurnThreads(uvec2(View.Width, View.Height)).x;
	uvec2 Pixel = TurnPixel(uvec2(Number % Columns, Number / Columns), View.FrameIndex);
	BeginProbeLookUps(View, Trace.Grid, Trace.Cells, Number, Pixel, false);
	if (IsOutsideView(View, Pixel)) { return; }
	float Depth = LoadDepth(Trace.Depth, ivec2(Pixel));
	if (Depth <= 0.0) { return; }
	FSceneConstants Scene = FSceneRef(Trace.Pass.Scene).Data;
	FGBufferPoint Point = LoadGBufferPoint(View, Trace.Normals, ivec2(Pixel), Depth);
	vec3 Direction = NearDirection(View, Pixel, Point);
	if (dot(Direction, Point.Ng) <= 0.0) { return; }
	FRandom Random = MakeRandom(Pixel, View.FrameIndex, HashPcg(View.Seed + 0x78dde6e4u));
	float Reach = Trace.Grid.NearReach * float(Trace.Grid.Spacing) * PixelHeight(View, dot(View.CameraForward, Point.Relative));
	ChooseGatherMask(Trace.ToonPixels, ivec2(Pixel));
	Found = TraceProbeRay(Scene, RasterRayOrigin(Scene, View, Point), Direction, Reach, Trace.MaxBounces, Random);
}

// Thread: of a launch of Columns * SCREEN_PROBE_TEXELS columns. Rows of pixels' rays lie below those of the probes. False: another launch must
// trace it (DEFERS_PATHS).
bool TraceProbes(FProbeTrace Trace, uvec2 Thread)
{
	FViewConstants View = FViewRef(Trace.Pass.View).Data;
	uint Width = Trace.Grid.Columns * ProbeTexels, Number;
	FAddress Rays = Trace.Grid.Rays;
	FScreenProbeRay Found;
	if (Thread.x >= Width) { return true; }
	if (Thread.y < Trace.Grid.Rows) { TraceFromProbe(Trace, View, Thread, Number, Found); }
	else
	{
		uvec2 Turns = TurnThreads(uvec2(View.Width, View.Height));
		Number = (Thread.y - Trace.Grid.Rows) * Width + Thread.x;
		if (Number >= Turns.x * Turns.y || Trace.Grid.NearReach <= 0.0) { return true; }
		TraceFromPixel(Trace, View, Number, Found);
		Rays = Trace.Grid.NearRays;
	}
#ifdef DEFERS_PATHS
	if (bRadianceDeferred) { return false; }
#endif
	FScreenProbeRayRef(Rays).Data[Number] = Found;
	return true;
}

#endif
