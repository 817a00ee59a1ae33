// How much of the light that reaches each pixel, from all around or within its specular lobe, may have changed. Objects that moved hid it,
// shone, or reflected it: they give a share. Lamps that changed give a radiance. The filter forgets as much (FDenoiseInputs::ChangedShare).
// A mirror shows another surface, and the light is that surface's: objects that moved may also have shadowed it from the sun.
// NO_SHOWN: planted fault (r.RT.Debug.MovedShare.Shown).
#version 460
#include "../Shared/MovedShareTypes.h"
#include "../Library/Brdf.glsl"
#include "../Library/GBuffer.glsl"
#include "../Library/MovedCasters.glsl"
#include "../Library/RadianceChange.glsl"
#include "../Library/RadianceEvents.glsl"
#include "../Shared/SharedPathTypes.h"
#include "../LocalLights/TileBox.glsl"
#include "../Tiles/Tile.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(push_constant, scalar) uniform FPush { FMovedShareConstants Push; };

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FPathChangeRef { FPathChange Data[]; };

const float LeastShare = 1.0e-3;
const float LeastShareOfLobes = 1.0e-5; // these are up to a hundred times as narrow
const float LeastShining = 0.01; // nits, times LeastShare: below any light that is seen
const float MostRadiance = 65504.0; // of fp16

shared uint Near[SETTLED_MOST_CASTERS / 32u]; // casters that matter to the tile
shared uint bAnyShown;

// A surface whose light is asked for.
struct FLitSurface
{
	vec3 P;      // relative to the scene's origin, metres
	vec3 Normal;
	vec3 Axis;   // of its specular lobe
	float Alpha; // of that lobe; 1: its light comes from all around
	bool bFound;
	bool bShown; // by a mirror
	float Identity; // of its object, with bShown: see FSurface
};

// Returns the sphere (xyz: relative to the scene's origin, w: radius) around all surfaces of the tile. Radius < 0: there is none.
vec4 BoundBox()
{
	if (IsBoxEmpty()) { return vec4(0.0, 0.0, 0.0, -1.0); }
	vec3 Least = BoxCorner(LowBits), Most = BoxCorner(HighBits);
	return vec4(0.5 * (Least + Most), 0.5 * distance(Least, Most));
}

// Returns what a mirror shows. Mirror: its own surface. Nothing is found where it shows the sky.
FLitSurface FindShown(FViewConstants View, FGBufferPoint Mirror, ivec2 Pixel)
{
	FSurface Image = LoadSurface(Push.Shown, Pixel);
	float Beyond = Image.Distance - dot(View.CameraForward, Mirror.Relative), Forward = -dot(View.CameraForward, Mirror.V);
	bool bFound = Image.Distance > 0.0 && Forward > 0.0;
	vec3 P = Mirror.Relative + reflect(-Mirror.V, Mirror.BentN) * (bFound ? max(Beyond, 0.0) / Forward : 0.0);
	return FLitSurface(View.CameraPosition + P, reflect(Image.Normal, Mirror.BentN), vec3(0.0), 1.0, bFound, true,
	                   Image.Identity);
}

FLitSurface FindLit(FViewConstants View, ivec2 Pixel)
{
	FLitSurface Lit = FLitSurface(vec3(0.0), vec3(0.0), vec3(0.0), 1.0, false, false, 0.0);
	float Depth = IsOutsideView(View, uvec2(Pixel)) ? 0.0 : LoadDepth(Push.Depth, Pixel);
	if (!(Depth > 0.0)) { return Lit; }
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
	if (Push.Material != NO_TEXTURE)
	{
		float Roughness = texelFetch(Textures[Push.Material], Pixel, 0).x;
		Lit.Alpha = Roughness * Roughness;
#ifndef NO_SHOWN
		if (Lit.Alpha < MinAlpha) { return FindShown(View, Point, Pixel); }
#endif
	}
	return FLitSurface(View.CameraPosition + Point.Relative, Point.BentN, reflect(-Point.V, Point.BentN), Lit.Alpha, true, false,
	                   0.0);
}

bool MayShadowSun(FSceneConstants Scene, FMovedCaster Caster, vec3 Center, float Radius)
{
	return Caster.bCasts != 0u && Scene.SunIrradiance > 0.0 && MayShadow(Caster, Center, Radius, Scene.SunDirection, GetShadowSpread(Scene.SunOneMinusCos));
}

void FindNear(FSceneConstants Scene, uint Place)
{
	vec4 Bound = BoundBox();
	if (Bound.w < 0.0) { return; }
	for (uint I = Place; I < Push.CasterCount; I += TILE_PIXELS)
	{
		FMovedCaster Caster = FMovedCasterRef(Push.Casters).Data[I];
		float Away = max(distance(Caster.To, Bound.xyz) - distance(Caster.From, Caster.To) - Bound.w, Caster.Radius);
		float Least = (Push.Material == NO_TEXTURE ? LeastShare : LeastShareOfLobes) * Away * Away / (Caster.Radius * Caster.Radius);
		bool bNear = 2.0 * Caster.Changed > Least || Caster.Emission > LeastShining * Least;
		if (bNear || (bAnyShown != 0u && MayShadowSun(Scene, Caster, Bound.xyz, Bound.w))) { atomicOr(Near[I >> 5u], 1u << (I & 31u)); }
	}
}

// Returns the share of the light that changes in a frame, by what the paths around have found in radiance cells: what is more than the noise
// of cells.
float GetShareOfPaths(FViewConstants View)
{
	const float Sigmas = 1.0;
	ivec2 Last = (ivec2(View.Width, View.Height) - 1) / ivec2(TILE_SIZE);
	FPathChange Sum = FPathChange(0.0, 0.0, 0.0);
	for (int I = 0; I < 9; ++I)
	{
		ivec2 Tile = ivec2(gl_WorkGroupID.xy) + ivec2(I % 3, I / 3) - 1;
		if (any(lessThan(Tile, ivec2(0))) || any(greaterThan(Tile, Last))) { continue; }
		FPathChange Change = FPathChangeRef(Push.Changes).Data[TileIndex(View, uvec2(Tile))];
		Sum = FPathChange(Sum.Light + Change.Light, Sum.Gone + Change.Gone, Sum.Squares + Change.Squares);
	}
	float Certain = abs(Sum.Gone) - Sigmas * sqrt(Sum.Squares);
	if (!(Certain > 0.0)) { return 0.0; }
	return min(1.0 / GetFramesOfChange(Certain / max(Sum.Light, Sum.Light + Sum.Gone), ChangeInPixels, Push.Moment), 1.0);
}

vec2 GetShare(FSceneConstants Scene, FMovedCaster Mover, FLitSurface Lit)
{
	vec2 Share = GetMovedShare(Mover, Lit.P, Lit.Normal);
	if (Push.Material == NO_TEXTURE) { return Share; }
	if (!Lit.bShown) { return vec2(GetMovedShareOfLobe(Mover, Lit.P, Lit.Axis, Lit.Alpha), Share.y); }
	if (Lit.Identity == MakeIdentity(float(Mover.Object + 1u))) { return vec2(0.0, Share.y); } // its own shadow moves with it
	bool bShadowed = dot(Lit.Normal, Scene.SunDirection) < 0.0 && MayShadowSun(Scene, Mover, Lit.P, 0.0);
	return bShadowed ? vec2(1.0, Share.y) : Share;
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	uint Place = gl_LocalInvocationIndex;
	if (Place < SETTLED_MOST_CASTERS / 32u) { Near[Place] = 0u; }
	StartBox(Place);
	if (Place == 0u) { bAnyShown = 0u; }
	barrier();
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	FLitSurface Lit = FindLit(View, Pixel);
	if (Lit.bFound) { GrowBox(Lit.P); }
	if (Lit.bFound && Lit.bShown) { bAnyShown = 1u; }
	barrier();
	FindNear(Scene, Place);
	barrier();
	if (IsOutsideView(View, uvec2(Pixel))) { return; }
	vec2 Moved = vec2(0.0, Lit.bFound ? GetLampChange(Push.Lamps, Push.LampCount, Lit.P) : 0.0);
	if (Push.Changes != FAddress(0)) { Moved.x = GetShareOfPaths(View); }
	for (uint Word = 0u; Word < SETTLED_MOST_CASTERS / 32u && Lit.bFound; ++Word)
	{
		for (uint Bits = Near[Word]; Bits != 0u; Bits &= Bits - 1u)
		{
			FMovedCaster Mover = FMovedCasterRef(Push.Casters).Data[Word * 32u + uint(findLSB(Bits))];
			Moved += GetShare(Scene, Mover, Lit);
		}
	}
	Moved = mix(Moved, vec2(0.0), isnan(Moved)); // of an object whose place is no number
	imageStore(Images[Push.Output], Pixel, vec4(min(Moved, vec2(1.0, MostRadiance)), 0.0, 0.0));
}
