// Sampling shared by the passes of indirect light: diffuse GI and reflections.
#ifndef LANTERN_INDIRECT_SAMPLING_GLSL
#define LANTERN_INDIRECT_SAMPLING_GLSL

#include "../Library/GBuffer.glsl"
#include "PathTracing.glsl"
#ifdef SHARED_PATHS
#include "SharedPaths.glsl"
#endif

const float MaxHalf = 65504.0;

#ifdef AUDITS_CELLS
const float MinHalf = -MaxHalf; // a correction may take more than there is, and must: the mean is right
#else
const float MinHalf = 0.0;
#endif

// Removes NaNs, and clamps to what fp16 holds: a sun may be brighter, and would become infinite in the output.
vec3 ClampToFinite(vec3 L) { return mix(clamp(L, vec3(MinHalf), vec3(MaxHalf)), vec3(0.0), isnan(L)); }

#ifdef SECOND_LOBE
// What SecondLobe reflects, which the paths of a white Lambert lobe light as well.
vec3 SecondMean;

// Returns by what light from a direction counts more for the second lobe than for the white one.
vec3 WeighSecond(mat3 Basis, vec3 V, vec3 Direction)
{
	vec3 L = Direction * Basis;
	return EvaluateBrdfCos(SecondLobe, V, L) * (Pi / max(L.z, 1.0e-4));
}
#endif

#ifdef GUIDED_PATHS
FAddress GuideTiles; // of the previous frame, see FindGuideTile. The thread sets it before
uint PathRecord;     // of the pixel's first path, see PackGuideRecord

// Draws the tile of a path: pixels near a border between tiles ask either.
void ChooseGuide(FViewConstants View, FGBufferPoint Point, uvec2 Pixel, vec2 U)
{
	vec2 Shift = (U - 0.5) * float(PATH_GUIDE_TILE);
	PathGuide = MakePathGuide(FindGuideTile(View, GuideTiles, Point.Relative, vec2(Pixel) + 0.5, Shift), Point.BentN);
}

// Returns what the guide is told of a path: its radiance over the pdf of its direction.
uint RecordPath(FGathered Gathered, vec3 N)
{
	const float LeastCosine = 0.1; // grazing paths are rare and would count for very many
	return PackGuideRecord(Gathered.Direction, Luminance(Gathered.Light) * Pi / max(dot(Gathered.Direction, N), LeastCosine));
}
#endif

#ifdef BACK_PIXELS
// The thread sets these before: whether light from behind counts as well, and the surface of the pixel. What is gathered is then that of both
// sides, over DiffuseReflectance.
bool bGathersBack = false;
FBrdf GatheredBrdf;
#endif

// One side of a pixel's surface, that a path leaves.
struct FPathSide
{
	FGBufferPoint Point; // turned, so that it faces that side
	vec3 V;              // towards the viewer, mirrored if that is on the other side
	vec3 Weight;         // of the path's light
	float FrontWeight;   // of what the second lobe reflects of it
};

FPathSide ChoosePathSide(FGBufferPoint Point, inout FRandom Random)
{
	FPathSide Side = FPathSide(Point, Point.V, vec3(1.0), 1.0);
#ifdef BACK_PIXELS
	if (!bGathersBack) { return Side; }
	FGatherSide Chosen = ChooseSide(GatheredBrdf, NextRandom4(Random).x);
	Side.Weight = Chosen.Weight;
	Side.FrontWeight = Chosen.bBack ? 0.0 : 1.0 / (1.0 - BackChance(GatheredBrdf));
	if (Chosen.bBack)
	{
		FaceDirection(Side.Point, -SideNormal(Point));
		Side.V = reflect(Point.V, Point.BentN);
	}
#endif
	return Side;
}

#ifdef COUNTS_ENDS
void CountEnd(); // of the includer, behind each path
#endif

// Returns the mean radiance of a pixel's paths through one lobe. The first direction of a path is an Owen-scrambled Sobol
// point; the sequence continues from frame to frame. All other random numbers come from an independent stream for each
// sample. Salt decorrelates passes.
vec3 AverageIndirectSamples(FSceneConstants Scene, FViewConstants View, uvec2 Pixel, FGBufferPoint Point, FBrdf Lobe, uint Samples,
                            uint MaxBounces, uint Salt)
{
	uint StreamSeed = HashPcg(View.Seed + Salt);
	uint Seed = HashPcg(Pixel.x + HashPcg(Pixel.y + StreamSeed));
	vec3 Sum = vec3(0.0);
#ifdef SECOND_LOBE
	vec3 SecondSum = vec3(0.0);
	float ShareOfSecond = SecondShare;
#endif
	for (uint Sample = 0; Sample < Samples; ++Sample)
	{
		uint Index = View.FrameIndex * Samples + Sample;
		FRandom Random = MakeRandom(Pixel, Index, StreamSeed);
		FPathSide Side = ChoosePathSide(Point, Random);
#ifdef AUDITS_CELLS
		CellAudit.Weight = Luminance(Side.Weight);
#endif
		vec3 P = RasterRayOrigin(Scene, View, Side.Point);
		mat3 Basis = MakeBasis(Side.Point.BentN);
		vec3 V = Side.V * Basis;
#ifdef SECOND_LOBE
		SecondShare = Side.FrontWeight > 0.0 ? ShareOfSecond : 0.0;
#endif
#ifdef GUIDED_PATHS
		ChooseGuide(View, Side.Point, Pixel, NextRandom4(Random).xy);
#endif
		FGathered Gathered = Gather(Scene, Lobe, Basis, V, P, Side.Point.Ng, SobolOwen2(Index, Seed), MaxBounces, Random);
#ifdef COUNTS_ENDS
		CountEnd();
#endif
#ifdef GUIDED_PATHS
#ifdef AUDITS_CELLS
		bool bRecords = Sample == 0u && CellAudit.Correction == 0.0; // a correction is no light that comes from there
#else
		bool bRecords = Sample == 0u;
#endif
		if (bRecords) { PathRecord = RecordPath(Gathered, Side.Point.BentN); }
#endif
#ifdef SHARED_PATHS
		// What others take over is theirs to light the pixel by.
#ifdef RADIANCE_CELLS
		float Gone = Gathered.Gone;
#else
		const float Gone = 0.0;
#endif
		if (OfferPath(P - View.CameraPosition, Gathered.Direction, Gathered.Distance, Gathered.Radiance, Gathered.Share, Gone))
		{
			Gathered.Light = vec3(0.0);
		}
#endif
		vec3 L = (Gathered.Light + Gathered.Emission) * Side.Weight;
		Sum += mix(L, vec3(0.0), isnan(L));
#ifdef SECOND_LOBE
		L = Gathered.Light * WeighSecond(Basis, V, Gathered.Direction) + Gathered.Emission * WeighSecond(Basis, V, Gathered.EmissionDirection);
		L *= Side.FrontWeight;
		SecondSum += mix(L, vec3(0.0), isnan(L));
#endif
	}
#ifdef SECOND_LOBE
	SecondMean = ClampToFinite(SecondSum / float(Samples));
#endif
	return ClampToFinite(Sum / float(Samples));
}

#endif
