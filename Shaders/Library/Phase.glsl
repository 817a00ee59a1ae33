// How fog and water scatter by direction.
#ifndef LANTERN_PHASE_GLSL
#define LANTERN_PHASE_GLSL

#include "Math.glsl"

// Returns the phase function of Henyey and Greenstein (1941), per steradian. Cosine: of the angle between the ray from the camera and the
// direction to the light.
float PhaseFunction(float Cosine, float G)
{
	float Base = max(1.0 + G * G - 2.0 * G * Cosine, 1.0e-6);
	return (1.0 - G * G) / (4.0 * Pi * Base * sqrt(Base));
}

// Samples a direction by the phase function. Returns it relative to the direction that light has, which is +z. U: in [0, 1).
vec3 SamplePhase(float G, vec2 U)
{
	float Root = (1.0 - G * G) / (1.0 - G + 2.0 * G * U.x);
	float Z = abs(G) < 1.0e-3 ? 2.0 * U.x - 1.0 : clamp((1.0 + G * G - Root * Root) / (2.0 * G), -1.0, 1.0);
	float Phi = 2.0 * Pi * U.y;
	return vec3(sqrt(1.0 - Z * Z) * vec2(cos(Phi), sin(Phi)), Z);
}

#endif
