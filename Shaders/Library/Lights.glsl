// Punctual lights, KHR_lights_punctual.
#ifndef LANTERN_LIGHTS_GLSL
#define LANTERN_LIGHTS_GLSL

#include "Bindings.glsl"
#include "Math.glsl"

// Returns the irradiance of a plane at P that faces the light. ToLight: unit length; Distance: metres, 1e30 if directional.
vec3 PunctualIrradiance(FLightData Light, vec3 P, out vec3 ToLight, out float Distance)
{
	if (Light.Type == LIGHT_DIRECTIONAL)
	{
		ToLight = -Light.Direction;
		Distance = 1.0e30;
		return Light.Color;
	}
	ToLight = Light.Position - P;
	float DistanceSquared = max(dot(ToLight, ToLight), 1.0e-12);
	Distance = sqrt(DistanceSquared);
	ToLight /= Distance;
	float Attenuation = 1.0 / DistanceSquared;
	if (Light.Range > 0.0)
	{
		float Ratio = DistanceSquared / (Light.Range * Light.Range);
		Attenuation *= clamp(1.0 - Ratio * Ratio, 0.0, 1.0);
	}
	if (Light.Type == LIGHT_SPOT)
	{
		float Angular = clamp(-dot(Light.Direction, ToLight) * Light.SpotScale + Light.SpotOffset, 0.0, 1.0);
		Attenuation *= Angular * Angular;
	}
	return Light.Color * Attenuation;
}

#endif
