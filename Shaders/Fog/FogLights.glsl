// Light of local lights in a froxel: one of them is chosen, by what it brings, and its ray traced. For FogShadow.glsl.
#ifndef LANTERN_FOG_LIGHTS_GLSL
#define LANTERN_FOG_LIGHTS_GLSL

#include "../Library/LightCells.glsl"
#include "../Library/Lights.glsl"
#include "../Library/Phase.glsl"

// Returns what a light brings to P, were it not shadowed, over the scattering coefficient. Radius: of the froxel, metres.
vec3 ScatterLight(FSceneConstants Scene, FLightData Light, vec3 P, vec3 Direction, float Radius, float G, vec2 U, out FLightSample Sample)
{
	Sample = SampleLight(Scene, Light, P, U);
	if (MaxComponent(Sample.Irradiance) <= 0.0) { return vec3(0.0); }
	vec3 Irradiance = Sample.Irradiance;
	// The mean of 1/d² in a ball around the light: its samples would be bright without limit.
	if (LightType(Light) == LIGHT_POINT && Sample.Distance < Radius) { Irradiance *= 3.0 * Sample.Distance * Sample.Distance / (Radius * Radius); }
	return Irradiance * PhaseFunction(dot(Sample.Direction, Direction), G);
}

// Returns the share of its light that arrives.
float SeesFogLight(FSceneConstants Scene, FLightData Light, FLightSample Sample, vec3 P)
{
	if ((Light.Flags & LIGHT_CASTS_SHADOW) == 0u) { return 1.0; }
	return UnblockedShare(P, Sample.Direction, LightRayLength(Sample, P, Scene.ObjectReach), LocalCasters(false));
}

// Direction: of the camera's ray, unit length.
vec3 TraceFogLight(FSceneConstants Scene, vec3 P, vec3 Direction, float Radius, float G, inout FRandom Random)
{
	vec4 Numbers = NextRandom4(Random);
	float U = Numbers.x, Total = 0.0, Chosen = 0.0;
	uint Choice = NoLight;
	FLightSample Sample;
	FLightRef Lights = FLightRef(Scene.Lights);
	FLightWalk Walk = WalkLightsOfTurn(Scene, P, true, 0u);
	for (uint I = NextLight(Walk); I < Scene.LightCount; I = NextLight(Walk))
	{
		FLightData Light = Lights.Data[I];
		if ((Light.Flags & LIGHT_IN_FOG) == 0u) { continue; } // nor has a free slot this flag
		float Weight = Luminance(ScatterLight(Scene, Light, P, Direction, Radius, G, Numbers.yz, Sample));
		if (!(Weight > 0.0)) { continue; }
		Total += Weight;
		float Probability = Weight / Total;
		bool bTake = U < Probability;
		U = min(bTake ? U / Probability : (U - Probability) / (1.0 - Probability), 0.99999994);
		if (bTake)
		{
			Choice = I;
			Chosen = Weight;
		}
	}
	if (Choice == NoLight) { return vec3(0.0); }
	// Made again rather than kept: registers that live across the walk cost more.
	vec3 Light = ScatterLight(Scene, Lights.Data[Choice], P, Direction, Radius, G, Numbers.yz, Sample);
	return Light * (Total / Chosen * SeesFogLight(Scene, Lights.Data[Choice], Sample, P));
}

#endif
