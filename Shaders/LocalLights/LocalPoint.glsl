// The point of a light that a pixel asks about: the requests, the rays and the shading of a frame must agree on it.
#ifndef LANTERN_LOCAL_POINT_GLSL
#define LANTERN_LOCAL_POINT_GLSL

#include "../Shared/LocalLightTypes.h"
#include "../Shared/RayQueueTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/Lights.glsl"
#include "../Library/Random.glsl"
#include "../Library/Rate.glsl"
#ifdef LOCAL_EMISSIVE
#include "../Library/EmissionShare.glsl"
#include "Emitters.glsl"
#endif

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FTileLightsRef { FTileLights Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FLightChoiceRef { FLightChoice Data[]; };

// Lights that each pixel has a ray to.
uint CountSlots(FTileLights Tile) { return Tile.Count == TILE_LIGHTS_MANY ? 0u : Tile.Count; }

// Whether pixels choose of lights, and not of emissive triangles alone.
bool ChoosesOfLights(FTileLights Tile) { return Tile.Count == TILE_LIGHTS_MANY || Tile.bChooses == TILE_CHOOSES_REST; }

// Whether pixels have chosen in this frame.
bool HaveChosen(FTileLights Tile) { return Tile.bChooses != 0u && Tile.bChooses != TILE_CHOOSES_NOBODY; }

#ifndef CHOSEN_RAYS
#define CHOSEN_RAYS 1u
#endif

// Lights that a pixel chooses, if its tile does.
uint CountChosen(FTileLights Tile) { return Tile.Count == TILE_LIGHTS_MANY ? CHOSEN_RAYS : 1u; }
uint ChoiceIndex(FViewConstants View, uint PixelIndex, uint Which) { return Which * View.Width * View.Height + PixelIndex; }
// Tiles with more than one choice have no slots, whose bits are free.
uint ChosenSeenBit(uint Which) { return Which == 0u ? ANSWER_CHOSEN_SEEN : ANSWER_LOCAL_SEEN + Which - 1u; }
uint ChosenTracedBit(uint Which) { return Which == 0u ? ANSWER_CHOSEN_TRACED : ANSWER_LOCAL_TRACED + Which - 1u; }

// A surface that local lights reach.
struct FLocalPoint
{
	FGBufferPoint Surface;
	vec3 P;       // relative to the scene's origin
	vec3 Horizon; // normal of the plane below which lights do not count
	uint Channels; // of its object
};

FLocalPoint LoadLocalPoint(FSceneConstants Scene, FViewConstants View, uint Normals, uvec2 Pixel, float Depth)
{
	FLocalPoint Point;
	Point.Surface = LoadGBufferPoint(View, Normals, ivec2(Pixel), Depth);
	Point.P = View.CameraPosition + Point.Surface.Relative;
	Point.Horizon = Point.Surface.bSure ? Point.Surface.Ng : Point.Surface.BentN;
	Point.Channels = AllChannels; // until somebody loads them
	return Point;
}

// And of which channels its object is. Channels: see LoadPixelChannels.
FLocalPoint LoadLocalPoint(FSceneConstants Scene, FViewConstants View, uint Normals, uint Channels, uvec2 Pixel, float Depth)
{
	FLocalPoint Point = LoadLocalPoint(Scene, View, Normals, Pixel, Depth);
#ifdef HAS_LIGHT_CHANNELS
	Point.Channels = LoadPixelChannels(Channels, Pixel);
#endif
	return Point;
}

struct FLobes
{
	vec3 Diffuse, Specular;
};

// 6 × fp16.
uint[3] PackLobes(FLobes Lobes)
{
	const float MaxHalf = 65504.0;
	vec3 D = min(Lobes.Diffuse, MaxHalf), S = min(Lobes.Specular, MaxHalf);
	return uint[3](packHalf2x16(D.xy), packHalf2x16(vec2(D.z, S.x)), packHalf2x16(S.yz));
}
FLobes UnpackLobes(uint Packed[3])
{
	vec2 Middle = unpackHalf2x16(Packed[1]);
	return FLobes(vec3(unpackHalf2x16(Packed[0]), Middle.x), vec3(Middle.y, unpackHalf2x16(Packed[2])));
}

// How a surface reflects.
struct FLocalBrdf
{
	FBrdf Brdf;
	mat3 Basis; // see FBrdf
	float EmitterSpecular; // share of what its specular lobe reflects of emissive triangles that counts here
};

// BackAlbedo: see LoadBack. ReflectedRoughness: see EmissionOfRays.
FLocalBrdf LoadLocalBrdf(FLocalPoint Point, uint BaseColor, uint Material, uint BackAlbedo, uvec2 Pixel, float ReflectedRoughness)
{
	FLocalBrdf Out;
	vec4 Texel = texelFetch(Textures[Material], ivec2(Pixel), 0);
	Out.Brdf = MakeGBufferBrdf(texelFetch(Textures[BaseColor], ivec2(Pixel), 0), Texel);
	AddBackLobe(BackAlbedo, ivec2(Pixel), Out.Brdf);
	Out.Brdf.Alpha = max(Out.Brdf.Alpha, 2.0 * MinAlpha); // a perfect mirror would show no point light
	Out.Basis = MakeBasis(Point.Surface.BentN);
	Out.EmitterSpecular = 1.0;
#ifdef LOCAL_EMISSIVE
	Out.EmitterSpecular -= EmissionOfRays(Texel.x, ReflectedRoughness);
#endif
	return Out;
}

// As EstimateLight, of what reaches any side of the pixel that counts.
float EstimateLightAt(FSceneConstants Scene, FLightData Light, FLocalPoint Point)
{
	float Estimate = EstimateLight(Scene, Light, Point.P, Point.Horizon);
	return Estimate <= 0.0 && Point.Surface.bBack ? EstimateLight(Scene, Light, Point.P, -Point.Horizon) : Estimate;
}

// Two numbers in [0, 1) that stratify over the pixels of a tile and over frames. Purpose: each has numbers of its own. More: 0, or which of
// LOCAL_MORE_RAYS, from 1 on.
vec2 LocalNumbers(FViewConstants View, uvec2 Pixel, uint Purpose, uint More)
{
	uint Seed = HashPcg(View.Seed + 0x85ebca6bu * (Purpose + 1u));
	FTileSequence Sequence = MakeTileSequence(Pixel, View.FrameIndex, Seed);
#ifdef SPARSE
	// Those that ask in a frame share the sequence out among them, and so do the frames in which a pixel asks.
	uint Place = Sequence.Index ^ View.FrameIndex;
	Sequence = FTileSequence(View.FrameIndex / TurnFrames ^ Place / TurnFrames, HashPcg(Sequence.Seed + TurnOf(Place)));
#endif
	if (More > 0u) { Sequence = FTileSequence(Sequence.Index * LOCAL_MORE_RAYS + More - 1u, HashPcg(Sequence.Seed)); }
	return SobolOwen2(Sequence.Index, Sequence.Seed);
}
vec2 LocalNumbers(FViewConstants View, uvec2 Pixel, uint Purpose) { return LocalNumbers(View, Pixel, Purpose, 0u); }

// Whether each ray goes to a point of its own.
bool HasExtent(FLightData Light)
{
	return LightType(Light) >= LIGHT_RECTANGLE || (LightType(Light) == LIGHT_DIRECTIONAL && Light.Size.x > 0.0);
}

// More: see LocalNumbers.
FLightSample SampleLocalLight(FSceneConstants Scene, FViewConstants View, FLocalPoint Point, uvec2 Pixel, uint Light, uint More)
{
	vec2 U = vec2(0.0);
#ifdef LOCAL_EMISSIVE
	if (IsTriangle(Light)) { return SampleEmitter(Scene, Light & ~LIGHT_TRIANGLE, Point.P, LocalNumbers(View, Pixel, Light)); }
#endif
#ifdef HAS_AREA_LIGHTS
	U = LocalNumbers(View, Pixel, Light, More);
#endif
	FLightData Data = FLightRef(Scene.Lights).Data[Light];
	if (!SharesChannel(Data, Point.Channels)) { return FLightSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 1.0); }
	return SampleLight(Scene, Data, Point.P, U);
}

// What the surface reflects of a light's point, if nothing is in between. Light: its number.
FLobes ReflectLight(FLocalPoint Point, FLocalBrdf Local, FLightSample Sample, uint Light)
{
	FLobes Lobes;
	vec3 L = Sample.Direction * Local.Basis;
	Lobes.Diffuse = Lobes.Specular = vec3(0.0);
	if (!MayShow(Point.Surface, Sample.Direction, L.z)) { return Lobes; }
	EvaluateLobes(Local.Brdf, Point.Surface.V * Local.Basis, L, Lobes.Diffuse, Lobes.Specular);
	vec3 Incident = Sample.Irradiance * abs(L.z);
	Lobes.Diffuse *= Incident;
	Lobes.Specular *= Incident;
#ifdef LOCAL_EMISSIVE
	if (IsTriangle(Light)) { Lobes.Specular *= Local.EmitterSpecular; }
#endif
	return Lobes;
}

bool ReachesLight(FViewConstants View, FLocalPoint Point, FLightSample Sample)
{
	return MaxComponent(Sample.Irradiance) > 0.0 && LeavesSurface(View, Point.Surface, Sample.Direction);
}

#endif
