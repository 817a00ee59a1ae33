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

// Where rays leave a surface so that they do not hit it again. How far off a point and a surface are from each other, as a ray
// sees it, is a matter of the largest number that fp32 rounded on the way, and of the driver:
// - coordinates of the point, and of the ray that found it: relative to the scene's origin, which is near the camera;
// - the translation into an object's space, no larger than these unless the object is larger itself. FSceneConstants::ObjectReach
//   (FObjectPivots) is the largest that any object near the camera has, and no less than 8 m.
// Rounding alone would make that 2 of 2^-24 of it for each step ("Solving Self-Intersection Artifacts in DirectX Raytracing",
// NVIDIA 2023); Wächter and Binder 2019 ("A Fast and Robust Method for Avoiding Self-Intersection") leave 256. Traversal in
// software on NVIDIA needs more than 64: these left a third of a room 500 m from the origin in its own shadow. Hence 200.
const float CoordinateError = 1.2e-5;

// Of a point, in metres. TraceDistance: length of the ray that found it.
float PositionError(vec3 P, float ObjectReach, float TraceDistance) { return CoordinateError * (max(MaxComponent(abs(P)), ObjectReach) + TraceDistance); }

vec3 OffsetRayOrigin(vec3 P, vec3 Ng, float ObjectReach, float TraceDistance) { return P + Ng * PositionError(P, ObjectReach, TraceDistance); }

// From a point that the raster saw. It puts vertices on a grid of 1/256 of a pixel (VkPhysicalDeviceLimits::
// subPixelPrecisionBits), half a step off in either direction, and takes the surface's depth with them. PixelWidth: at the
// point, metres.
vec3 OffsetRasterPoint(vec3 P, vec3 Ng, float ObjectReach, float PixelWidth)
{
	return P + Ng * (PositionError(P, ObjectReach, 0.0) + PixelWidth * (1.0 / 256.0));
}

#endif
