// Diffuse global illumination by brute force: traces paths from every pixel, cosine-weighted about its shading normal. The ray-tracing
// pipeline and the ray-query path share it.
// RADIANCE_CELLS: paths end in radiance cells. One pixel of four votes for the places of cells, in turn.
// DEFERS_PATHS: paths that meet no cell are left to a second launch, of DEFERRED_PATHS, which has a thread for each of their pixels. Its files
// are Deferred.rgen and Deferred.comp: where one variant of a file serves for another, neither launch serves for the other.
// AUDITS_CELLS: see CellAudit.glsl.
// GUIDED_PATHS: see PathGuide.glsl. Each thread leaves a record of its first path.
// SCREEN_PROBES: paths start at screen probes instead of pixels.
// SHARED_PATHS: paths are left for all pixels around, which a pass behind them lights.
// PATH_RESERVOIRS: these are resampled with what pixels kept from the frame before, see PathReservoirs.glsl.
// SECOND_LOBE: the paths light the specular lobe as well (ESignal::RoughSpecular).
// CHECKERBOARD, QUARTER: see Rate.glsl. BruteForce/Fill.comp fills the other pixels.
// HAS_SUN, HAS_SKY, HAS_LIGHTS, HAS_EMISSIVE, HAS_MASKED: defined if the scene has such.
#ifndef LANTERN_DIFFUSE_GI_GLSL
#define LANTERN_DIFFUSE_GI_GLSL

#ifdef SCREEN_PROBES
#define QUARTER // of the short rays of pixels
#endif
#include "../Shared/BruteForceTypes.h"
#include "../Library/Rate.glsl"
#include "../Rays/IndirectSampling.glsl"
#include "../Rays/ThreadList.glsl"
#ifdef SECOND_LOBE
#include "../Rays/SecondLobe.glsl"
#endif
#ifdef SCREEN_PROBES
#include "../ScreenProbes/Trace.glsl"
#endif
#ifdef PATH_RESERVOIRS
#include "../Rays/PathReservoirs.glsl"
#endif

layout(push_constant, scalar) uniform FPush { FBruteForceConstants Push; };

#ifdef RADIANCE_CELLS
void BeginLookUps(FViewConstants View, uvec2 Pixel)
{
	if (Push.RadianceCells == FAddress(0)) { return; }
	FAddress Votes = FRadianceGridRef(Push.RadianceCells).Data.Votes;
	bool bHalf = Push.bHalf != 0u; // its pixels have voters of their own
	uint Number = bHalf ? Pixel.y * View.Width + Pixel.x : VoterOfPixel(View, Pixel);
#if defined(QUARTER)
	bool bVotes = true;
#elif defined(CHECKERBOARD)
	uint Rows = min(View.Height - (Pixel.y & ~1u), 2u); // fewer at the border
	bool bVotes = bHalf || (Pixel.y & 1u) == min((View.FrameIndex >> 1u) & 1u, Rows - 1u);
#else
	bool bVotes = bHalf || VotesInTurn(View, Pixel);
#endif
#ifdef DEFERRED_PATHS
	bVotes = false; // the first launch has
#endif
	if (bVotes) { FRadianceVoteRef(Votes).Data[Number].Slot = NO_RADIANCE_CELL; }
	BeginRadianceLookUps(Push.RadianceCells, View, bVotes ? Votes : FAddress(0), Number, 1u, HashLookUps(View, Pixel));
	RadianceNear = FRadianceGridRef(Push.RadianceCells).Data.NearCells;
}
#endif

#if defined(DEFERS_PATHS) || defined(DEFERRED_PATHS)
// Returns the number of threads in a row of the first launch.
uint LaunchWidth()
{
#ifdef SCREEN_PROBES
	return FScreenProbeGridRef(Push.ProbeGrid).Data.Columns * ProbeTexels;
#else
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	return TurnThreads(uvec2(View.Width, View.Height)).x;
#endif
}
#endif

#ifdef DEFERRED_PATHS
// Number: of this launch's thread. OutThread: the one of the first launch that it stands for.
bool FindDeferred(uint Number, out uvec2 OutThread)
{
	uint Thread, Width = LaunchWidth();
	bool bFound = FindThread(Push.Deferred, Number, Thread);
	OutThread = uvec2(Thread % Width, Thread / Width);
	return bFound;
}
#endif

#ifdef DEFERS_PATHS
void DeferThread(uvec2 Thread)
{
	MarkThread(Push.Deferred, BitOfThread(Thread, LaunchWidth()));
}
#endif

#ifdef PATH_RESERVOIRS
// Resamples the path of a pixel. Number: of its thread. Pixels that gather light from behind keep their own.
void KeepReservoir(FViewConstants View, ivec2 Pixel, float Depth, uint Number)
{
	bool bOwn = Depth <= 0.0;
#ifdef BACK_PIXELS
	bOwn = bOwn || bGathersBack;
#endif
	if (bOwn)
	{
		ClearReservoir(Push.Reservoirs, Number);
		return;
	}
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
	FRandom Random = MakeRandom(uvec2(Pixel), View.FrameIndex, HashPcg(View.Seed + 0x6a09e667u));
	vec3 Place = RasterRayOrigin(Scene, View, Point) - View.CameraPosition;
	uint Flags = GatherMask == MASK_VISIBLE ? 0u : PATH_RESERVOIR_SPHERE;
	ResampleKeptPath(Scene, View, Push.Reservoirs, Number, Point, Place, Flags, Random);
}
#endif

#ifdef SCREEN_PROBES
// Thread: see TraceProbes.
void GatherPaths(uvec2 Thread)
{
	FScreenProbeGrid Grid = FScreenProbeGridRef(Push.ProbeGrid).Data;
	bool bDone = TraceProbes(
	    FProbeTrace(Push.Pass, Grid, Push.RadianceCells, Push.Depth, Push.Normals, Push.MaxBounces, Push.ToonPixels), Thread);
#ifdef DEFERS_PATHS
	if (!bDone) { DeferThread(Thread); }
#endif
}
#else
// Thread: of a launch of as many as trace in this frame.
void GatherPaths(uvec2 Thread)
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(min(TurnPixel(Thread, View.FrameIndex), uvec2(View.Width, View.Height) - 1u));
	float Depth = LoadDepth(Push.Depth, Pixel);
	vec3 Radiance = vec3(0.0), Specular = vec3(0.0);
#ifdef RADIANCE_CELLS
	BeginLookUps(View, uvec2(Pixel));
	ChooseRadianceRest(uvec2(Pixel), View);
#endif
#ifdef AUDITS_CELLS
	BeginCellAudit(Push.RadianceCells, View, uvec2(Pixel), Thread, TurnThreads(uvec2(View.Width, View.Height)));
#endif
#ifdef SHARED_PATHS
	KeptPath = NoKeptPath;
#endif
#ifdef GUIDED_PATHS
	GuideTiles = Push.GuideTiles;
	PathRecord = PATH_GUIDE_NO_PATH;
#endif
	if (Depth > 0.0)
	{
		FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
		FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
#ifdef SHARED_PATHS
		PathNear = Push.NearPixels * PixelHeight(View, dot(View.CameraForward, Point.Relative));
#endif
#ifdef SECOND_LOBE
		vec3 Albedo = FindSecondLobe(Push.BaseColor, Push.Material, Pixel, Point, SecondLobe, SecondShare);
#endif
		ChooseGatherMask(Push.ToonPixels, Pixel);
#ifdef BACK_PIXELS
		bGathersBack = Point.bBack && Push.BackAlbedo != NO_TEXTURE;
		if (bGathersBack)
		{
			GatheredBrdf = MakeGBufferBrdf(texelFetch(Textures[Push.BaseColor], Pixel, 0), texelFetch(Textures[Push.Material], Pixel, 0));
			AddBackLobe(Push.BackAlbedo, Pixel, GatheredBrdf);
		}
#endif
		Radiance = AverageIndirectSamples(Scene, View, uvec2(Pixel), Point, MakeWhiteLambert(), Push.SamplesPerPixel, Push.MaxBounces,
		                                  0x61c88647u);
#ifdef SECOND_LOBE
		Specular = SecondMean / max(Albedo, vec3(1.0e-4));
#endif
	}
#ifdef DEFERS_PATHS
	if (bRadianceDeferred)
	{
		DeferThread(Thread);
		return;
	}
#endif
#if defined(AUDITS_CELLS) && defined(DEFERRED_PATHS)
	WriteCellAudit(Push.RadianceCells);
#endif
	uint Number = Thread.y * TurnThreads(uvec2(View.Width, View.Height)).x + Thread.x;
#ifdef GUIDED_PATHS
	FPathRecordRef(Push.PathRecords).Data[Number] = PathRecord;
#endif
#ifdef PATH_RESERVOIRS
	KeepReservoir(View, Pixel, Depth, Number);
#endif
#ifdef SHARED_PATHS
	FRandom Random = MakeRandom(uvec2(Pixel), View.FrameIndex, HashPcg(View.Seed + 0x3c6ef372u));
	FSharedPathRef(Push.Shared).Data[Number] = PackSharedPath(Radiance, Specular, Random);
#else
	imageStore(Images[Push.Output], Pixel, RoundToHalf(vec4(Radiance, 1.0)));
#ifdef SECOND_LOBE
	imageStore(Images[Push.SecondOutput], Pixel, RoundToHalf(vec4(Specular, 1.0)));
#endif
#endif
}

#endif

#endif
