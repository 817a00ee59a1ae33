// Defines ambient occlusion for the pass and for the reference of its signal. It is the mean of OcclusionVisibility over
// directions about the shading normal, weighted by their cosine. A direction below the geometric surface counts as blocked.
#ifndef LANTERN_AMBIENT_OCCLUSION_GLSL
#define LANTERN_AMBIENT_OCCLUSION_GLSL

#include "../Library/Sampling.glsl"

// Returns the visibility of a direction whose nearest surface lies at Distance ≤ Radius. A surface in contact blocks
// everything; one at Radius blocks nothing, so that occluders fade in as they come within reach.
float OcclusionVisibility(float Distance, float Radius)
{
	float Ratio = Distance / Radius;
	return min(Ratio * Ratio, 1.0);
}

// Samples a ray length such that the ray is blocked with probability 1 − OcclusionVisibility of the surface that it meets.
// The mean of this binary result equals the mean visibility. The ray therefore needs no hit distance and ends at the first
// hit. It is shorter than Radius, and the shaders of shadow rays serve it.
float SampleOcclusionLength(float U, float Radius) { return Radius * sqrt(U); }

vec3 SampleOcclusionDirection(vec3 N, vec2 U) { return MakeBasis(N) * SampleCosineHemisphere(U); }

#endif
