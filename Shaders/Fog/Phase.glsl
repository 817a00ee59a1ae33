// How fog scatters by direction.
#ifndef LANTERN_PHASE_GLSL
#define LANTERN_PHASE_GLSL

#include "../Library/Math.glsl"

// Returns the phase function of Henyey and Greenstein (1941), per steradian. Cosine: of the angle between the ray from the camera and the
// direction to the light.
float FogPhase(float Cosine, float G)
{
	float Base = max(1.0 + G * G - 2.0 * G * Cosine, 1.0e-6);
	return (1.0 - G * G) / (4.0 * Pi * Base * sqrt(Base));
}

#endif
