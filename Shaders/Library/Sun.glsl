// The sun: a disk of uniform radiance, given by the irradiance of a plane that faces it. The shadow pass and the reference
// share SampleSunDirection, so that their penumbrae agree.
#ifndef LANTERN_SUN_GLSL
#define LANTERN_SUN_GLSL

#include "Sampling.glsl"

// Samples a direction towards a point of the disk.
vec3 SampleSunDirection(FSceneConstants Scene, vec2 U)
{
	vec3 ToSun = -Scene.SunDirection;
	return MakeBasis(ToSun) * SampleCone(U, Scene.SunOneMinusCos);
}

// Returns the pdf of SampleSunDirection over solid angle; infinite for a point.
float SunPdf(FSceneConstants Scene) { return 1.0 / (2.0 * Pi * Scene.SunOneMinusCos); }

bool IsInSunDisk(FSceneConstants Scene, vec3 Direction)
{
	// The squared distance of unit vectors is 2(1 − cos). It keeps precision where cos itself has none left.
	vec3 Difference = Direction + Scene.SunDirection;
	return dot(Difference, Difference) < 2.0 * Scene.SunOneMinusCos;
}

// Returns the radiance of the disk. A plane that faces a disk of angular radius r receives ∫cosθ dω = π sin²r times that.
vec3 SunRadiance(FSceneConstants Scene)
{
	float SinSquared = Scene.SunOneMinusCos * (2.0 - Scene.SunOneMinusCos);
	return Scene.SunColor * Scene.SunIrradiance / (Pi * SinSquared);
}

#endif
