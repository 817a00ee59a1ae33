// Next-event estimation, one function per kind of light. Include PathTracing.glsl, which declares what this needs.
#ifndef LANTERN_PATH_LIGHTS_GLSL
#define LANTERN_PATH_LIGHTS_GLSL

bool IsVisible(FSceneConstants Scene, vec3 Origin, vec3 Direction, float Distance)
{
	ShadowPayload.Blocker = BlockedAnywhere;
	traceRayEXT(Scenes[Scene.Tlas], gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT, MASK_CASTS_SHADOW, SHADOW_RAY,
	            RAY_TYPES, SHADOW_MISS, Origin, 0.0, Direction, Distance, 1);
	return IsVisible(ShadowPayload);
}

#ifdef HAS_SUN
vec3 SampleSun(FSceneConstants Scene, FBrdf B, mat3 Basis, vec3 V, vec3 P, vec3 Ng, vec2 U)
{
	bool bPoint = Scene.SunOneMinusCos <= 0.0;
	vec3 Towards = bPoint ? -Scene.SunDirection : SampleSunDirection(Scene, U);
	if (dot(Towards, Ng) <= 0.0) { return vec3(0.0); }
	vec3 Local = Towards * Basis;
	vec3 F = EvaluateBrdfCos(B, V, Local);
	if (MaxComponent(F) <= 0.0 || !IsVisible(Scene, P, Towards, 1.0e30)) { return vec3(0.0); }
	if (bPoint) { return F * Scene.SunColor * Scene.SunIrradiance; }
	float Density = SunDensity(Scene);
	return F * SunRadiance(Scene) * (PowerHeuristic(Density, BrdfDensity(B, V, Local)) / Density);
}
#endif

#ifdef HAS_SKY
vec3 SampleSky(FSceneConstants Scene, FBrdf B, mat3 Basis, vec3 V, vec3 P, vec3 Ng, vec2 U)
{
	vec3 Local = SampleCosineHemisphere(U);
	vec3 Towards = Basis * Local;
	if (Local.z <= 0.0 || dot(Towards, Ng) <= 0.0) { return vec3(0.0); }
	vec3 F = EvaluateBrdfCos(B, V, Local);
	if (MaxComponent(F) <= 0.0 || !IsVisible(Scene, P, Towards, 1.0e30)) { return vec3(0.0); }
	float Density = Local.z / Pi;
	return F * Scene.SkyRadiance * (PowerHeuristic(Density, BrdfDensity(B, V, Local)) / Density);
}
#endif

#ifdef HAS_LIGHTS
// One light, chosen by its unshadowed irradiance: weighted reservoir over all of them.
vec3 SamplePunctual(FSceneConstants Scene, FBrdf B, mat3 Basis, vec3 V, vec3 P, vec3 Ng, float U)
{
	FLightRef Lights = FLightRef(Scene.Lights);
	float Total = 0.0, ChosenWeight = 0.0, ChosenDistance = 0.0;
	vec3 ChosenIrradiance = vec3(0.0), ChosenTowards = vec3(0.0);
	for (uint I = 0; I < Scene.LightCount; ++I)
	{
		vec3 Towards;
		float Distance;
		vec3 Irradiance = PunctualIrradiance(Lights.Data[I], P, Towards, Distance);
		float Weight = Luminance(Irradiance);
		if (Weight <= 0.0 || dot(Towards, Ng) <= 0.0) { continue; }
		Total += Weight;
		float Chance = Weight / Total;
		if (U < Chance)
		{
			U /= Chance;
			ChosenWeight = Weight;
			ChosenIrradiance = Irradiance;
			ChosenTowards = Towards;
			ChosenDistance = Distance;
		}
		else { U = (U - Chance) / (1.0 - Chance); }
		U = min(U, 0.99999994);
	}
	if (ChosenWeight <= 0.0) { return vec3(0.0); }
	vec3 F = EvaluateBrdfCos(B, V, ChosenTowards * Basis);
	if (MaxComponent(F) <= 0.0 || !IsVisible(Scene, P, ChosenTowards, ChosenDistance)) { return vec3(0.0); }
	return F * ChosenIrradiance * (Total / ChosenWeight);
}
#endif

#ifdef HAS_EMISSIVE
uint FindEmissiveTriangle(FSceneConstants Scene, float U)
{
	FEmissiveRef Triangles = FEmissiveRef(Scene.EmissiveTriangles);
	uint Low = 0u, High = Scene.EmissiveTriangleCount - 1u;
	while (Low < High)
	{
		uint Middle = (Low + High) >> 1;
		if (Triangles.Data[Middle].CumulativePower > U) { High = Middle; }
		else { Low = Middle + 1u; }
	}
	return Low;
}

vec3 SampleEmissive(FSceneConstants Scene, FBrdf B, mat3 Basis, vec3 V, vec3 P, vec3 Ng, vec3 U)
{
	if (Scene.EmissiveTriangleCount == 0u) { return vec3(0.0); } // all emitters are deformed ones
	FEmissiveTriangle T = FEmissiveRef(Scene.EmissiveTriangles).Data[FindEmissiveTriangle(Scene, U.z)];
	vec2 Barycentrics = SampleTriangle(U.xy);
	vec3 Point = T.P0 + (T.P1 - T.P0) * Barycentrics.x + (T.P2 - T.P0) * Barycentrics.y;
	Point += CellOffset(Scene, FObjectRef(Scene.Objects).Data[T.Object].Cell);
	vec3 Towards = Point - P;
	float Distance2 = dot(Towards, Towards);
	if (Distance2 < 1.0e-12) { return vec3(0.0); }
	float Distance = sqrt(Distance2);
	Towards /= Distance;
	if (dot(Towards, Ng) <= 0.0) { return vec3(0.0); }

	FSectionData Section = FSectionRef(Scene.Sections).Data[T.Section];
	FMaterialData Material = FMaterialRef(Scene.Materials).Data[Section.Material];
	float Cos = -dot(normalize(cross(T.P1 - T.P0, T.P2 - T.P0)), Towards);
	if ((T.Flags & OBJECT_MIRRORED) != 0u) { Cos = -Cos; }
	if ((Section.Flags & SECTION_DOUBLE_SIDED) != 0u) { Cos = abs(Cos); }
	vec3 F = EvaluateBrdfCos(B, V, Towards * Basis);
	if (Cos <= 1.0e-6 || MaxComponent(F) <= 0.0) { return vec3(0.0); }
	FMaterialInputs Inputs = FetchCoverageInputs(Section, T.Primitive, Barycentrics);
	vec3 Emission = min(EvaluateEmission(Material, Inputs), vec3(MaxEmission)); // as the payload carries it
#ifdef HAS_MASKED
	if (IsCutAway(Material, Inputs)) { return vec3(0.0); }
#endif
	// Stops short of the emitter, by more the flatter the ray meets it.
	float Gap = PositionError(Point, Scene.ObjectReach, Distance) / max(Cos, 0.1);
	if (MaxComponent(Emission) <= 0.0 || !IsVisible(Scene, P, Towards, max(Distance - Gap, 0.0))) { return vec3(0.0); }
	float Density = Material.EmissiveWeight / Scene.EmissivePower * Distance2 / Cos;
	return F * Emission * (PowerHeuristic(Density, BrdfDensity(B, V, Towards * Basis)) / Density);
}
#endif

vec3 SampleLights(FSceneConstants Scene, FBrdf B, mat3 Basis, vec3 V, vec3 P, vec3 Ng, inout FRandom Random)
{
	vec3 L = vec3(0.0);
	if (IsMirror(B) && SpecularProbability(B, V) >= 1.0) { return L; }
	vec4 U0 = NextRandom4(Random);
	vec4 U1 = NextRandom4(Random);
#ifdef HAS_SUN
	L += SampleSun(Scene, B, Basis, V, P, Ng, U0.xy);
#endif
#ifdef HAS_SKY
	L += SampleSky(Scene, B, Basis, V, P, Ng, U0.zw);
#endif
#ifdef HAS_LIGHTS
	L += SamplePunctual(Scene, B, Basis, V, P, Ng, U1.w);
#endif
#ifdef HAS_EMISSIVE
	L += SampleEmissive(Scene, B, Basis, V, P, Ng, U1.xyz);
#endif
	return L;
}

#endif
