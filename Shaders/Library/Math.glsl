#ifndef LANTERN_MATH_GLSL
#define LANTERN_MATH_GLSL

const float Pi = 3.14159265358979;

// Octahedral unit vectors, 2 × snorm16 (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors").
vec2 OctEncode(vec3 V)
{
	V /= abs(V.x) + abs(V.y) + abs(V.z);
	vec2 Folded = (1.0 - abs(V.yx)) * vec2(V.x >= 0.0 ? 1.0 : -1.0, V.y >= 0.0 ? 1.0 : -1.0);
	return V.z >= 0.0 ? V.xy : Folded;
}

vec3 OctDecode(vec2 E)
{
	vec3 V = vec3(E, 1.0 - abs(E.x) - abs(E.y));
	float Fold = max(-V.z, 0.0);
	V.x += V.x >= 0.0 ? -Fold : Fold;
	V.y += V.y >= 0.0 ? -Fold : Fold;
	return normalize(V);
}

uint PackOct(vec3 V) { return packSnorm2x16(OctEncode(V)); }
vec3 UnpackOct(uint P) { return OctDecode(unpackSnorm2x16(P)); }

float Luminance(vec3 C) { return dot(C, vec3(0.2126, 0.7152, 0.0722)); }
float MaxComponent(vec3 C) { return max(C.x, max(C.y, C.z)); }

// Normals that cancel out give Fallback, never a NaN.
vec3 NormalizeOr(vec3 V, vec3 Fallback)
{
	float Length2 = dot(V, V);
	return Length2 > 1.0e-30 ? V * inversesqrt(Length2) : Fallback;
}

// Orthonormal basis around N, without branches on its direction (Duff et al. 2017).
mat3 MakeBasis(vec3 N)
{
	float S = N.z >= 0.0 ? 1.0 : -1.0;
	float A = -1.0 / (S + N.z);
	float B = N.x * N.y * A;
	return mat3(vec3(1.0 + S * N.x * N.x * A, S * B, -S * N.x), vec3(B, S + N.y * N.y * A, -N.y), N);
}

vec3 OffsetByUlps(vec3 P, vec3 Ng, float Scale, float Relative) { return P + Ng * max(max(MaxComponent(abs(P)), Scale) * Relative, 2.0e-5); }

// Where a ray leaves a surface so that it does not hit that surface again: the error of a position computed
// in fp32 grows with its magnitude and with the distance it was traced over.
vec3 OffsetRayOrigin(vec3 P, vec3 Ng, float Distance) { return OffsetByUlps(P, Ng, Distance, 4.0e-6); }

// The same from a point that the raster saw, Distance away. 200 units in the last place; Wächter and Binder 2019 ("A Fast and
// Robust Method for Avoiding Self-Intersection") have 256. A third of that is enough for lavapipe, and leaves a third of the
// pixels of a room 500 m from the scene's origin in their own shadow on NVIDIA; more moves contacts.
vec3 OffsetRasterPoint(vec3 P, vec3 Ng, float Distance) { return OffsetByUlps(P, Ng, 4.0 * Distance, 1.2e-5); }

#endif
