// References of local lights: one light, by a walk over all of them, and a ray to it.
// EMISSIVE_IS_DIRECT: and one emissive triangle.
#ifndef LANTERN_LOCAL_REFERENCE_GLSL
#define LANTERN_LOCAL_REFERENCE_GLSL

float ViewCosine(FMaterialHit Hit, vec3 V) { return dot(BendNormal(Hit.Normal, V), V); }

// EmissionShare: of emissive triangles, that counts here.
vec3 TraceLocalLight(FSceneConstants Scene, FBrdf Lobe, FMaterialHit Hit, vec3 P, vec3 V, float EmissionShare, inout FRandom Random)
{
	mat3 Basis = MakeBasis(BendNormal(Hit.Normal, V));
	bool bCharacter = (Hit.Flags & HIT_CHARACTER) != 0u;
	vec3 Sum = vec3(0.0);
#ifdef HAS_LIGHTS
	vec4 U = NextRandom4(Random);
	Sum += SampleLocalLights(Scene, Lobe, Basis, V * Basis, P, Hit.GeometricNormal, bCharacter, Hit.Channels, U.x, U.yz);
#endif
#if defined(HAS_EMISSIVE) && defined(EMISSIVE_IS_DIRECT)
	Sum += EmissionShare * SampleEmissiveAlone(Scene, Lobe, Basis, V * Basis, P, Hit.GeometricNormal, bCharacter, NextRandom4(Random));
#endif
	return Sum;
}

#endif
