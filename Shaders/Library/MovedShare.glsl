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

// Returns the part of a GGX lobe (Walter et al. 2007) that lies within an angle of its axis.
float LobeWithin(float Angle, float Alpha)
{
	float Sin = sin(0.5 * min(Angle, 3.14159265));
	return Sin * Sin / max(Sin * Sin + Alpha * Alpha * (1.0 - Sin * Sin), 1.0e-12);
}

// Returns about the part of a surface's GGX lobe that a sphere takes. To: its centre from the surface. Axis: of the lobe.
float LobeShare(vec3 To, float Radius, vec3 Axis, float Alpha)
{
	float Distance = length(To);
	if (Distance <= Radius) { return 1.0; }
	float Half = asin(Radius / Distance), Off = acos(clamp(dot(To, Axis) / Distance, -1.0, 1.0));
	if (Off <= Half) { return LobeWithin(Half, Alpha); }
	return (LobeWithin(Off + Half, Alpha) - LobeWithin(Off - Half, Alpha)) * asin(Half / Off) / 3.14159265;
}

vec3 NearestOnWay(FMovedCaster Mover, vec3 P)
{
	vec3 Way = Mover.To - Mover.From;
	return Mover.From + Way * clamp(dot(P - Mover.From, Way) / max(dot(Way, Way), 1.0e-12), 0.0, 1.0);
}

// As GetMovedShare's first part, for the light of a specular lobe.
float GetMovedShareOfLobe(FMovedCaster Mover, vec3 P, vec3 Axis, float Alpha)
{
	// The way may cross the lobe between its ends.
	float Share = max(LobeShare(Mover.From - P, Mover.Radius, Axis, Alpha), LobeShare(Mover.To - P, Mover.Radius, Axis, Alpha));
	return 2.0 * Mover.Changed * max(Share, LobeShare(NearestOnWay(Mover, P) - P, Mover.Radius, Axis, Alpha));
}

// What a mover may have changed of the light of a surface: x: a share of it, y: a radiance. P: relative to the scene's origin, metres.
vec2 GetMovedShare(FMovedCaster Mover, vec3 P, vec3 Normal)
{
	float Length = distance(Mover.From, Mover.To);
	vec3 Nearest = NearestOnWay(Mover, P);
	float Form = FormFactor(Nearest - P, Mover.Radius, Normal);
	// What shines takes its light along. From far away little changes.
	float Distance = max(distance(Nearest, P), Mover.Radius);
	float Part = Length > 0.0 ? min(2.0 * Length / Distance, 1.0) : Mover.Changed;
	// Its light comes by other surfaces as well, whichever way this one faces.
	float Near = Mover.Radius / max(Distance, 1.0e-6), Shone = Part * Mover.Emission * Near * Near;
	return vec2(2.0 * Mover.Changed * Form, Shone); // where it was, and where it is
}

#endif
