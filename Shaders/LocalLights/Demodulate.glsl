// Light without the surface's colours.
#ifndef LANTERN_DEMODULATE_GLSL
#define LANTERN_DEMODULATE_GLSL

#include "LocalPoint.glsl"

// Divides by the lobes' albedos, so that filters see light and not textures.
FLobes Demodulate(FLobes Sum, FBrdf Brdf, float NdotV, float Roughness)
{
	Sum.Diffuse /= max(DiffuseReflectance(Brdf, NdotV), vec3(1.0e-4));
	Sum.Specular /= max(SpecularReflectance(Brdf, NdotV, Roughness), vec3(1.0e-4));
	return Sum;
}

#endif
