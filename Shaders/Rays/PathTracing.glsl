// Paths of light, for ray generation shaders: the reference and brute-force passes. Next-event estimation for each kind of
// light that the scene has, combined with BRDF sampling by multiple importance sampling (Veach 1997); Russian roulette.
// HAS_SUN, HAS_SKY, HAS_LIGHTS, HAS_EMISSIVE, HAS_MASKED: what the scene has.
#ifndef LANTERN_PATH_TRACING_GLSL
#define LANTERN_PATH_TRACING_GLSL

#include "../Library/Bindings.glsl"
#include "../Library/BrdfSample.glsl"
#include "../Library/Lights.glsl"
#include "../Library/Random.glsl"
#include "../Library/Sun.glsl"
#include "../Materials/Standard.glsl"
#include "MaterialPayload.glsl"
#include "ShadowPayload.glsl"

layout(set = 0, binding = 3) uniform accelerationStructureEXT Scenes[];
layout(location = 0) rayPayloadEXT FMaterialPayload MaterialPayload;
layout(location = 1) rayPayloadEXT FShadowPayload ShadowPayload;

#include "PathLights.glsl"

const float Infinity = 1.0e30;
const float RouletteFloor = 0.25;

FMaterialHit TraceMaterial(FSceneConstants Scene, uint Mask, vec3 Origin, vec3 Direction, float MaxDistance)
{
	traceRayEXT(Scenes[Scene.Tlas], 0u, Mask, MATERIAL_RAY, RAY_TYPES, MATERIAL_MISS, Origin, 0.0, Direction, MaxDistance, 0);
	return UnpackHit(MaterialPayload);
}

FMaterialHit TraceMaterial(FSceneConstants Scene, vec3 Origin, vec3 Direction)
{
	return TraceMaterial(Scene, MASK_VISIBLE, Origin, Direction, Infinity);
}

// What a ray that hits nothing brings, weighted against next-event estimation from N (the vertex it left).
vec3 ShadeMiss(FSceneConstants Scene, vec3 Direction, float Density, float NdotL)
{
	vec3 L = vec3(0.0);
#ifdef HAS_SKY
	L += Scene.SkyRadiance * PowerHeuristic(Density, NdotL / Pi);
#endif
#ifdef HAS_SUN
	if (Scene.SunOneMinusCos > 0.0 && IsInSunDisk(Scene, Direction))
	{
		L += SunRadiance(Scene) * PowerHeuristic(Density, SunDensity(Scene));
	}
#endif
	return L;
}

vec3 ShadeEmission(FSceneConstants Scene, FMaterialHit Hit, vec3 Direction, float Density)
{
	if (MaxComponent(Hit.Emissive) <= 0.0) { return vec3(0.0); }
	float Cos = abs(dot(Hit.GeometricNormal, Direction));
	float LightDensity = 0.0;
#ifdef HAS_EMISSIVE
	if (Hit.EmissiveWeight > 0.0) { LightDensity = Hit.EmissiveWeight / Scene.EmissivePower * Hit.Distance * Hit.Distance / max(Cos, 1.0e-8); }
#endif
	return Hit.Emissive * PowerHeuristic(Density, LightDensity);
}

FBrdf MakeBrdf(FMaterialHit Hit)
{
	FBrdf B;
	B.BaseColor = Hit.BaseColor;
	B.Metallic = Hit.Metallic;
	B.Alpha = Hit.Roughness * Hit.Roughness;
	B.F0 = Hit.F0;
	B.Specular = Hit.Specular;
	B.Diffuse = 1.0;
	return B;
}

// What comes back along a ray that was traced from Origin to Hit. Density and NdotL: of its direction at the vertex that it
// left, for what next-event estimation there has found already. Bounce: how often the path has been scattered before.
vec3 FollowPath(FSceneConstants Scene, FMaterialHit Hit, vec3 Origin, vec3 Direction, float Density, float NdotL, uint Bounce, uint MaxBounces,
                inout FRandom Random)
{
	vec3 Radiance = vec3(0.0), Throughput = vec3(1.0);
	for (;; ++Bounce)
	{
		if (Hit.Distance < 0.0) { return Radiance + Throughput * ShadeMiss(Scene, Direction, Density, NdotL); }
		Radiance += Throughput * ShadeEmission(Scene, Hit, Direction, Density);
		if (Bounce >= MaxBounces) { return Radiance; }

		vec3 P = OffsetRayOrigin(Origin + Direction * Hit.Distance, Hit.GeometricNormal, Scene.ObjectReach, Hit.Distance);
		vec3 V = -Direction;
		mat3 Basis = MakeBasis(BendNormal(Hit.Normal, V));
		FBrdf Brdf = MakeBrdf(Hit);
		vec3 LocalV = V * Basis;
		Radiance += Throughput * SampleLights(Scene, Brdf, Basis, LocalV, P, Hit.GeometricNormal, Random);

		FBrdfSample Sample = SampleBrdf(Brdf, LocalV, NextRandom4(Random).xyz);
		if (Sample.Direction.z <= 0.0) { return Radiance; }
		Throughput *= Sample.Weight;
		Direction = Basis * Sample.Direction;
		if (dot(Direction, Hit.GeometricNormal) <= 0.0) { return Radiance; }
		Density = Sample.Density;
		NdotL = Sample.Direction.z;

		if (Bounce >= 3u)
		{
			// Survivors keep RouletteFloor: in bright rooms roulette on the throughput itself is most of the noise
			// (albedo 0.9, closed: 10 times the samples for the same error).
			float Survive = min(MaxComponent(Throughput) / RouletteFloor, 1.0);
			if (NextRandom4(Random).x >= Survive) { return Radiance; }
			Throughput /= Survive;
		}
		Origin = P;
		Hit = TraceMaterial(Scene, Origin, Direction);
	}
}

// What one lobe reflects at the first vertex of a path, of all light but that of the sun's disk and of punctual lights: these
// shine there directly, which is direct lighting's. Lobe: MakeWhiteLambert or MakeSpecularLobe. V: in the frame of Basis;
// Ng: geometric normal, towards the viewer; P: already off the surface. U: chooses the direction. The sky is found by the
// lobe's own samples alone: it is uniform, and light sampling would find no more.
vec3 GatherIndirect(FSceneConstants Scene, FBrdf Lobe, mat3 Basis, vec3 V, vec3 P, vec3 Ng, vec2 U, uint MaxBounces, inout FRandom Random)
{
	vec3 Radiance = vec3(0.0);
	if (MaxBounces == 0u) { return Radiance; }
	float Specular = SpecularProbability(Lobe, V); // 0 or 1
	if (Specular <= 0.0 && Lobe.Diffuse <= 0.0) { return Radiance; }
#ifdef HAS_EMISSIVE
	vec3 ULight = NextRandom4(Random).xyz;
	if (Specular <= 0.0 || !IsMirror(Lobe)) { Radiance += SampleEmissive(Scene, Lobe, Basis, V, P, Ng, ULight); }
#endif
	FBrdfSample Sample = SampleBrdf(Lobe, V, vec3(U, 0.5));
	vec3 Direction = Basis * Sample.Direction;
	if (Sample.Direction.z <= 0.0 || dot(Direction, Ng) <= 0.0) { return Radiance; }
	FMaterialHit Hit = TraceMaterial(Scene, P, Direction);
	if (Hit.Distance < 0.0)
	{
#ifdef HAS_SKY
		Radiance += Sample.Weight * Scene.SkyRadiance;
#endif
		return Radiance;
	}
	return Radiance + Sample.Weight * FollowPath(Scene, Hit, P, Direction, Sample.Density, Sample.Direction.z, 1u, MaxBounces, Random);
}

#endif
