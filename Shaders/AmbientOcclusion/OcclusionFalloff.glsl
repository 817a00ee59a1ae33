// What ambient occlusion is, for the pass and for the reference of its signal: the mean of OcclusionVisibility over
// directions about the shading normal, weighted by their cosine. A direction below the geometric surface is blocked.
#ifndef LANTERN_AMBIENT_OCCLUSION_GLSL
#define LANTERN_AMBIENT_OCCLUSION_GLSL

#include "../Library/Sampling.glsl"

// With the nearest surface in a direction at Distance ≤ Radius. One that touches blocks all, one at Radius nothing, so that
// nothing pops where it comes within reach.
float OcclusionVisibility(float Distance, float Radius)
{
	float Ratio = Distance / Radius;
	return min(Ratio * Ratio, 1.0);
}

// Length of a ray that is blocked with the probability 1 − OcclusionVisibility of what it meets: the mean of all or nothing
// is the same. So the ray needs no distance, only whether anything is there: it ends at the first hit, it is shorter, and
// shadow rays' shaders serve it.
float SampleOcclusionLength(float U, float Radius) { return Radius * sqrt(U); }

vec3 SampleOcclusionDirection(vec3 N, vec2 U) { return MakeBasis(N) * SampleCosineHemisphere(U); }

#endif
