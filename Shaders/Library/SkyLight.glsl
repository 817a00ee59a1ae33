// Ambient light of the sky: what a Lambert surface of albedo 1 under all of it reflects.
#ifndef LANTERN_SKY_LIGHT_GLSL
#define LANTERN_SKY_LIGHT_GLSL

#include "../Shared/SkyLightTypes.h"
#include "SkyMap.glsl"
#include "SphericalHarmonics.glsl"

// SkyLight: sampled index of what Sky/SkyLight.comp made. NO_TEXTURE: the sky is uniform, or its light is not there yet, and its
// radiance along N stands in.
vec3 SkyAmbient(FSceneConstants Scene, uint SkyLight, vec3 N)
{
	if (SkyLight == NO_TEXTURE) { return SampleSkyRadiance(Scene, N); }
	float Basis[9] = EvaluateHarmonics(N);
	vec3 Light = vec3(0.0);
	for (int Term = 0; Term < SKY_LIGHT_TERMS; ++Term) { Light += Basis[Term] * texelFetch(Textures[SkyLight], ivec2(Term, 0), 0).rgb; }
	return max(Light, vec3(0.0)); // three bands may fall below 0 opposite to a bright side
}

#endif
