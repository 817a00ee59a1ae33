// How reflections fade out with roughness.
#ifndef LANTERN_REFLECTION_FADE_GLSL
#define LANTERN_REFLECTION_FADE_GLSL

#include "../Shared/ReflectionTypes.h"

// Returns the share of what is traced, 0 to 1; the rest is that of rough lobes. What would hardly count is not traced.
float ReflectedShare(FReflectionFade Fade, float Roughness)
{
	const float LeastShare = 0.0625;
	float Share = Fade.Slope > 0.0 ? clamp((Fade.End - Roughness) * Fade.Slope, 0.0, 1.0) : 1.0;
	return Share >= LeastShare ? Share : 0.0;
}

#endif
