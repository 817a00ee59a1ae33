// Radiance that the sky's program gives. Whatever the program returns, it is finite and not negative.
#ifndef LANTERN_RUN_SKY_PROGRAM_GLSL
#define LANTERN_RUN_SKY_PROGRAM_GLSL

#include "../Library/Bindings.glsl"
#include "../Library/Math.glsl"
#include "../Shared/SkyTypes.h"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FSkyDataRef { FSkyData Data; };

#include "SkyProgram.glsl"

// Direction: in the scene, of unit length.
vec3 RunSkyProgram(FAddress SkyData, vec3 Direction)
{
	FSkyData Sky = FSkyDataRef(SkyData).Data;
	vec3 Seen = vec3(dot(Sky.Axes[0], Direction), dot(Sky.Axes[1], Direction), dot(Sky.Axes[2], Direction));
	vec3 L = EvaluateSky(Seen, Sky);
	const float Most = 1.0e30;
	return vec3(L.x > 0.0 && L.x < Most ? L.x : 0.0, L.y > 0.0 && L.y < Most ? L.y : 0.0, L.z > 0.0 && L.z < Most ? L.z : 0.0);
}

#endif
