// Next-event estimation, one function for each kind of light; included by PathTracing.glsl, which declares what this needs.
// Each returns reflected radiance; lights that BRDF sampling can find as well are weighted by the power heuristic. Parameters:
//   Basis  local frame whose z is the shading normal; Direction * Basis is local, Basis * Direction is world
//   V      towards the viewer, local;  P  ray origin, already offset from the surface
//   Ng     geometric normal, towards the viewer;  U  random numbers in [0, 1)
//   HAS_SCATTERING: places within volumes are lit as well. They have a phase function, and any normals. Paths alone find the sky there.
//   HAS_DIFFUSE_TRANSMISSION: light from behind counts as well, see BackStep.
//   bCharacter  see Casters.glsl;  Channels  of the surface's object, see LightProfile.glsl
#ifndef LANTERN_PATH_LIGHTS_GLSL
#define LANTERN_PATH_LIGHTS_GLSL

#include "../Library/Casters.glsl"
#if defined(HAS_LIGHTS) && defined(LIGHT_CELLS_OF_VIEW)
#include "../Library/LightCells.glsl"
#endif

#ifdef HAS_DIFFUSE_TRANSMISSION
// From P to where rays leave the other side of the vertex. The thread sets it with each vertex whose BRDF has a back lobe.
vec3 BackStep = vec3(0.0);
#endif

// Whether a surface sends light from Direction to the viewer: both its normals must have it on one side. LocalZ: of Direction.
bool IsLitFrom(FBrdf Brdf, vec3 Direction, vec3 Ng, float LocalZ)
{
	if (IsPhase(Brdf)) { return true; }
	float Side = dot(Direction, Ng);
	return Side > 0.0 ? LocalZ > 0.0 : HasBack(Brdf) && Side < 0.0 && LocalZ < 0.0;
}

// Returns where a ray along Direction leaves the vertex.
vec3 StartOfRay(vec3 P, vec3 Direction, vec3 Ng)
{
#ifdef HAS_DIFFUSE_TRANSMISSION
	return dot(Direction, Ng) < 0.0 ? P + BackStep : P;
#else
	return P;
#endif
}

// Aims a ray that leaves the other side of the vertex at the point that Direction and Distance lead to from P. Length: where the ray stops.
void AimFrom(vec3 Start, vec3 P, float Distance, inout vec3 Direction, inout float Length)
{
#ifdef HAS_DIFFUSE_TRANSMISSION
	if (Start == P || Distance >= LightInfinity) { return; }
	vec3 To = P + Direction * Distance - Start;
	float FromStart = max(length(To), 1.0e-6);
	Direction = To / FromStart;
	Length = max(Length + FromStart - Distance, 0.0);
#endif
}

// Returns the density of light sampling of the sky, over that of a cosine: each side has the chance of its lobe.
float SkyChance(FBrdf Brdf, float LocalZ)
{
	float Back = BackProbability(Brdf);
	return LocalZ < 0.0 ? Back : 1.0 - Back;
}

// Returns the share of light that arrives along a ray, by luminance.
float Transmittance(FSceneConstants Scene, uint Casters, vec3 Origin, vec3 Direction, float Distance)
{
#ifdef RAY_QUERY
	return QueryTransmittance(Scene, 0u, Casters, Origin, Direction, Distance);
#else
	ShadowPayload.BlockerDistance = BlockedAtUnknownDistance;
	traceRayEXT(Scenes[Scene.Tlas], gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT, Casters, SHADOW_RAY,
	            RAY_TYPES, SHADOW_MISS, Origin, 0.0, Direction, Distance, 1);
	return GetTransmittance(ShadowPayload);
#endif
}

// Returns the part of a light's that arrives.
vec3 LightThrough(FSceneConstants Scene, uint Casters, vec3 Origin, vec3 Direction, float Distance)
{
#ifdef TINTED_SHADOWS
	vec3 T = vec3(1.0);
	FVolume Volume = PlaceVolume;
	for (uint Layer = 0u; Layer < MostPassages;)
	{
		FMaterialHit Hit = TraceMaterial(Scene, Casters, Origin, Direction, Distance, SHOWS_NOTHING);
		if (Hit.Distance < 0.0) { return Distance < LightInfinity ? T * exp(-Volume.Extinction * Distance) : T; } // a lamp in the volume
		if (Hit.Transmission <= 0.0) { break; }
		Layer += IsClear(Hit) ? 0u : 1u;
		T *= StraightTransmittance(Scene, Hit, Direction, Hit.Distance);
		if ((Hit.Flags & HIT_SOLID) != 0u) { Volume = (Hit.Flags & HIT_INSIDE) != 0u ? Air() : VolumeOf(Scene, Hit); }
		if (T == vec3(0.0)) { break; }
		Origin = OffsetRayOrigin(Origin + Direction * Hit.Distance, -Hit.GeometricNormal, Scene.ObjectReach, Hit.Distance);
		Distance -= Hit.Distance;
	}
	return vec3(0.0);
#else
	CountPathRay(Scene, PATH_RAY_LIGHT);
	return vec3(Transmittance(Scene, Casters, Origin, Direction, Distance));
#endif
}

// Returns the density with which the BRDF's sampling finds what light sampling has found. Its rays see characters, which cast nothing on
// a character's surface: light sampling alone counts there, and FollowPath leaves out what the rays find.
float OtherPdf(FBrdf Brdf, vec3 V, vec3 L, bool bCharacter) { return bCharacter ? 0.0 : BrdfPdf(Brdf, V, L); }

#ifdef HAS_SUN
vec3 SampleSun(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, vec2 U)
{
	bool bPointSun = Scene.SunOneMinusCos <= 0.0;
	vec3 ToLight = bPointSun ? -Scene.SunDirection : SampleSunDirection(Scene, U);
	vec3 LocalToLight = ToLight * Basis;
	if (!IsLitFrom(Brdf, ToLight, Ng, LocalToLight.z)) { return vec3(0.0); }
	vec3 BrdfCos = EvaluateBrdfCos(Brdf, V, LocalToLight);
	if (MaxComponent(BrdfCos) <= 0.0) { return vec3(0.0); }
	BrdfCos *= LightThrough(Scene, SunCasters(bCharacter), StartOfRay(P, ToLight, Ng), ToLight, 1.0e30);
	if (BrdfCos == vec3(0.0)) { return vec3(0.0); }
	if (bPointSun) { return BrdfCos * Scene.SunColor * Scene.SunIrradiance; }
	float Pdf = SunPdf(Scene);
	return BrdfCos * SunRadiance(Scene) * (PowerHeuristic(Pdf, OtherPdf(Brdf, V, LocalToLight, bCharacter)) / Pdf);
}
#endif

#ifdef HAS_SKY
vec3 SampleSky(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, vec2 U)
{
	float Back = BackProbability(Brdf);
	bool bBack = U.x < Back;
	U.x = bBack ? U.x / Back : (U.x - Back) / (1.0 - Back);
	vec3 LocalToLight = SampleCosineHemisphere(U);
	if (bBack) { LocalToLight.z = -LocalToLight.z; }
	vec3 ToLight = Basis * LocalToLight;
	if (LocalToLight.z == 0.0 || !IsLitFrom(Brdf, ToLight, Ng, LocalToLight.z)) { return vec3(0.0); }
	vec3 BrdfCos = EvaluateBrdfCos(Brdf, V, LocalToLight);
	if (MaxComponent(BrdfCos) <= 0.0) { return vec3(0.0); }
	BrdfCos *= LightThrough(Scene, SunCasters(bCharacter), StartOfRay(P, ToLight, Ng), ToLight, 1.0e30);
	if (BrdfCos == vec3(0.0)) { return vec3(0.0); }
	float Pdf = abs(LocalToLight.z) / Pi * SkyChance(Brdf, LocalToLight.z);
	return BrdfCos * SampleSkyRadiance(Scene, ToLight) * (PowerHeuristic(Pdf, OtherPdf(Brdf, V, LocalToLight, bCharacter)) / Pdf);
}
#endif

#ifdef HAS_LIGHTS
// As EstimateLight, of what reaches either side that has a lobe.
float EstimateLightOf(FSceneConstants Scene, FBrdf Brdf, FLightData Light, vec3 P, vec3 Ng)
{
	float Estimate = EstimateLight(Scene, Light, P, Ng);
	return Estimate <= 0.0 && (HasBack(Brdf) || IsPhase(Brdf)) ? EstimateLight(Scene, Light, P, -Ng) : Estimate;
}

// Samples one light with a probability proportional to EstimateLight, by weighted reservoir sampling over all that may matter.
// U: chooses the light; PointU: the point on one with an extent. ToLight: gets the direction, which means nothing where the result is 0.
// LIGHT_CELLS_OF_VIEW: looks them up in light cells. Not defined, as in the reference: visits all lights.
vec3 SampleLocalLights(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, uint Channels, float U,
                       vec2 PointU, out vec3 ToLight)
{
	ToLight = Ng;
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
		float Weight = EstimateLightOf(Scene, Brdf, Lights.Data[I], P, Ng);
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
	ToLight = Sample.Direction;
	vec3 LocalToLight = Sample.Direction * Basis;
	if (MaxComponent(Sample.Irradiance) <= 0.0 || !IsLitFrom(Brdf, Sample.Direction, Ng, LocalToLight.z)) { return vec3(0.0); }
	vec3 BrdfCos = EvaluateBrdfCos(Brdf, V, LocalToLight);
	if (MaxComponent(BrdfCos) <= 0.0) { return vec3(0.0); }
	bool bCastsShadow = (Light.Flags & LIGHT_CASTS_SHADOW) != 0u;
	vec3 Start = StartOfRay(P, Sample.Direction, Ng), Direction = Sample.Direction;
	float Length = LightRayLength(Sample, P, Scene.ObjectReach);
	AimFrom(Start, P, Sample.Distance, Direction, Length);
	if (bCastsShadow) { BrdfCos *= LightThrough(Scene, LocalCasters(bCharacter), Start, Direction, Length); }
	return BrdfCos * Sample.Irradiance * (TotalWeight / ChosenWeight);
}

vec3 SampleLocalLights(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, uint Channels, float U,
                       vec2 PointU)
{
	vec3 ToLight;
	return SampleLocalLights(Scene, Brdf, Basis, V, P, Ng, bCharacter, Channels, U, PointU, ToLight);
}
#endif

// Returns the share of a reflection that shows what materials look like.
vec3 ShownShare(FBrdf Brdf, vec3 V, vec3 L, uint Shows)
{
	if (Shows != SHOWS_MIRRORED) { return vec3(Shows == SHOWS_ALL ? 1.0 : 0.0); }
	float OfRays = EmissionOfRays(sqrt(Brdf.Alpha), 1.0);
	if (OfRays <= 0.0 || (Brdf.Diffuse <= 0.0 && !HasBack(Brdf))) { return vec3(OfRays); }
	vec3 Whole = EvaluateBrdfCos(Brdf, V, L);
	Brdf = MakeSpecularLobe(Brdf);
	return OfRays * clamp(EvaluateBrdfCos(Brdf, V, L) / max(Whole, vec3(1.0e-30)), vec3(0.0), vec3(1.0));
}

#ifdef HAS_EMISSIVE
// Chooses an emissive triangle: a cluster, then a triangle of it. OutChance: with which it is chosen.
FEmissiveTriangle ChooseEmissive(FSceneConstants Scene, vec2 U, out float OutChance)
{
	FEmissivePowerRef Powers = FEmissivePowerRef(Scene.EmissivePowers);
	uint First = 0u, Last = Scene.EmissiveClusterCount - 1u;
	while (First < Last)
	{
		uint Middle = (First + Last) >> 1;
		if (Powers.Data[Middle].Share > U.x) { Last = Middle; }
		else { First = Middle + 1u; }
	}
	OutChance = Powers.Data[First].Share - (First > 0u ? Powers.Data[First - 1u].Share : 0.0);
	FEmissiveCluster Cluster = FEmissiveClusterRef(Scene.EmissiveClusters).Data[First];
	FEmissiveRef Triangles = FEmissiveRef(Scene.EmissiveTriangles);
	First = Cluster.First;
	Last = Cluster.First + Cluster.Count - 1u;
	while (First < Last)
	{
		uint Middle = (First + Last) >> 1;
		if (Triangles.Data[Middle].ClusterShare > U.y) { Last = Middle; }
		else { First = Middle + 1u; }
	}
	FEmissiveTriangle Triangle = Triangles.Data[First];
	OutChance *= Triangle.ClusterShare - (First > Cluster.First ? Triangles.Data[First - 1u].ClusterShare : 0.0);
	return Triangle;
}

// Returns a density of light sampling, by area, for weights against the BRDF's: that of chances by power alone.
float EmissiveAreaPdf(FSceneConstants Scene, float EmissiveWeight)
{
	return Scene.EmissiveClusterCount > 0u ? EmissiveWeight / max(FEmissivePowerRef(Scene.EmissivePowers).Header.Power, 1.0e-30) : 0.0;
}

// Casters: what hides emitters. bWithOther: BRDF sampling finds emitters as well. U: a point of the triangle, a cluster and a triangle of it.
// Shows: SHOWS_….
// ToLight: gets the direction, which means nothing where the result is 0.
vec3 SampleEmissive(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, uint Casters, vec4 U,
                    bool bWithOther, uint Shows, out vec3 ToLight)
{
	ToLight = Ng;
	if (Scene.EmissiveClusterCount == 0u) { return vec3(0.0); } // emitters exist, but are not listed
	float Chance;
	FEmissiveTriangle Triangle = ChooseEmissive(Scene, U.zw, Chance);
	vec2 Barycentrics = SampleTriangle(U.xy);
	vec3 Point = Triangle.P0 + (Triangle.P1 - Triangle.P0) * Barycentrics.x + (Triangle.P2 - Triangle.P0) * Barycentrics.y;
	Point += CellOffset(Scene, FObjectRef(Scene.Objects).Data[Triangle.Object].Cell);
	ToLight = Point - P;
	float DistanceSquared = dot(ToLight, ToLight);
	if (DistanceSquared < 1.0e-12) { return vec3(0.0); }
	float Distance = sqrt(DistanceSquared);
	ToLight /= Distance;
	if (!IsLitFrom(Brdf, ToLight, Ng, (ToLight * Basis).z)) { return vec3(0.0); }

	FSectionData Section = FSectionRef(Scene.Sections).Data[Triangle.Section];
	FMaterialData Material = FMaterialRef(Scene.Materials).Data[Section.Material];
	vec3 Cross = cross(Triangle.P1 - Triangle.P0, Triangle.P2 - Triangle.P0);
	float Doubled = length(Cross); // area
	if (Chance <= 0.0 || Doubled <= 0.0) { return vec3(0.0); }
	float CosAtLight = -dot(Cross, ToLight) / Doubled;
	if ((Triangle.Flags & OBJECT_MIRRORED) != 0u) { CosAtLight = -CosAtLight; }
	if ((Section.Flags & SECTION_DOUBLE_SIDED) != 0u) { CosAtLight = abs(CosAtLight); }
	vec3 BrdfCos = EvaluateBrdfCos(Brdf, V, ToLight * Basis);
	if (CosAtLight <= 1.0e-6 || MaxComponent(BrdfCos) <= 0.0) { return vec3(0.0); }
	FMaterialInputs Inputs = FetchTextureInputs(Section, Triangle.Primitive, Barycentrics);
	vec3 Emission = min(EvaluateLightEmission(Material, Inputs), vec3(MaxEmission)); // the limit that the payload has
#ifdef HAS_LIGHT_EMISSION
	Emission = mix(Emission, min(EvaluateEmission(Material, Inputs), vec3(MaxEmission)), ShownShare(Brdf, V, ToLight * Basis, Shows));
#endif
#ifdef HAS_MASKED
	if (IsCutAway(Material, Inputs)) { return vec3(0.0); }
#endif
	// The shadow ray stops short of the emitter, the more so the more grazing it arrives.
	float Margin = PositionError(Point, Scene.ObjectReach, Distance) / max(CosAtLight, 0.1);
	if (MaxComponent(Emission) <= 0.0) { return vec3(0.0); }
	vec3 Start = StartOfRay(P, ToLight, Ng), Direction = ToLight;
	float Length = max(Distance - Margin, 0.0);
	AimFrom(Start, P, Distance, Direction, Length);
	BrdfCos *= LightThrough(Scene, Casters, Start, Direction, Length);
	if (BrdfCos == vec3(0.0)) { return vec3(0.0); }
	float ToSolidAngle = DistanceSquared / CosAtLight;
	float Pdf = Chance * 2.0 / Doubled * ToSolidAngle;
	if (!bWithOther) { return BrdfCos * Emission / Pdf; }
	float ForWeight = EmissiveAreaPdf(Scene, Material.EmissiveWeight) * ToSolidAngle; // as ShadeEmission has it
	return BrdfCos * Emission * (PowerHeuristic(ForWeight, OtherPdf(Brdf, V, ToLight * Basis, bCharacter)) / Pdf);
}

vec3 SampleEmissive(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, vec4 U, uint Shows)
{
	vec3 ToLight;
	return SampleEmissive(Scene, Brdf, Basis, V, P, Ng, bCharacter, LocalCasters(bCharacter), U, true, Shows, ToLight);
}

// Without a BRDF sample that shares its work.
vec3 SampleEmissiveAlone(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, vec4 U)
{
	vec3 ToLight;
	return SampleEmissive(Scene, Brdf, Basis, V, P, Ng, bCharacter, LocalCasters(bCharacter), U, false, SHOWS_NOTHING, ToLight);
}
#endif

// Sums one sample of each kind of light. Takes eight random numbers, and four more where lights have an extent.
vec3 SampleLights(FSceneConstants Scene, FBrdf Brdf, mat3 Basis, vec3 V, vec3 P, vec3 Ng, bool bCharacter, uint Channels, uint Shows,
                  inout FRandom Random)
{
	vec3 L = vec3(0.0);
	if (IsMirror(Brdf) && SpecularProbability(Brdf, V) >= 1.0) { return L; }
	vec4 U0 = NextRandom4(Random);
	vec4 U1 = NextRandom4(Random);
#ifdef HAS_SUN
	if (SunSharesChannel(Scene, Channels)) { L += SampleSun(Scene, Brdf, Basis, V, P, Ng, bCharacter, U0.xy); }
#endif
#ifdef HAS_SKY
#ifdef RADIANCE_CELLS
	// The path goes on as a ray to the sky would. Two cost more than they save where few paths are followed.
	bool bSamplesSky = bCharacter;
#else
	const bool bSamplesSky = true;
#endif
	if (bSamplesSky && !IsPhase(Brdf)) { L += SampleSky(Scene, Brdf, Basis, V, P, Ng, bCharacter, U0.zw); }
#endif
#ifdef HAS_LIGHTS
	vec2 PointU = vec2(0.0);
#ifdef HAS_AREA_LIGHTS
	PointU = NextRandom4(Random).xy;
#endif
	L += SampleLocalLights(Scene, Brdf, Basis, V, P, Ng, bCharacter, Channels, U1.w, PointU);
#endif
#ifdef HAS_EMISSIVE
	L += SampleEmissive(Scene, Brdf, Basis, V, P, Ng, bCharacter, U1, Shows); // w chooses a lamp as well: of sums, each part may
#endif
	return L;
}

#endif
