// Reprojection, for passes that carry something over from the previous frame: packed surfaces, and where a pixel's surface was.
// A texel of a history counts only if it showed the same surface. The texels that did share the weight.
#ifndef LANTERN_HISTORY_GLSL
#define LANTERN_HISTORY_GLSL

#include "Bindings.glsl"
#include "Math.glsl"
#include "UintTextures.glsl"
#include "View.glsl"

// Tests the bits, because compilers may optimise isnan and isinf away.
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
	float Identity; // number of the object, 1 to 63; 0: unknown
};

const float SurfaceNormalSteps = 511.0;

// Texel of an RG32_FLOAT image. x: distance. y: a whole number below 2^24, which floats hold exactly: 9 + 9 bits of normal,
// 6 of identity.
vec2 PackSurface(FSurface S)
{
	uvec2 N = uvec2(clamp(OctEncode(S.Normal) * 0.5 + 0.5, 0.0, 1.0) * SurfaceNormalSteps + 0.5);
	return vec2(S.Distance, float(N.x | (N.y << 9u) | (uint(S.Identity) << 18u)));
}

// A texel that is not finite counts as sky, from which nothing is ever taken.
FSurface UnpackSurface(vec2 P)
{
	if (!AreFinite(P) || P.x <= 0.0) { return FSurface(0.0, vec3(0.0, 0.0, 1.0), 0.0); }
	uint Bits = uint(clamp(P.y, 0.0, 16777215.0));
	vec2 N = vec2(Bits & 511u, (Bits >> 9u) & 511u) / SurfaceNormalSteps * 2.0 - 1.0;
	return FSurface(P.x, OctDecode(N), float(Bits >> 18u));
}

FSurface LoadSurface(uint Texture, ivec2 Pixel) { return UnpackSurface(texelFetch(Textures[nonuniformEXT(Texture)], Pixel, 0).xy); }

// Index: number of the object as motion vectors carry it; 0: unknown.
float MakeIdentity(float Index) { return Index >= 1.0 && IsFinite(Index) ? mod(Index, 63.0) + 1.0 : 0.0; }

const float SameDistance = 0.005, SimilarDistance = 0.03; // over the distance

// Whether a texel of the previous frame showed the pixel's object, at about its distance. ExpectedDistance: distance of the pixel's surface
// in the previous frame. DistanceSlope: change of the distance from one pixel to the next. Tolerance: over the distance.
bool IsSameObject(FSurface Now, FSurface Before, float ExpectedDistance, float DistanceSlope, float Tolerance)
{
#ifdef NO_VALIDATION // r.RT.Debug.Denoise.Validate
	return Before.Distance > 0.0;
#else
	bool bSameObject = Now.Identity == Before.Identity || Now.Identity == 0.0 || Before.Identity == 0.0;
	return Before.Distance > 0.0 && bSameObject && abs(Before.Distance - ExpectedDistance) <= ExpectedDistance * Tolerance + 1.5 * DistanceSlope;
#endif
}

// Normals may have turned by some 45° with their object.
bool HasSameNormal(FSurface Now, FSurface Before)
{
#ifdef NO_VALIDATION
	return true;
#else
	return dot(Now.Normal, Before.Normal) > 0.7;
#endif
}

// Whether a texel of the previous frame showed the pixel's surface. Parameters: as IsSameObject.
bool IsSameSurface(FSurface Now, FSurface Before, float ExpectedDistance, float DistanceSlope)
{
	return IsSameObject(Now, Before, ExpectedDistance, DistanceSlope, SameDistance) && HasSameNormal(Now, Before);
}

// Where a pixel's surface was in the previous frame, and which of the four texels around that position showed it.
struct FReprojection
{
	ivec2 Base;     // first texel; the others are right of it, below it, and both
	vec4 Weights;   // bilinear, over the texels that showed the surface; sum 1. All 0: the surface was not seen
	float Coverage; // sum of the weights before they were made to sum to 1; 1: all four texels showed the surface
	vec2 Fraction;  // position between the texels, 0 to 1
};

ivec2 GetTap(ivec2 Base, int Tap) { return Base + ivec2(Tap & 1, Tap >> 1); }
ivec2 GetTap(FReprojection R, int Tap) { return GetTap(R.Base, Tap); }

const FReprojection NotSeen = FReprojection(ivec2(0), vec4(0.0), 0.0, vec2(0.0));

// Texel of an RG32_UINT image, which one pass makes for all that reproject (Denoise/Surface.comp): for each axis, 16 bits of the first texel
// plus 1 and 12 of the fraction; in the lowest 4 bits of x, the texels that showed the surface, and in those of y the ones that surely
// showed the object at about its distance. None: it was not seen.
const float ReprojectionSteps = 4096.0;

FReprojection UnpackReprojection(uvec2 Packed)
{
	uint Taps = Packed.x & 15u;
	if (Taps == 0u) { return NotSeen; }
	FReprojection R;
	R.Base = ivec2(Packed >> 16u) - 1;
	R.Fraction = vec2((Packed >> 4u) & 4095u) / ReprojectionSteps;
	vec2 F = R.Fraction;
	R.Weights = vec4((1.0 - F.x) * (1.0 - F.y), F.x * (1.0 - F.y), (1.0 - F.x) * F.y, F.x * F.y);
	for (int Tap = 0; Tap < 4; ++Tap) { R.Weights[Tap] = (Taps & (1u << Tap)) != 0u ? R.Weights[Tap] : 0.0; }
	R.Coverage = dot(R.Weights, vec4(1.0));
	R.Weights = R.Coverage > 0.01 ? R.Weights / R.Coverage : vec4(0.0);
	return R;
}

FReprojection LoadReprojection(uint Texture, ivec2 Pixel) { return UnpackReprojection(texelFetch(UintTextures[Texture], Pixel, 0).xy); }

// Where the history of a pixel lies. A history that is read between texels, frame after frame, is blurred. One that is moved from texel to
// texel is not: each pixel takes the nearest one as it is, and remembers how far from its centre that one lies on the surface.
// Texel of an RG32_UINT image (Denoise/Surface.comp). x: bits 0 to 14 and 15 to 29: texel of the previous frame; bit 30: it showed another
// surface of the object, or a place that is a pixel away; bit 31: there is one. y: two 16-bit snorm: the place from the pixel's centre, pixels.
// Bit 0 of y: the previous frame had another size. The place is in its pixels then, and histories are read between its texels, so that they
// are of the centre for those who come next.
struct FAnchor
{
	ivec2 Texel;
	bool bFound, bOther;
	vec2 Offset; // of its place from the pixel's centre, pixels of the previous frame
};

const uint AnchorFound = 0x80000000u, AnchorOther = 0x40000000u, AnchorResampled = 1u;

FAnchor UnpackAnchor(uvec2 Packed)
{
	return FAnchor(ivec2(Packed.x & 32767u, (Packed.x >> 15u) & 32767u), (Packed.x & AnchorFound) != 0u, (Packed.x & AnchorOther) != 0u,
	               unpackSnorm2x16(Packed.y));
}

// Returns how many frames the history of an anchor's texel is worth. Frames: of the texel.
float GetAnchoredFrames(FAnchor Anchor, float Frames)
{
	const float WorthOfOthers = 0.25, MostFramesOfOthers = 16.0; // of a history that is another surface's
	return Anchor.bOther ? min(WorthOfOthers * Frames, MostFramesOfOthers) : Frames;
}

FAnchor LoadAnchor(uint Texture, ivec2 Pixel) { return UnpackAnchor(texelFetch(UintTextures[Texture], Pixel, 0).xy); }

// Returns the texel of a pixel. Texels that showed its object and not its surface count where there is none that did: leaves and reliefs are
// seldom seen twice. Previous: sampled index of the previous frame's anchors; NO_TEXTURE: all places were centres. Reprojection: see
// FindReprojection.
uvec2 FindAnchor(FViewConstants View, uint Previous, uvec2 Reprojection)
{
	const float TowardsCenter = 0.97; // new values are of centres
	const float FarAway = 1.0;        // pixels
	uint Same = Reprojection.x & 15u, Taps = Same != 0u ? Same : Reprojection.y & 15u;
	if (Taps == 0u) { return uvec2(0u); }
	ivec2 Base = ivec2(Reprojection >> 16u) - 1, Texel = Base;
	vec2 Fraction = vec2((Reprojection >> 4u) & 4095u) / ReprojectionSteps, Offset = vec2(0.0);
	float Least = 1.0e9;
	for (int Tap = 0; Tap < 4; ++Tap)
	{
		if ((Taps & (1u << Tap)) == 0u) { continue; }
		ivec2 P = GetTap(Base, Tap);
		vec2 Its = vec2(GetTap(ivec2(0), Tap)) - Fraction;
		if (Previous != NO_TEXTURE)
		{
			uint Before = texelFetch(UintTextures[Previous], P, 0).y;
			Its += (Before & AnchorResampled) == 0u ? unpackSnorm2x16(Before) : vec2(0.0);
		}
		if (dot(Its, Its) >= Least) { continue; }
		Least = dot(Its, Its);
		Offset = Its;
		Texel = P;
	}
	bool bSurely = Same != 0u && Least < FarAway * FarAway;
	bool bResampled = View.Width != View.PreviousWidth || View.Height != View.PreviousHeight;
	if (!bResampled) { Offset *= TowardsCenter; }
	uint Packed = packSnorm2x16(clamp(Offset, vec2(-1.0), vec2(1.0))) & ~AnchorResampled;
	return uvec2(uint(Texel.x) | (uint(Texel.y) << 15u) | AnchorFound | (bSurely ? 0u : AnchorOther),
	             Packed | (bResampled ? AnchorResampled : 0u));
}

// What a texel of the previous frame must show to be of the pixel's surface.
struct FExpectedSurface
{
	FSurface Surface;
	float Distance;      // in the previous frame, along the view, metres
	float DistanceSlope; // its change from one pixel to the next, metres
};

// Motion: a texel of FGBuffer::Motion.
FExpectedSurface ExpectSurface(FViewConstants View, uvec2 Pixel, FSurface Now, vec4 Motion)
{
	float Cosine = max(abs(dot(Now.Normal, CameraRay(View, vec2(Pixel) + 0.5))), 0.03);
	return FExpectedSurface(Now, Motion.z, PixelHeight(View, Motion.z) * sqrt(1.0 - min(Cosine * Cosine, 1.0)) / Cosine);
}

bool ShowedSurface(FExpectedSurface Expected, uint PreviousSurface, ivec2 Texel)
{
	return IsSameSurface(Expected.Surface, LoadSurface(PreviousSurface, Texel), Expected.Distance, Expected.DistanceSlope);
}

// Returns a texel for UnpackReprojection. Motion: a texel of FGBuffer::Motion. Spread: how much faster the distance changes from pixel to
// pixel than on the surface's plane.
uvec2 FindReprojection(FViewConstants View, uint PreviousSurface, uvec2 Pixel, FSurface Now, vec4 Motion, float Spread)
{
	if (!AreFinite(Motion) || Motion.z <= 0.0 || Now.Distance <= 0.0) { return uvec2(0u); }
	vec2 Position = vec2(Pixel) + Motion.xy, Size = vec2(View.PreviousWidth, View.PreviousHeight);
	// The pixel's centre counts where the resolution has changed. The test keeps rounding away where it has not.
	if (View.PreviousWidth != View.Width || View.PreviousHeight != View.Height)
	{
		Position = (Position + 0.5) * Size / vec2(View.Width, View.Height) - 0.5;
	}
#ifdef NO_VALIDATION
	Position = clamp(Position, vec2(0.0), Size - 1.0);
#endif
	if (any(lessThan(Position, vec2(-1.0))) || any(greaterThan(Position, Size))) { return uvec2(0u); }
	Position = floor(Position * ReprojectionSteps + 0.5) / ReprojectionSteps;
	ivec2 Base = ivec2(floor(Position));
	FExpectedSurface Expected = ExpectSurface(View, Pixel, Now, Motion);
	Expected.DistanceSlope *= Spread;
	uvec2 Taps = uvec2(0u); // of the surface, of its object
	for (int Tap = 0; Tap < 4; ++Tap)
	{
		ivec2 P = GetTap(Base, Tap);
		if (any(lessThan(P, ivec2(0))) || any(greaterThanEqual(P, ivec2(Size)))) { continue; }
		FSurface Before = LoadSurface(PreviousSurface, P);
		if (!IsSameObject(Now, Before, Expected.Distance, Expected.DistanceSlope, SimilarDistance)) { continue; }
		if (Now.Identity != 0.0 && Before.Identity != 0.0) { Taps.y |= 1u << Tap; }
		if (IsSameSurface(Now, Before, Expected.Distance, Expected.DistanceSlope)) { Taps.x |= 1u << Tap; }
	}
	uvec2 Fraction = uvec2((Position - vec2(Base)) * ReprojectionSteps + 0.5);
	return any(notEqual(Taps, uvec2(0u))) ? ((uvec2(Base + 1) << 16u) | (Fraction << 4u) | Taps) : uvec2(0u);
}

// Weights of four texels in a row for a position at F, 0 to 1, between the second and the third (Catmull & Rom 1974). Bilinear
// weights blur by some pixels what is resampled frame after frame. Cubic weights hardly blur it.
vec4 CubicWeights(float F)
{
	return vec4(((2.0 - F) * F - 1.0) * F, (3.0 * F - 5.0) * F * F + 2.0, ((4.0 - 3.0 * F) * F + 1.0) * F, (F - 1.0) * F * F) * 0.5;
}

#endif
