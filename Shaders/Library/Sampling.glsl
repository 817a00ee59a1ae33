// Maps uniform random numbers U in [0, 1) to disks, directions and triangles; multiple importance sampling.
#ifndef LANTERN_SAMPLING_GLSL
#define LANTERN_SAMPLING_GLSL

#include "Math.glsl"

// Uniform in the unit disk.
vec2 SampleDisk(vec2 U)
{
	float R = sqrt(U.x), Phi = 2.0 * Pi * U.y;
	return R * vec2(cos(Phi), sin(Phi));
}

// Cosine-weighted around +z; pdf z / π. z is never 0: a compiler may work it out twice, by other roundings, and what a caller has tested
// against 0 would be another z than the one that it divides by.
vec3 SampleCosineHemisphere(vec2 U)
{
	const float LeastSquared = 1.0e-12;
	vec2 Disk = SampleDisk(U);
	return vec3(Disk, sqrt(max(LeastSquared, 1.0 - dot(Disk, Disk))));
}

// Uniform in the cone around +z. OneMinusCos: 1 − cosine of the half angle, which cones as narrow as the sun's need to
// avoid cancellation.
vec3 SampleCone(vec2 U, float OneMinusCos)
{
	float OneMinusZ = U.x * OneMinusCos;
	float Sin = sqrt(max(0.0, OneMinusZ * (2.0 - OneMinusZ)));
	float Phi = 2.0 * Pi * U.y;
	return vec3(Sin * cos(Phi), Sin * sin(Phi), 1.0 - OneMinusZ);
}

// Uniform on a triangle; returns the barycentrics of its second and third corner.
vec2 SampleTriangle(vec2 U)
{
	float Root = sqrt(U.x);
	return vec2(Root * (1.0 - U.y), Root * U.y);
}

// Power heuristic with exponent 2 (Veach 1997): the weight of a sample of density Pdf that another technique samples with
// OtherPdf. Uses the ratio, since the squares of the densities of a small sun overflow.
float PowerHeuristic(float Pdf, float OtherPdf)
{
	if (isinf(Pdf)) { return 1.0; }
	if (Pdf <= 0.0) { return 0.0; }
	float Ratio = OtherPdf / Pdf;
	return 1.0 / (1.0 + Ratio * Ratio);
}

#endif
