// What the first ray of a gathered path met, for PathTracing.glsl (KEEPS_HIT).
#ifndef LANTERN_KEPT_HIT_GLSL
#define LANTERN_KEPT_HIT_GLSL

// The first surface of a path that is no mirror.
struct FKeptHit
{
	float Distance; // by way of the mirrors, metres; below 0: the sky
	vec3 Normal;    // geometric
	uint Object;    // into FObjectData[]
	vec3 Albedo;    // what it reflects of even light towards the path, by way of the mirrors
	vec3 Emission;  // by way of the mirrors; the path brings the rest
};
FKeptHit KeptHit;
// The thread sets these before.
bool bLightsHits = false; // whether light is sampled there, and radiance cells hold that of further surfaces alone
bool bKeepsEmission = false; // the first lobe is a mirror, and what it shows keeps its emission apart

const FKeptHit NothingKept = FKeptHit(-1.0, vec3(0.0, 0.0, 1.0), 0u, vec3(1.0), vec3(0.0));

// Throughput: of the mirrors before. Before: length of the path to the last one.
void KeepHit(inout FMaterialHit Hit, vec3 Direction, vec3 Throughput, float Before)
{
	const float LeastAlbedo = 0.01;
	vec3 Emission = Before > 0.0 ? KeptHit.Emission : vec3(0.0); // of mirrors before
	KeptHit = NothingKept;
	KeptHit.Emission = Emission;
	if (Hit.Distance < 0.0) { return; }
	FBrdf Brdf = MakeBrdf(Hit);
	float NdotV = dot(BendNormal(Hit.Normal, -Direction), -Direction);
	vec3 Albedo = DiffuseReflectance(Brdf, NdotV) + SpecularReflectance(Brdf, NdotV, Hit.Roughness);
#ifdef HAS_TRANSMISSION
	Albedo = mix(Albedo, vec3(1.0), InterfaceShare(Hit)); // about what it reflects and lets through
#endif
	KeptHit = FKeptHit(Before + Hit.Distance, Hit.GeometricNormal, Hit.Object, Throughput * max(Albedo, LeastAlbedo), Emission);
	if (!bKeepsEmission) { return; }
	KeptHit.Emission += Throughput * Hit.Emissive;
	Hit.Emissive = vec3(0.0);
}

#endif
