// Lights other than sun and sky: what a surface receives of each. Point, spot and directional lights are those of
// KHR_lights_punctual, and may have a profile. HAS_AREA_LIGHTS: defined if some light has an extent; each is then sampled at one point.
#ifndef LANTERN_LIGHTS_GLSL
#define LANTERN_LIGHTS_GLSL

#include "Bindings.glsl"
#include "LightProfile.glsl"
#include "Math.glsl"
#ifdef HAS_AREA_LIGHTS
#include "LightShapes.glsl"
#endif

uint LightType(FLightData Light) { return Light.Flags & LIGHT_TYPE_MASK; }

// Returns the position relative to the scene's origin. Integers wrap around, and so do the positions.
vec3 LightPosition(FSceneConstants Scene, FLightData Light)
{
	ivec3 Origin = Scene.OriginCell * int(CELL_SIZE * LIGHT_POSITION_STEPS) + ivec3(Scene.OriginInCell * LIGHT_POSITION_STEPS);
	return vec3(Light.Position - Origin) * (1.0 / LIGHT_POSITION_STEPS);
}

// Returns the share of the light that its range and its cone let through. ToCenter: from the surface, metres.
float LightAttenuation(FLightData Light, vec3 ToCenter)
{
	float DistanceSquared = max(dot(ToCenter, ToCenter), 1.0e-12);
	float Attenuation = 1.0;
	if (Light.Range > 0.0)
	{
		float Ratio = DistanceSquared / (Light.Range * Light.Range);
		if (Ratio >= 1.0) { return 0.0; } // most lights, in a scene of many
		Attenuation = 1.0 - Ratio * Ratio;
	}
	if ((Light.Flags & LIGHT_HAS_CONE) != 0u)
	{
		float Cosine = -dot(UnpackOct(Light.Direction), ToCenter) * inversesqrt(DistanceSquared);
		float Angular = clamp(Cosine * Light.SpotScale + Light.SpotOffset, 0.0, 1.0);
		Attenuation *= Angular * Angular;
	}
	return Attenuation;
}

// A point of a light, as a surface sees it.
struct FLightSample
{
	vec3 Direction; // towards the point, unit length
	float Distance; // metres; 1e30: directional
	vec3 Irradiance; // of a plane that faces the point if all of the light shone from it, so that BRDF · cosine · Irradiance has
	                 // the right mean; 0: the point does not shine here
	float Cosine;   // at the light's surface, at least 0.1; 1 without extent
};

const float LightInfinity = 1.0e30;

// Returns the point of a light without extent.
FLightSample SamplePointLight(FSceneConstants Scene, FLightData Light, vec3 ToCenter)
{
	if (LightType(Light) == LIGHT_DIRECTIONAL) { return FLightSample(-UnpackOct(Light.Direction), LightInfinity, Light.Color, 1.0); }
	float DistanceSquared = max(dot(ToCenter, ToCenter), 1.0e-12);
	float Distance = sqrt(DistanceSquared), Attenuation = LightAttenuation(Light, ToCenter);
	vec3 Direction = ToCenter / Distance;
	if (Attenuation > 0.0) { Attenuation *= LightProfile(Scene, Light, -Direction); }
	return FLightSample(Direction, Distance, Light.Color * (Attenuation / DistanceSquared), 1.0);
}

// Samples a point of a light as seen from P, in coordinates relative to the scene's origin. U in [0, 1).
FLightSample SampleLight(FSceneConstants Scene, FLightData Light, vec3 P, vec2 U)
{
	vec3 ToCenter = LightPosition(Scene, Light) - P;
#ifdef HAS_AREA_LIGHTS
	uint Type = LightType(Light);
	vec3 Normal = UnpackOct(Light.Direction);
	if (Type == LIGHT_DIRECTIONAL && Light.Size.x > 0.0)
	{
		// A plane that faces a disk of angular radius r receives π sin²r times its radiance, over 2π (1 − cos r) of solid angle.
		return FLightSample(MakeBasis(-Normal) * SampleCone(U, Light.Size.x), LightInfinity, Light.Color * (2.0 / (2.0 - Light.Size.x)), 1.0);
	}
	if (Type >= LIGHT_RECTANGLE)
	{
		FLightSample Sample;
		float SolidAngle;
		bool bTwoSided = (Light.Flags & LIGHT_TWO_SIDED) != 0u;
		if (Type == LIGHT_RECTANGLE)
		{
			vec3 Tangent = UnpackOct(Light.Tangent);
			SolidAngle = SampleRectangle(ToCenter, Tangent, Normal, Light.Size, bTwoSided, U, Sample.Direction, Sample.Distance);
		}
		else if (Type == LIGHT_DISK) { SolidAngle = SampleDiskLight(ToCenter, Normal, Light.Size.x, bTwoSided, U, Sample.Direction, Sample.Distance); }
		else if (Type == LIGHT_SPHERE) { SolidAngle = SampleSphere(ToCenter, Light.Size.x, U, Sample.Direction, Sample.Distance); }
		else { SolidAngle = SampleTube(ToCenter, UnpackOct(Light.Tangent), Light.Size.x, Light.Size.y, U, Sample.Direction, Sample.Distance); }
		bool bFlat = Type == LIGHT_RECTANGLE || Type == LIGHT_DISK;
		Sample.Cosine = max(bFlat ? abs(dot(Normal, Sample.Direction)) : 0.3, 0.1); // round lights are seen at all angles
#ifdef HALF_LIGHT_AREA // r.RT.Debug.Lights.Area
		SolidAngle *= 0.5;
#endif
		Sample.Irradiance = Light.Color * (SolidAngle * LightAttenuation(Light, ToCenter));
		return Sample;
	}
#else
	if (LightType(Light) >= LIGHT_RECTANGLE) { return FLightSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 1.0); } // until its shader is there
#endif
	return SamplePointLight(Scene, Light, ToCenter);
}

// Returns the length of a shadow ray to the point. It stops short of a surface that stands for the light, the more so the more grazing
// it arrives. ObjectReach: see OffsetRayOrigin.
float LightRayLength(FLightSample Sample, vec3 P, float ObjectReach)
{
	if (Sample.Distance >= LightInfinity) { return LightInfinity; }
	float Step = 1.0 / LIGHT_POSITION_STEPS;
	float Margin = (PositionError(P + Sample.Direction * Sample.Distance, ObjectReach, Sample.Distance) + Step) / Sample.Cosine;
	return max(Sample.Distance - Margin, 0.0);
}

// Returns the luminance of what a plane at P that faces the light receives. It is exact for lights without extent, and a guess for
// others. It is 0 only where the light brings nothing to a surface of normal Ng.
float EstimateLight(FSceneConstants Scene, FLightData Light, vec3 P, vec3 Ng)
{
	vec3 ToCenter = LightPosition(Scene, Light) - P;
	uint Type = LightType(Light);
#ifdef HAS_AREA_LIGHTS
	if (Type >= LIGHT_RECTANGLE)
	{
		float Reach = LightReach(Type, Light.Size);
		if (dot(ToCenter, Ng) + Reach <= 0.0) { return 0.0; }
		float Area = LightProjectedArea(Type, Light.Size, ToCenter, UnpackOct(Light.Direction), (Light.Flags & LIGHT_TWO_SIDED) != 0u);
		// No light covers more than a hemisphere, which brings π times the radiance.
		float Form = min(Area / max(dot(ToCenter, ToCenter), 1.0e-12), Pi);
		return Luminance(Light.Color) * Form * LightAttenuation(Light, ToCenter);
	}
#else
	if (Type >= LIGHT_RECTANGLE) { return 0.0; } // dark until its shader is there
#endif
	if (Type == LIGHT_NONE) { return 0.0; }
	FLightSample Sample = SamplePointLight(Scene, Light, ToCenter);
	float Below = 0.0; // sine of the angle by which a light may stand below the horizon
#ifdef HAS_AREA_LIGHTS
	if (Type == LIGHT_DIRECTIONAL) { Below = sqrt(max(Light.Size.x * (2.0 - Light.Size.x), 0.0)); }
#endif
	return dot(Sample.Direction, Ng) + Below > 0.0 ? Luminance(Sample.Irradiance) : 0.0;
}

#endif
