// Next-event estimation, one function for each kind of light; included by PathTracing.glsl, which declares what this needs.
// Each returns reflected radiance; lights that BRDF sampling can find as well are weighted by the power heuristic. Parameters:
//   Basis  local frame whose z is the shading normal; Direction * Basis is local, Basis * Direction is world
//   V      towards the viewer, local;  P  ray origin, already offset from the surface
//   Ng     geometric normal, towards the viewer;  U  random numbers in [0, 1)
//   bCharacter  see Casters.glsl;  Channels  of the surface's object, see LightProfile.glsl
#ifndef LANTERN_PATH_LIGHTS_GLSL
#define LANTERN_PATH_LIGHTS_GLSL

#include "../Library/Casters.glsl"
#if defined(HAS_LIGHTS) && defined(LIGHT_CELLS_OF_VIEW)
#include "../Library/LightCells.glsl"
#endif

bool IsVisible(FSceneConstants Scene, uint Casters, vec3 Origin, vec3 Direction, float Distance)
{
	ShadowPayload.BlockerDistance = BlockedAtUnknownDistance;
	traceRayEXT(Scenes[Scene.Tlas], gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT, Casters, SHADOW_RAY,
	            RAY_TYPES, SHADOW_MISS, Origin, 0.0, Direction, Distance, 1);
	return IsVisible(ShadowPayload);
}

// Returns the density with which the BRDF's sampling finds what light sampling has found. Its rays see characters, which cast nothing on
// a character's surface: light sampling alone counts there, and FollowPath leaves out what the rays find.
float OtherPdf(FBrdf Brdf, vec3 V, vec3 L, bool bCharacter) { return bCharacter ? 0.0 : BrdfPdf(Brdf, V, L); }

#ifdef HAS_SUN
vec3 SampleSun(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, vec2 U)
{
	bool bPointSun = Scene.SunOneMinusCos <= 0.0;
	vec3 ToLight = bPointSun ? -Scene.SunDirection : SampleSunDirection(Scene, U);
	if (dot(ToLight, Ng) <= 0.0) { return vec3(0.0); }
	vec3 LocalToLight = ToLight * Basis;
	vec3 BrdfCos = EvaluateBrdfCos(Brdf, V, LocalToLight);
	if (MaxComponent(BrdfCos) <= 0.0 || !IsVisible(Scene, SunCasters(bCharacter), P, ToLight, 1.0e30)) { return vec3(0.0); }
	if (bPointSun) { return BrdfCos * Scene.SunColor * Scene.SunIrradiance; }
	float Pdf = SunPdf(Scene);
	return BrdfCos * SunRadiance(Scene) * (PowerHeuristic(Pdf, OtherPdf(Brdf, V, LocalToLight, bCharacter)) / Pdf);
}
#endif

#ifdef HAS_SKY
vec3 SampleSky(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, vec2 U)
{
	vec3 LocalToLight = SampleCosineHemisphere(U);
	vec3 ToLight = Basis * LocalToLight;
	if (LocalToLight.z <= 0.0 || dot(ToLight, Ng) <= 0.0) { return vec3(0.0); }
	vec3 BrdfCos = EvaluateBrdfCos(Brdf, V, LocalToLight);
	if (MaxComponent(BrdfCos) <= 0.0 || !IsVisible(Scene, SunCasters(bCharacter), P, ToLight, 1.0e30)) { return vec3(0.0); }
	float Pdf = LocalToLight.z / Pi;
	return BrdfCos * SampleSkyRadiance(Scene, ToLight) * (PowerHeuristic(Pdf, OtherPdf(Brdf, V, LocalToLight, bCharacter)) / Pdf);
}
#endif

#ifdef HAS_LIGHTS
// Samples one light with a probability proportional to EstimateLight, by weighted reservoir sampling over all that may matter.
// U: chooses the light; PointU: the point on one with an extent.
// LIGHT_CELLS_OF_VIEW: looks them up in light cells. Not defined, as in the reference: visits all lights.
vec3 SampleLocalLights(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, uint Channels, float U,
                       vec2 PointU)
{
	FLightRef Lights = FLightRef(Scene.Lights);
	float TotalWeight = 0.0, ChosenWeight = 0.0;
	uint Chosen = 0u;
#ifdef LIGHT_CELLS_OF_VIEW
	FLightWalk Walk = WalkLights(Scene, P, true);
	for (uint I = NextLight(Walk); I < Scene.LightCount; I = NextLight(Walk))
#else
	for (uint I = 0; I < Scene.LightCount; ++I)
#endif
	{
		float Weight = EstimateLight(Scene, Lights.Data[I], P, Ng);
		if (Weight <= 0.0 || !SharesChannel(Lights.Data[I], Channels)) { continue; }
		TotalWeight += Weight;
		float Probability = Weight / TotalWeight;
		if (U < Probability)
		{
			U /= Probability;
			ChosenWeight = Weight;
			Chosen = I;
		}
		else { U = (U - Probability) / (1.0 - Probability); }
		U = min(U, 0.99999994);
	}
	if (ChosenWeight <= 0.0) { return vec3(0.0); }
	FLightData Light = Lights.Data[Chosen];
	FLightSample Sample = SampleLight(Scene, Light, P, PointU);
	if (MaxComponent(Sample.Irradiance) <= 0.0 || dot(Sample.Direction, Ng) <= 0.0) { return vec3(0.0); }
	vec3 BrdfCos = EvaluateBrdfCos(Brdf, V, Sample.Direction * Basis);
	if (MaxComponent(BrdfCos) <= 0.0) { return vec3(0.0); }
	bool bCastsShadow = (Light.Flags & LIGHT_CASTS_SHADOW) != 0u;
	if (bCastsShadow && !IsVisible(Scene, LocalCasters(bCharacter), P, Sample.Direction, LightRayLength(Sample, P, Scene.ObjectReach))) { return vec3(0.0); }
	return BrdfCos * Sample.Irradiance * (TotalWeight / ChosenWeight);
}
#endif

#ifdef HAS_EMISSIVE
// Returns the first triangle whose cumulative power exceeds U, by binary search.
uint FindEmissiveTriangle(FSceneConstants Scene, float U)
{
	FEmissiveRef Triangles = FEmissiveRef(Scene.EmissiveTriangles);
	uint First = 0u, Last = Scene.EmissiveTriangleCount - 1u;
	while (First < Last)
	{
		uint Middle = (First + Last) >> 1;
		if (Triangles.Data[Middle].CumulativePower > U) { Last = Middle; }
		else { First = Middle + 1u; }
	}
	return First;
}

// bWithOther: BRDF sampling finds emitters as well.
vec3 SampleEmissive(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, vec3 U, bool bWithOther)
{
	if (Scene.EmissiveTriangleCount == 0u) { return vec3(0.0); } // emitters exist, but deformed ones are not in the list
	FEmissiveTriangle Triangle = FEmissiveRef(Scene.EmissiveTriangles).Data[FindEmissiveTriangle(Scene, U.z)];
	vec2 Barycentrics = SampleTriangle(U.xy);
	vec3 Point = Triangle.P0 + (Triangle.P1 - Triangle.P0) * Barycentrics.x + (Triangle.P2 - Triangle.P0) * Barycentrics.y;
	Point += CellOffset(Scene, FObjectRef(Scene.Objects).Data[Triangle.Object].Cell);
	vec3 ToLight = Point - P;
	float DistanceSquared = dot(ToLight, ToLight);
	if (DistanceSquared < 1.0e-12) { return vec3(0.0); }
	float Distance = sqrt(DistanceSquared);
	ToLight /= Distance;
	if (dot(ToLight, Ng) <= 0.0) { return vec3(0.0); }

	FSectionData Section = FSectionRef(Scene.Sections).Data[Triangle.Section];
	FMaterialData Material = FMaterialRef(Scene.Materials).Data[Section.Material];
	float CosAtLight = -dot(normalize(cross(Triangle.P1 - Triangle.P0, Triangle.P2 - Triangle.P0)), ToLight);
	if ((Triangle.Flags & OBJECT_MIRRORED) != 0u) { CosAtLight = -CosAtLight; }
	if ((Section.Flags & SECTION_DOUBLE_SIDED) != 0u) { CosAtLight = abs(CosAtLight); }
	vec3 BrdfCos = EvaluateBrdfCos(Brdf, V, ToLight * Basis);
	if (CosAtLight <= 1.0e-6 || MaxComponent(BrdfCos) <= 0.0) { return vec3(0.0); }
	FMaterialInputs Inputs = FetchTextureInputs(Section, Triangle.Primitive, Barycentrics);
	vec3 Emission = min(EvaluateEmission(Material, Inputs), vec3(MaxEmission)); // the limit that the payload has
#ifdef HAS_MASKED
	if (IsCutAway(Material, Inputs)) { return vec3(0.0); }
#endif
	// The shadow ray stops short of the emitter, the more so the more grazing it arrives.
	float Margin = PositionError(Point, Scene.ObjectReach, Distance) / max(CosAtLight, 0.1);
	if (MaxComponent(Emission) <= 0.0 || !IsVisible(Scene, LocalCasters(bCharacter), P, ToLight, max(Distance - Margin, 0.0))) { return vec3(0.0); }
	float Pdf = Material.EmissiveWeight / Scene.EmissivePower * DistanceSquared / CosAtLight;
	return BrdfCos * Emission * (bWithOther ? PowerHeuristic(Pdf, OtherPdf(Brdf, V, ToLight * Basis, bCharacter)) / Pdf : 1.0 / Pdf);
}

vec3 SampleEmissive(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, vec3 U)
{
	return SampleEmissive(Scene, Brdf, Basis, V, P, Ng, bCharacter, U, true);
}

// Without a BRDF sample that shares its work.
vec3 SampleEmissiveAlone(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, vec3 U)
{
	return SampleEmissive(Scene, Brdf, Basis, V, P, Ng, bCharacter, U, false);
}
#endif

// Sums one sample of each kind of light. Takes eight random numbers, and four more where lights have an extent.
vec3 SampleLights(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, uint Channels, inout FRandom Random)
{
	vec3 L = vec3(0.0);
	if (IsMirror(Brdf) && SpecularProbability(Brdf, V) >= 1.0) { return L; }
	vec4 U0 = NextRandom4(Random);
	vec4 U1 = NextRandom4(Random);
#ifdef HAS_SUN
	if (SunSharesChannel(Scene, Channels)) { L += SampleSun(Scene, Brdf, Basis, V, P, Ng, bCharacter, U0.xy); }
#endif
#ifdef HAS_SKY
	L += SampleSky(Scene, Brdf, Basis, V, P, Ng, bCharacter, U0.zw);
#endif
#ifdef HAS_LIGHTS
	vec2 PointU = vec2(0.0);
#ifdef HAS_AREA_LIGHTS
	PointU = NextRandom4(Random).xy;
#endif
	L += SampleLocalLights(Scene, Brdf, Basis, V, P, Ng, bCharacter, Channels, U1.w, PointU);
#endif
#ifdef HAS_EMISSIVE
	L += SampleEmissive(Scene, Brdf, Basis, V, P, Ng, bCharacter, U1.xyz);
#endif
	return L;
}

#endif
