// Styles of objects: how diffuse indirect light falls on them. FToonStyle says what each member does.
// NO_TOON_KNEE: planted fault (r.RT.Debug.GI.ToonKnee).
#ifndef LANTERN_TOON_GLSL
#define LANTERN_TOON_GLSL

#include "Bindings.glsl"
#include "Math.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FToonRef { FToonData Data[]; };

const float ToonKnee = 0.2; // share of a limit over which values bend towards it

// Texel of the pixel in the texture that ToonSurface.comp writes. 0: it shows no object with a style.
uint ToonOfPixel(vec2 Texel) { return uint(Texel.y); }
FToonData LoadToon(FSceneConstants Scene, uint Toon) { return FToonRef(Scene.ToonStyles).Data[Toon - 1u]; }

// Returns X where it is far below Limit, and at most Limit, without a kink: ramps of an engine would show one.
float SoftLimit(float X, float Limit)
{
#ifdef NO_TOON_KNEE
	return min(X, Limit);
#else
	float Begin = (1.0 - ToonKnee) * Limit, Room = ToonKnee * Limit;
	return X <= Begin ? X : Begin + Room * (1.0 - exp((Begin - X) / Room));
#endif
}

// L: irradiance / π. Exposure: from nits to the picture; 0: unknown, and values have no limit.
vec3 LimitToonLight(FToonData Toon, vec3 L, float Exposure)
{
	float Value = max(max(L.r, L.g), L.b);
	if (Value <= 0.0) { return L; }
	vec3 Missing = 1.0 - L / Value; // the greatest is the saturation; their ratios are the hue
	float Saturation = max(max(Missing.r, Missing.g), Missing.b);
	float Limited = Toon.MaxSaturation < 1.0 ? SoftLimit(Saturation, Toon.MaxSaturation) : Saturation;
	if (Saturation > 0.0) { Missing *= Limited / Saturation; }
	bool bLimits = Exposure > 0.0 && Toon.MaxValue > 0.0;
	float Shown = bLimits ? SoftLimit(Value * Exposure, Toon.MaxValue) / Exposure : Value;
	return Shown * (1.0 - Missing);
}

// Returns what an object with the style shows of the light that its pixel has gathered.
vec3 GradeToonLight(FToonData Toon, vec3 L, float Exposure)
{
	return LimitToonLight(Toon, L, Exposure) * (Toon.Tint / Luminance(Toon.Tint));
}

// By how much light over a cosine about N grows if what lies below the surface is as bright as the rest, and not dark. The share of a
// cosine's lobe on one side of a plane is (1 + cosine of the angle between their normals) / 2.
float ToonHorizon(vec3 N, vec3 Ng) { return 2.0 / (1.0 + clamp(dot(N, Ng), 0.0, 1.0)); }

#endif
