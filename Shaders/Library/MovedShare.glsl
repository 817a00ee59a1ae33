// How much of the light that reaches a surface from all around objects that moved may have changed: those that hid it, shone, or reflected
// it.
#ifndef LANTERN_MOVED_SHARE_GLSL
#define LANTERN_MOVED_SHARE_GLSL

#include "../Shared/SettledTypes.h"
#include "Bindings.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FMovedCasterRef { FMovedCaster Data[]; };

// Returns about the form factor of a sphere: the part of a surface's light that it hides. To: its centre from the surface.
float FormFactor(vec3 To, float Radius, vec3 Normal)
{
	float DistanceSquared = max(dot(To, To), 1.0e-12), Solid = min(Radius * Radius / DistanceSquared, 1.0);
	float Up = dot(To, Normal);
	float Above = clamp(0.5 + 0.5 * Up / max(Radius, 1.0e-6), 0.0, 1.0); // of the sphere
	return Solid * Above * max(Up * inversesqrt(DistanceSquared), 0.5 * sqrt(Solid));
}

// What a mover may have changed of the light of a surface: x: a share of it, y: a radiance. P: relative to the scene's origin, metres.
vec2 GetMovedShare(FMovedCaster Mover, vec3 P, vec3 Normal)
{
	vec3 Way = Mover.To - Mover.From;
	float Length = length(Way);
	vec3 Nearest = Mover.From + Way * clamp(dot(P - Mover.From, Way) / max(Length * Length, 1.0e-12), 0.0, 1.0);
	float Form = FormFactor(Nearest - P, Mover.Radius, Normal);
	// What shines takes its light along. From far away little changes.
	float Distance = max(distance(Nearest, P), Mover.Radius);
	float Part = Length > 0.0 ? min(2.0 * Length / Distance, 1.0) : Mover.Changed;
	// Its light comes by other surfaces as well, whichever way this one faces.
	float Near = Mover.Radius / max(Distance, 1.0e-6), Shone = Part * Mover.Emission * Near * Near;
	return vec2(2.0 * Mover.Changed * Form, Shone); // where it was, and where it is
}

#endif
