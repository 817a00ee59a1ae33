// Lights froxels; the ray-tracing pipeline and the ray-query path share it. Each thread has two slices of a column, and traces one of them
// in turn. The includer defines
//   float UnblockedShare(vec3 Origin, vec3 Direction, float Length, uint Mask)   of the light along a ray
//
// FOG_SUN, FOG_LIGHTS: defined if the scene has such light. FOG_NEXT_SLICE: planted fault, see r.RT.Debug.Fog.Slice.
#ifndef LANTERN_FOG_SHADOW_GLSL
#define LANTERN_FOG_SHADOW_GLSL

#include "../Shared/FogTypes.h"
#include "../Library/Bindings.glsl"

layout(push_constant, scalar) uniform FPush { FFogShadowConstants Push; };

#include "../Library/Casters.glsl"
#include "../Library/Random.glsl"
#include "../Library/Sun.glsl"
#include "Froxels.glsl"

struct FFroxelValue
{
	float Visibility;
	vec3 Light;
};

FFroxelValue NoFroxelValue() { return FFroxelValue(0.0, vec3(0.0)); }

bool AddFroxel(ivec2 Texel, float Weight, inout FFroxelValue Sum)
{
	float Visibility = Push.PreviousVisibility != NO_TEXTURE ? texelFetch(Textures[Push.PreviousVisibility], Texel, 0).x : 0.0;
	vec3 Light = Push.PreviousLight != NO_TEXTURE ? texelFetch(Textures[Push.PreviousLight], Texel, 0).xyz : vec3(0.0);
	if (any(isnan(Light)) || any(isinf(Light))) { return false; }
	Sum.Visibility += Weight * Visibility;
	Sum.Light += Weight * Light;
	return true;
}

void ScaleFroxel(float Factor, inout FFroxelValue Value)
{
	Value.Visibility *= Factor;
	Value.Light *= Factor;
}

#include "FogHistory.glsl"
#include "FroxelSample.glsl"

const float FogRayLength = 1.0e5; // metres, to the sun
const float MostFogLight = 65504.0; // of a half float

float UnblockedShare(vec3 Origin, vec3 Direction, float Length, uint Mask);

#ifdef FOG_LIGHTS
#include "FogLights.glsl"
#endif

// End: see PlaceInFroxel.
FFroxelValue TraceFroxel(FSceneConstants Scene, FViewConstants View, ivec3 Froxel, float End)
{
	uint Seed = SeedOfFroxel(View, Froxel);
	FRandom Random = MakeRandom(uvec2(Froxel.xy), View.FrameIndex, Seed);
	vec3 Relative = PlaceInFroxel(Push.Grid, View, Froxel, End, FroxelJitter(View.FrameIndex, Seed));
	vec3 P = View.CameraPosition + Relative;
	FFroxelValue Value = FFroxelValue(0.0, vec3(0.0));
#ifdef FOG_SUN
	Scene.SunOneMinusCos = Push.SunOneMinusCos;
	vec3 ToSun = Push.SunOneMinusCos > 0.0 ? SampleSunDirection(Scene, NextRandom4(Random).xy) : -Scene.SunDirection;
	Value.Visibility = UnblockedShare(P, ToSun, FogRayLength, SunCasters(false));
#endif
#ifdef FOG_LIGHTS
	vec3 Place = vec3(Froxel) + 0.5;
	float Thickness = FroxelDistance(Push.Grid, Place.z + 0.5) - FroxelDistance(Push.Grid, Place.z - 0.5);
	float Width = PixelHeight(View, FroxelDistance(Push.Grid, Place.z)) * float(Push.Grid.PixelSize);
	float Radius = pow(Width * Width * Thickness * (3.0 / (4.0 * Pi)), 1.0 / 3.0);
	Value.Light = TraceFogLight(Scene, P, ViewDirection(View, Relative), Radius, Push.Phase, Random);
	if (any(isnan(Value.Light)) || any(isinf(Value.Light))) { Value.Light = vec3(0.0); }
#endif
	return Value;
}

// Rounded to what the texture holds, up or down by chance: a mean of frames would else stop at a distance from its limit.
float DitherVisibility(float Visibility, ivec3 Froxel, uint FrameIndex)
{
	float Threshold = float(HashPcg4(uvec4(Froxel, FrameIndex)).x >> 8u) * (1.0 / 16777216.0);
	return floor(Visibility * 255.0 + Threshold) / 255.0;
}

// Count: of slices that are lit. End: see PlaceInFroxel.
void LightFroxel(FSceneConstants Scene, FViewConstants View, ivec3 Froxel, uint Count, float End, bool bTurn)
{
	FFroxelValue Value = FFroxelValue(0.0, vec3(0.0)), Traced;
	bool bKnown = LoadFogHistory(View, FroxelPosition(Push.Grid, View, vec3(Froxel) + 0.5), Value);
	if (uint(Froxel.z) < Count && (bTurn || !bKnown))
	{
		Traced = TraceFroxel(Scene, View, Froxel, End);
		float Share = bKnown ? Push.Share : 1.0;
		Value = FFroxelValue(mix(Value.Visibility, Traced.Visibility, Share), mix(Value.Light, Traced.Light, Share));
	}
	ivec2 Texel = FroxelTexel(Push.Grid, Froxel);
	if (Push.OutVisibility != NO_TEXTURE)
	{
		imageStore(Images[Push.OutVisibility], Texel, vec4(DitherVisibility(Value.Visibility, Froxel, View.FrameIndex)));
	}
	if (Push.OutLight != NO_TEXTURE) { imageStore(Images[Push.OutLight], Texel, RoundToHalf(vec4(min(Value.Light, vec3(MostFogLight)), 1.0))); }
}

void BeginPair(FViewConstants View, ivec2 Column, uint Pair) {}

#include "FroxelPairs.glsl"

#endif
