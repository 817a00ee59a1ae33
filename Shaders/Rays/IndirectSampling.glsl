// What the brute-force passes of indirect light share.
#ifndef LANTERN_INDIRECT_SAMPLING_GLSL
#define LANTERN_INDIRECT_SAMPLING_GLSL

#include "../Library/GBuffer.glsl"
#include "PathTracing.glsl"

const float MaxHalf = 65504.0;

// No NaN and no infinity may reach an output, nor become one there: a sun may well be brighter than fp16 holds.
vec3 KeepFinite(vec3 L) { return mix(clamp(L, vec3(0.0), vec3(MaxHalf)), vec3(0.0), isnan(L)); }

// Mean of what a pixel's samples bring through one lobe. The first directions are Owen-scrambled Sobol points that go on from
// frame to frame, all else is a stream of its own for each sample; Salt keeps passes apart.
vec3 GatherSamples(FSceneConstants Scene, FViewConstants View, uvec2 Pixel, FGBufferPoint Point, FBrdf Lobe, uint Samples, uint MaxBounces, uint Salt)
{
	vec3 P = RasterRayOrigin(Scene, View, Point.Relative, Point.Ng);
	mat3 Basis = MakeBasis(Point.N);
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
	return KeepFinite(Sum / float(Samples));
}

#endif
