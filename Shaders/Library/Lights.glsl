// Punctual lights, KHR_lights_punctual.
#ifndef LANTERN_LIGHTS_GLSL
#define LANTERN_LIGHTS_GLSL

#include "Bindings.glsl"
#include "Math.glsl"

// Irradiance of a plane facing the light at P; direction towards it, and how far it is.
vec3 PunctualIrradiance(FLightData Light, vec3 P, out vec3 Towards, out float Distance)
{
	if (Light.Type == LIGHT_DIRECTIONAL)
	{
		Towards = -Light.Direction;
		Distance = 1.0e30;
		return Light.Color;
	}
	Towards = Light.Position - P;
	float Distance2 = max(dot(Towards, Towards), 1.0e-12);
	Distance = sqrt(Distance2);
	Towards /= Distance;
	float Attenuation = 1.0 / Distance2;
	if (Light.Range > 0.0)
	{
		float Ratio = Distance2 / (Light.Range * Light.Range);
		Attenuation *= clamp(1.0 - Ratio * Ratio, 0.0, 1.0);
	}
	if (Light.Type == LIGHT_SPOT)
	{
		float Angular = clamp(-dot(Light.Direction, Towards) * Light.SpotScale + Light.SpotOffset, 0.0, 1.0);
		Attenuation *= Angular * Angular;
	}
	return Light.Color * Attenuation;
}

#endif
