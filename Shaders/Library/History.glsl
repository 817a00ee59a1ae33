// What passes that carry something over from the frame before share: surfaces in eight bytes, and where a pixel's surface
// was then. A texel of a history counts only if it showed the same surface; those that did share the weight.
#ifndef LANTERN_HISTORY_GLSL
#define LANTERN_HISTORY_GLSL

#include "Bindings.glsl"
#include "Math.glsl"
#include "View.glsl"

// By its bits: isnan and isinf may be optimised away.
#ifndef NO_GUARD // r.RT.Debug.Denoise.Guard
bool IsFinite(float V) { return (floatBitsToUint(V) & 0x7f800000u) != 0x7f800000u; }
#else
bool IsFinite(float V) { return true; }
#endif
bool AreFinite(vec2 V) { return IsFinite(V.x) && IsFinite(V.y); }
bool AreFinite(vec3 V) { return AreFinite(V.xy) && IsFinite(V.z); }
bool AreFinite(vec4 V) { return AreFinite(V.xy) && AreFinite(V.zw); }

struct FSurface
{
	float Distance; // along the view, metres; 0: sky
	vec3 Normal;    // geometric
	float Identity; // of the object, 1 to 63; 0: unknown
};

const float SurfaceNormalSteps = 511.0;

// RG32_FLOAT. y: a whole number below 2^24, which floats hold exactly: 9 + 9 bits of normal, 6 of identity.
vec2 PackSurface(FSurface S)
{
	uvec2 N = uvec2(clamp(OctEncode(S.Normal) * 0.5 + 0.5, 0.0, 1.0) * SurfaceNormalSteps + 0.5);
	return vec2(S.Distance, float(N.x | (N.y << 9u) | (uint(S.Identity) << 18u)));
}

// What is no number is the sky: nothing is ever taken from there.
FSurface UnpackSurface(vec2 P)
{
	if (!AreFinite(P) || P.x <= 0.0) { return FSurface(0.0, vec3(0.0, 0.0, 1.0), 0.0); }
	uint Bits = uint(clamp(P.y, 0.0, 16777215.0));
	vec2 N = vec2(Bits & 511u, (Bits >> 9u) & 511u) / SurfaceNormalSteps * 2.0 - 1.0;
	return FSurface(P.x, OctDecode(N), float(Bits >> 18u));
}

FSurface LoadSurface(uint Texture, ivec2 Pixel) { return UnpackSurface(texelFetch(Textures[nonuniformEXT(Texture)], Pixel, 0).xy); }

// Index: 0: unknown.
float MakeIdentity(float Index) { return Index >= 1.0 && IsFinite(Index) ? mod(Index, 63.0) + 1.0 : 0.0; }

// Whether the texel of the frame before showed what the pixel shows. Expected: how far its surface was then; Slope: how
// much farther it is one pixel on. Normals may have turned with their object by some 45° since.
bool IsSameSurface(FSurface Now, FSurface Before, float Expected, float Slope)
{
#ifdef NO_VALIDATION // r.RT.Debug.Denoise.Validate
	return Before.Distance > 0.0;
#endif
	bool bSameObject = Now.Identity == Before.Identity || Now.Identity == 0.0 || Before.Identity == 0.0;
	return Before.Distance > 0.0 && bSameObject && abs(Before.Distance - Expected) <= Expected * 0.005 + 1.5 * Slope &&
	       dot(Now.Normal, Before.Normal) > 0.7;
}

struct FReprojection
{
	ivec2 Base;     // texel of the first weight; the others are right of it, below it, and both
	vec4 Weights;   // sum 1; all 0: the surface was not seen
	float Known;    // what the sum was of: 1: all four show the surface
	vec2 Fraction;  // of the position between the texels
	float Expected; // how far the surface was …
	float Slope;    // … and how much farther it was one pixel on
};

ivec2 GetTap(FReprojection R, int Tap) { return R.Base + ivec2(Tap & 1, Tap >> 1); }

// Motion: as in FGBuffer. ToCamera: direction from the surface to the camera, unit length.
FReprojection Reproject(FViewConstants View, uint PreviousSurface, uvec2 Pixel, FSurface Now, vec4 Motion, vec3 ToCamera)
{
	FReprojection R = FReprojection(ivec2(0), vec4(0.0), 0.0, vec2(0.0), Motion.z, 0.0);
	if (!AreFinite(Motion) || Motion.z <= 0.0 || Now.Distance <= 0.0) { return R; }
	vec2 Position = vec2(Pixel) + Motion.xy;
#ifdef NO_VALIDATION
	Position = clamp(Position, vec2(0.0), vec2(View.Width, View.Height) - 1.0);
#endif
	if (any(lessThan(Position, vec2(-1.0))) || any(greaterThan(Position, vec2(View.Width, View.Height)))) { return R; }
	vec2 Corner = floor(Position), F = Position - Corner;
	R.Base = ivec2(Corner);
	float Cosine = max(abs(dot(Now.Normal, ToCamera)), 0.03);
	R.Fraction = F;
	R.Slope = Motion.z * PixelAngle(View) * sqrt(1.0 - min(Cosine * Cosine, 1.0)) / Cosine;
	vec4 Bilinear = vec4((1.0 - F.x) * (1.0 - F.y), F.x * (1.0 - F.y), (1.0 - F.x) * F.y, F.x * F.y);
	for (int Tap = 0; Tap < 4; ++Tap)
	{
		ivec2 P = GetTap(R, Tap);
		bool bInside = all(greaterThanEqual(P, ivec2(0))) && all(lessThan(P, ivec2(View.Width, View.Height)));
		if (bInside && IsSameSurface(Now, LoadSurface(PreviousSurface, P), Motion.z, R.Slope)) { R.Weights[Tap] = Bilinear[Tap]; }
	}
	R.Known = dot(R.Weights, vec4(1.0));
	R.Weights = R.Known > 0.01 ? R.Weights / R.Known : vec4(0.0);
	return R;
}

// Weights of four texels in a row around a position F behind the second (Catmull & Rom 1974). Bilinear weights blur what is
// resampled frame after frame by some pixels; these hardly do.
vec4 CubicWeights(float F)
{
	return vec4(((2.0 - F) * F - 1.0) * F, (3.0 * F - 5.0) * F * F + 2.0, ((4.0 - 3.0 * F) * F + 1.0) * F, (F - 1.0) * F * F) * 0.5;
}

#endif
