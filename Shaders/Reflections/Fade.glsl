// What the passes of reflections agree on: how these fade out with roughness, and what they are divided by.
#ifndef LANTERN_REFLECTION_FADE_GLSL
#define LANTERN_REFLECTION_FADE_GLSL

#include "../Library/Brdf.glsl"
#include "../Shared/ReflectionTypes.h"

// Returns what radiance is divided by before the filter, and multiplied by behind it.
vec3 LobeAlbedo(FBrdf Lobe, float NdotV, float Roughness) { return max(SpecularReflectance(Lobe, NdotV, Roughness), vec3(1.0e-4)); }

// Returns the share of what is traced, 0 to 1; the rest is that of rough lobes. What would hardly count is not traced.
float ReflectedShare(FReflectionFade Fade, float Roughness)
{
	const float LeastShare = 0.0625;
	float Share = Fade.Slope > 0.0 ? clamp((Fade.End - Roughness) * Fade.Slope, 0.0, 1.0) : 1.0;
	return Share >= LeastShare ? Share : 0.0;
}

#endif
