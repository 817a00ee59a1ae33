// References of local lights: one light, by a walk over all of them, and a ray to it.
#ifndef LANTERN_LOCAL_REFERENCE_GLSL
#define LANTERN_LOCAL_REFERENCE_GLSL

float ViewCosine(FMaterialHit Hit, vec3 V) { return dot(BendNormal(Hit.Normal, V), V); }

vec3 TraceLocalLight(FSceneConstants Scene, FBrdf Lobe, FMaterialHit Hit, vec3 P, vec3 V, inout FRandom Random)
{
#ifdef HAS_LIGHTS
	mat3 Basis = MakeBasis(BendNormal(Hit.Normal, V));
	vec4 U = NextRandom4(Random);
	return SampleLocalLights(Scene, Lobe, Basis, V * Basis, P, Hit.GeometricNormal, (Hit.Flags & HIT_CHARACTER) != 0u, U.x, U.yz);
#else
	return vec3(0.0);
#endif
}

#endif
