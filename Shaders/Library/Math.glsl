// Vectors, octahedral encoding, and the offset that keeps rays from hitting the surface that they start on.
#ifndef LANTERN_MATH_GLSL
#define LANTERN_MATH_GLSL

const float Pi = 3.14159265358979;

// Encodes a unit vector to two octahedral coordinates in [−1, 1] (Cigolle et al. 2014, "A Survey of Efficient
// Representations for Independent Unit Vectors").
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

// 2 × snorm16.
uint PackOct(vec3 V) { return packSnorm2x16(OctEncode(V)); }
vec3 UnpackOct(uint P) { return OctDecode(unpackSnorm2x16(P)); }

// 2 × snorm12, the lower 24 bits. Off by 0.06° at most.
uint PackOct24(vec3 V)
{
	ivec2 E = ivec2(round(clamp(OctEncode(V), -1.0, 1.0) * 2047.0));
	return uint(E.x & 0xfff) | (uint(E.y & 0xfff) << 12u);
}
vec3 UnpackOct24(uint P) { return OctDecode(vec2(bitfieldExtract(int(P), 0, 12), bitfieldExtract(int(P), 12, 12)) / 2047.0); }

float Luminance(vec3 C) { return dot(C, vec3(0.2126, 0.7152, 0.0722)); }
float MaxComponent(vec3 C) { return max(C.x, max(C.y, C.z)); }

// Returns the arc cosine with an error of 1e-7. Vulkan allows the built-in one 4,096 units in the last place, and lavapipe's is off by
// 1e-4, which is 0.4 % of a small solid angle. Abramowitz and Stegun 1964, 4.4.46.
float AccurateAcos(float X)
{
	float A = abs(X);
	float P = -0.0012624911;
	P = P * A + 0.0066700901;
	P = P * A - 0.0170881256;
	P = P * A + 0.0308918810;
	P = P * A - 0.0501743046;
	P = P * A + 0.0889789874;
	P = P * A - 0.2145988016;
	P = P * A + 1.5707963050;
	P *= sqrt(max(1.0 - A, 0.0));
	return X < 0.0 ? Pi - P : P;
}

// Normalizes V; returns Fallback, never a NaN, if V is nearly zero (interpolated normals may cancel out).
vec3 NormalizeOr(vec3 V, vec3 Fallback)
{
	float LengthSquared = dot(V, V);
	return LengthSquared > 1.0e-30 ? V * inversesqrt(LengthSquared) : Fallback;
}

// Makes an orthonormal basis with N as its z axis, without branches on the direction (Duff et al. 2017).
mat3 MakeBasis(vec3 N)
{
	float S = N.z >= 0.0 ? 1.0 : -1.0;
	float A = -1.0 / (S + N.z);
	float B = N.x * N.y * A;
	return mat3(vec3(1.0 + S * N.x * N.x * A, S * B, -S * N.x), vec3(B, S + N.y * N.y * A, -N.y), N);
}

// Rays start at an offset from their surface, so that they do not hit it again. The distance between a hit point and its
// surface, as traversal computes it, is proportional to the largest number that fp32 rounded on the way. There are two candidates:
// - The coordinates of the point and of the ray that found it, relative to the scene's origin, which is near the camera.
// - The translation into the object's space. It exceeds these coordinates only if the object itself is larger.
//   FSceneConstants::ObjectReach (FObjectPivots) is the largest one of any object near the camera, and at least 8 m.
// Rounding alone costs 2 units of 2^-24 of that number a step ("Solving Self-Intersection Artifacts in DirectX Raytracing",
// NVIDIA 2023). Wächter and Binder 2019 ("A Fast and Robust Method for Avoiding Self-Intersection") allow 256 units.
// Traversal in software on NVIDIA needs more than 64: with 64, a third of a room 500 m from the origin shadowed itself.
// The constant is therefore 200 units.
const float CoordinateError = 1.2e-5;

// Returns the bound of the error of a hit point, in metres. TraceDistance: length of the ray that found it, metres.
float PositionError(vec3 P, float ObjectReach, float TraceDistance)
{
	return CoordinateError * (max(MaxComponent(abs(P)), ObjectReach) + TraceDistance);
}

// Offsets a hit point along its geometric normal Ng, which faces the side that the next ray leaves to.
vec3 OffsetRayOrigin(vec3 P, vec3 Ng, float ObjectReach, float TraceDistance)
{
	return P + Ng * PositionError(P, ObjectReach, TraceDistance);
}

// Offsets a point that was reconstructed from rasterised depth. The rasteriser snaps vertices to a grid of 1/256 of a pixel
// (VkPhysicalDeviceLimits::subPixelPrecisionBits), by up to half a step. The surface's depth moves with them.
// PixelWidth: width of a pixel at the point, metres. DepthError: of the point along Ng, by its depth's precision, metres.
vec3 OffsetRasterPoint(vec3 P, vec3 Ng, float ObjectReach, float PixelWidth, float DepthError)
{
	return P + Ng * (PositionError(P, ObjectReach, 0.0) + PixelWidth * (1.0 / 256.0) + DepthError);
}

// What a half float holds, nearest to V. Vulkan leaves the rounding of stores to drivers, and some cut off. A mean over frames
// that loses half a digit each time sinks by 1 %.
vec4 RoundToHalf(vec4 V) { return uintBitsToFloat((floatBitsToUint(V) + 0x1000u) & 0xffffe000u); }

#endif
