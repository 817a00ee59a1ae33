// References of indirect light: one path through one lobe of the surface.
#ifndef LANTERN_GATHER_SIGNAL_GLSL
#define LANTERN_GATHER_SIGNAL_GLSL

vec3 GatherSignal(FSceneConstants Scene, FBrdf Lobe, FMaterialHit Hit, vec3 P, vec3 V, inout FRandom Random)
{
	mat3 Basis = MakeBasis(BendNormal(Hit.Normal, V));
	vec2 U = NextRandom4(Random).xy;
	return GatherIndirect(Scene, Lobe, Basis, V * Basis, P, Hit.GeometricNormal, U, Push.MaxBounces, Random);
}

#endif
