// The sun: a disk of uniform radiance, given by the irradiance of a plane that faces it. The shadow pass and
// the reference sample the same disk with this one function, which is why their penumbrae agree.
#ifndef LANTERN_SUN_GLSL
#define LANTERN_SUN_GLSL

#include "Sampling.glsl"

// Direction towards a point of the disk.
vec3 SampleSunDirection(FSceneConstants Scene, vec2 U)
{
	vec3 Towards = -Scene.SunDirection;
	return MakeBasis(Towards) * SampleCone(U, Scene.SunOneMinusCos);
}

// Density over solid angle; infinite for a point.
float SunDensity(FSceneConstants Scene) { return 1.0 / (2.0 * Pi * Scene.SunOneMinusCos); }

bool IsInSunDisk(FSceneConstants Scene, vec3 Direction)
{
	// |d − t|² = 2(1 − cos) keeps precision where cos itself has none left.
	vec3 Difference = Direction + Scene.SunDirection;
	return dot(Difference, Difference) < 2.0 * Scene.SunOneMinusCos;
}

// Radiance of the disk: a facing plane receives ∫cosθ dω = π sin²r of it.
vec3 SunRadiance(FSceneConstants Scene)
{
	float SinSquared = Scene.SunOneMinusCos * (2.0 - Scene.SunOneMinusCos);
	return Scene.SunColor * Scene.SunIrradiance / (Pi * SinSquared);
}

#endif
