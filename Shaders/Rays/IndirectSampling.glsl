// Sampling shared by the brute-force passes of indirect light: diffuse GI and reflections.
#ifndef LANTERN_INDIRECT_SAMPLING_GLSL
#define LANTERN_INDIRECT_SAMPLING_GLSL

#include "../Library/GBuffer.glsl"
#include "PathTracing.glsl"

const float MaxHalf = 65504.0;

// Removes NaNs, and clamps to what fp16 holds: a sun may be brighter, and would become infinite in the output.
vec3 ClampToFinite(vec3 L) { return mix(clamp(L, vec3(0.0), vec3(MaxHalf)), vec3(0.0), isnan(L)); }

// Returns the mean radiance of a pixel's paths through one lobe. The first direction of a path is an Owen-scrambled Sobol
// point; the sequence continues from frame to frame. All other random numbers come from an independent stream for each
// sample. Salt decorrelates passes.
vec3 AverageIndirectSamples(FSceneConstants Scene, FViewConstants View, uvec2 Pixel, FGBufferPoint Point, FBrdf Lobe, uint Samples,
                            uint MaxBounces, uint Salt)
{
	vec3 P = RasterRayOrigin(Scene, View, Point);
	mat3 Basis = MakeBasis(Point.BentN);
	vec3 V = Point.V * Basis;
	uint StreamSeed = HashPcg(View.Seed + Salt);
	uint Seed = HashPcg(Pixel.x + HashPcg(Pixel.y + StreamSeed));
	vec3 Sum = vec3(0.0);
	for (uint Sample = 0; Sample < Samples; ++Sample)
	{
		uint Index = View.FrameIndex * Samples + Sample;
		FRandom Random = MakeRandom(Pixel, Index, StreamSeed);
		vec3 L = GatherIndirect(Scene, Lobe, Basis, V, P, Point.Ng, SobolOwen2(Index, Seed), MaxBounces, Random);
		Sum += mix(L, vec3(0.0), isnan(L));
	}
	return ClampToFinite(Sum / float(Samples));
}

#endif
