#ifndef LANTERN_SAMPLING_GLSL
#define LANTERN_SAMPLING_GLSL

#include "Math.glsl"

vec2 SampleDisk(vec2 U)
{
	float R = sqrt(U.x), Phi = 2.0 * Pi * U.y;
	return R * vec2(cos(Phi), sin(Phi));
}

// Cosine-weighted around +z; density z/π.
vec3 SampleCosineHemisphere(vec2 U)
{
	vec2 D = SampleDisk(U);
	return vec3(D, sqrt(max(0.0, 1.0 - dot(D, D))));
}

// Uniform in the cone around +z. 1 − cos is formed without cancellation for cones as narrow as the sun's.
vec3 SampleCone(vec2 U, float OneMinusCos)
{
	float Z1 = U.x * OneMinusCos; // 1 − z
	float Sin = sqrt(max(0.0, Z1 * (2.0 - Z1)));
	float Phi = 2.0 * Pi * U.y;
	return vec3(Sin * cos(Phi), Sin * sin(Phi), 1.0 - Z1);
}

// Uniform barycentrics of a triangle.
vec2 SampleTriangle(vec2 U)
{
	float S = sqrt(U.x);
	return vec2(S * (1.0 - U.y), S * U.y);
}

// Power heuristic, exponent 2 (Veach 1997). By the ratio: squares of the densities of a small sun overflow.
float PowerHeuristic(float A, float B)
{
	if (isinf(A)) { return 1.0; }
	if (A <= 0.0) { return 0.0; }
	float Ratio = B / A;
	return 1.0 / (1.0 + Ratio * Ratio);
}

#endif
