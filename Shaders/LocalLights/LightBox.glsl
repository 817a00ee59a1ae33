// Which lights may reach a box of surfaces, and about how much they bring there.
#ifndef LANTERN_LIGHT_BOX_GLSL
#define LANTERN_LIGHT_BOX_GLSL

#include "../Library/Lights.glsl"

// Integers in the order of floats, for atomics.
uint ToOrdered(float F)
{
	uint Bits = floatBitsToUint(F);
	return (Bits & 0x80000000u) != 0u ? ~Bits : Bits | 0x80000000u;
}
float FromOrdered(uint Bits) { return uintBitsToFloat((Bits & 0x80000000u) != 0u ? Bits & 0x7fffffffu : ~Bits); }
vec3 BoxCorner(uint Bits[3]) { return vec3(FromOrdered(Bits[0]), FromOrdered(Bits[1]), FromOrdered(Bits[2])); }

// Whether the light may reach a box: its range does, and its cone a sphere around the box.
bool MayReach(FSceneConstants Scene, FLightData Light, vec3 Low, vec3 High)
{
	if (LightType(Light) == LIGHT_NONE) { return false; }
	if (LightType(Light) == LIGHT_DIRECTIONAL) { return true; }
	vec3 Center = LightPosition(Scene, Light);
	vec3 Outside = max(max(Low - Center, Center - High), vec3(0.0));
	if (Light.Range > 0.0 && dot(Outside, Outside) >= Light.Range * Light.Range) { return false; }
	if ((Light.Flags & LIGHT_HAS_CONE) == 0u) { return true; }
	float Cosine = -Light.SpotOffset / Light.SpotScale; // of the angle at which it is dark
	if (Cosine <= 0.0) { return true; }
	vec3 To = 0.5 * (Low + High) - Center;
	float Along = dot(To, UnpackOct(Light.Direction)), Across = sqrt(max(dot(To, To) - Along * Along, 0.0));
	float Radius = 0.5 * length(High - Low) * 1.001 + 1.0e-3;
	return Cosine * Across - sqrt(max(1.0 - Cosine * Cosine, 0.0)) * Along < Radius && Along > -Radius;
}

const uint BoxPoints = 32u;
shared vec4 BoxSamples[BoxPoints]; // some of the surfaces: position, and size in metres, 0 without a surface

// Returns about the most that the light brings to a plane at any pixel, and never 0 if it reaches one.
float BoundLight(FSceneConstants Scene, FLightData Light, vec3 Low, vec3 High)
{
	uint Type = LightType(Light);
	if (Type == LIGHT_DIRECTIONAL) { return Luminance(Light.Color); }
	vec3 Center = LightPosition(Scene, Light), Outside = max(max(Low - Center, Center - High), vec3(0.0)), Edges = High - Low;
	float DistanceSquared = dot(Outside, Outside), Diagonal = dot(Edges, Edges);
	if (DistanceSquared < 0.25 * Diagonal) // the box may be deep, with a light before what lies behind
	{
		float Nearest = Diagonal + DistanceSquared;
		[[dont_unroll]] for (uint I = 0u; I < BoxPoints; ++I)
		{
			vec3 To = Center - BoxSamples[I].xyz;
			float Size = BoxSamples[I].w, Distance = dot(To, To);
			Nearest = Size > 0.0 ? min(Nearest, max(Distance, Size * Size)) : Nearest;
		}
		DistanceSquared = max(DistanceSquared, Nearest);
	}
	float Form = 1.0 / max(DistanceSquared, 1.0e-8);
#ifdef HAS_AREA_LIGHTS
	if (Type >= LIGHT_RECTANGLE)
	{
		float Reach = LightReach(Type, Light.Size);
		Form = min(Pi * Reach * Reach * Form, Pi);
	}
#endif
	return Luminance(Light.Color) * Form;
}

#endif
