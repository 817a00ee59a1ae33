// What may have changed a pixel's shadow since an earlier frame, as the scene tells it: casters that moved, and the surface's own motion.
#ifndef LANTERN_MOVED_CASTERS_GLSL
#define LANTERN_MOVED_CASTERS_GLSL

#include "../Shared/SettledTypes.h"
#include "History.glsl"
#include "Motion.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FMovedCasterRef { FMovedCaster Data[]; };

// Whether the surface moved by itself, into other light perhaps. Motion of the camera alone differs from that of the surface by rounding.
bool MovedItself(FViewConstants View, float Distance, uvec2 Pixel, vec4 Motion)
{
	vec3 Relative = RelativePosition(View, vec2(Pixel) + 0.5, Distance);
	vec3 Still = ComputeMotion(View, Relative, Relative + View.CameraMotion);
	return any(greaterThan(abs(Motion.xy - Still.xy), vec2(0.25))) || abs(Motion.z - Still.z) > 0.01 * Still.z;
}

// Whether the shadow of a swept sphere may touch another sphere. Sun: in which its light travels. Spread: of the half shadow's border,
// metres per metre.
bool MayShadow(FMovedCaster Caster, vec3 Center, float Radius, vec3 Sun, float Spread)
{
	vec3 Sweep = Caster.To - Caster.From, Away = Center - Caster.From;
	float SweepAlong = dot(Sweep, Sun), Along = dot(Away, Sun);
	float Behind = Along - min(SweepAlong, 0.0) + Radius; // the caster's place that is nearest to the sun
	if (Behind < -Caster.Radius) { return false; }
	// Seen from the sun.
	Sweep -= Sun * SweepAlong;
	Away -= Sun * Along;
	vec3 Off = Away - Sweep * clamp(dot(Away, Sweep) / max(dot(Sweep, Sweep), 1.0e-12), 0.0, 1.0);
	float Reach = Caster.Radius + Radius + Spread * max(Behind, 0.0);
	return dot(Off, Off) <= Reach * Reach;
}

// Radians, and a little more: how fast the border of a half shadow spreads. OneMinusCos: of the sun's disk.
float GetShadowSpread(float OneMinusCos) { return sqrt(2.0 * OneMinusCos) + 1.0e-3; }

// Returns the sphere (xyz: relative to the camera, w: radius) around a square of the screen between two distances along the view.
vec4 BoundTile(FViewConstants View, uvec2 FirstPixel, uint TileSize, float Nearest, float Farthest)
{
	vec3 Corners[8], Center = vec3(0.0);
	for (uint I = 0u; I < 8u; ++I)
	{
		vec2 Corner = vec2(FirstPixel + uvec2(I & 1u, (I >> 1u) & 1u) * TileSize);
		Corners[I] = RelativePosition(View, Corner, I < 4u ? Nearest : Farthest);
		Center += Corners[I] / 8.0;
	}
	float Radius = 0.0;
	for (uint I = 0u; I < 8u; ++I) { Radius = max(Radius, distance(Corners[I], Center)); }
	return vec4(Center, Radius);
}

#endif
