// What may have changed a pixel's shadow since an earlier frame, as the scene tells it: casters that moved, and the surface's own motion.
#ifndef LANTERN_MOVED_CASTERS_GLSL
#define LANTERN_MOVED_CASTERS_GLSL

#include "../Shared/SettledTypes.h"
#include "History.glsl"
#include "Lights.glsl"
#include "Motion.glsl"
#include "MovedShare.glsl"

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

struct FCasterList
{
	FAddress Casters; // FMovedCaster[Count]
	uint Count;
	float Spread; // GetShadowSpread
};

// Whether one of the casters that fall to this thread of a work group of 64 may shadow a sphere of BoundTile.
bool MayAnyShadow(FSceneConstants Scene, FViewConstants View, FCasterList List, vec4 Bound)
{
	for (uint I = gl_LocalInvocationIndex; I < List.Count; I += 64u)
	{
		FMovedCaster Caster = FMovedCasterRef(List.Casters).Data[I];
		if (MayShadow(Caster, View.CameraPosition + Bound.xyz, Bound.w, Scene.SunDirection, List.Spread)) { return true; }
	}
	return false;
}

// Returns the square of the distance between two segments, each given by its start and by what leads to its end (Ericson 2005, "Real-Time
// Collision Detection", 5.1.9).
float SegmentDistanceSquared(vec3 A, vec3 ToA, vec3 B, vec3 ToB)
{
	vec3 Off = A - B;
	float LengthA = max(dot(ToA, ToA), 1.0e-12), LengthB = max(dot(ToB, ToB), 1.0e-12);
	float Both = dot(ToA, ToB), OffA = dot(ToA, Off), OffB = dot(ToB, Off), Denominator = LengthA * LengthB - Both * Both;
	float S = Denominator > 1.0e-6 * LengthA * LengthB ? clamp((Both * OffB - OffA * LengthB) / Denominator, 0.0, 1.0) : 0.0;
	float T = clamp((Both * S + OffB) / LengthB, 0.0, 1.0);
	S = clamp((Both * T - OffA) / LengthA, 0.0, 1.0);
	vec3 Between = Off + ToA * S - ToB * T;
	return dot(Between, Between);
}

// Whether a swept sphere may lie between another sphere and a light.
bool MayShadowLamp(FSceneConstants Scene, FMovedCaster Caster, FLightData Light, vec3 Center, float Radius)
{
	uint Type = LightType(Light);
	if (Type == LIGHT_NONE) { return false; }
	if (Type == LIGHT_DIRECTIONAL) { return MayShadow(Caster, Center, Radius, UnpackOct(Light.Direction), GetShadowSpread(Light.Size.x)); }
	vec3 ToLight = LightPosition(Scene, Light) - Center;
	float Reach = Light.Range + Radius, Wide = max(Radius, Type >= LIGHT_RECTANGLE ? Light.Size.x + Light.Size.y : 0.0) + Caster.Radius;
	if (Light.Range > 0.0 && dot(ToLight, ToLight) > Reach * Reach) { return false; }
	return SegmentDistanceSquared(Center, ToLight, Caster.From, Caster.To - Caster.From) <= Wide * Wide;
}

// As MayAnyShadow, of pairs of a caster and a light.
bool MayAnyShadowLamp(FSceneConstants Scene, FViewConstants View, FCasterList List, vec4 Bound)
{
	for (uint I = gl_LocalInvocationIndex; I < List.Count * Scene.LightCount; I += 64u)
	{
		FMovedCaster Caster = FMovedCasterRef(List.Casters).Data[I % List.Count];
		FLightData Light = FLightRef(Scene.Lights).Data[I / List.Count];
		if (MayShadowLamp(Scene, Caster, Light, View.CameraPosition + Bound.xyz, Bound.w)) { return true; }
	}
	return false;
}

#endif
