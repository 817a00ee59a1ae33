// Lights pixels by local lights, from the answers of their rays.
#version 460
#include "../Rays/RayQueue.glsl"
#include "../Tiles/Tile.glsl"
#include "LocalPoint.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FLocalShadeConstants Push; };

// Rays of the tile by slot: where some had no room in the queue, their pixels take the mean of the others.
shared uint Seen[TILE_LIGHTS], Traced[TILE_LIGHTS];

struct FLobes
{
	vec3 Diffuse, Specular;
};

// Returns the visibility of a slot's light.
float SlotVisibility(uint Answer, uint Slot, uint SeenBit, uint TracedBit)
{
	if ((Answer & (1u << TracedBit)) != 0u) { return (Answer & (1u << SeenBit)) != 0u ? 1.0 : 0.0; }
	return Traced[Slot] > 0u ? float(Seen[Slot]) / float(Traced[Slot]) : 1.0;
}

void CountAnswer(uint Answer, uint Slot, uint SeenBit, uint TracedBit)
{
	atomicAdd(Traced[Slot], (Answer >> TracedBit) & 1u);
	atomicAdd(Seen[Slot], (Answer >> SeenBit) & 1u);
}

void AddLight(inout FLobes Sum, FSceneConstants Scene, FViewConstants View, FLocalPoint Point, FBrdf Brdf, mat3 Basis, uvec2 Pixel,
              uint Light, float Weight)
{
	FLightSample Sample = SampleLocalLight(Scene, View, Point, Pixel, Light);
	if (!ReachesLight(View, Point, Sample)) { return; }
	vec3 Diffuse, Specular;
	vec3 L = Sample.Direction * Basis;
	EvaluateLobes(Brdf, Point.Surface.V * Basis, L, Diffuse, Specular);
	vec3 Incident = Sample.Irradiance * (L.z * Weight); // no lobe reflects what comes from below
	Sum.Diffuse += Diffuse * Incident;
	Sum.Specular += Specular * Incident;
}

FLobes ShadePixel(FTileLights Tile, FSceneConstants Scene, FViewConstants View, uvec2 Pixel, uint Place, uint Answer, FLocalPoint Point,
                  FBrdf Brdf, mat3 Basis)
{
	FLobes Sum = FLobes(vec3(0.0), vec3(0.0));
	if (Tile.Count == TILE_LIGHTS_MANY)
	{
#ifdef MANY_LIGHTS
		FLightChoice Choice = FLightChoiceRef(Push.Choices).Data[Pixel.y * View.Width + Pixel.x];
		if (Choice.Weight <= 0.0) { return Sum; }
		bool bAsked = (Tile.Reached[Place >> 5u] & (1u << (Place & 31u))) != 0u;
		float Visibility = bAsked ? SlotVisibility(Answer, 0u, ANSWER_CHOSEN_SEEN, ANSWER_CHOSEN_TRACED) : 1.0;
		if (Visibility > 0.0) { AddLight(Sum, Scene, View, Point, Brdf, Basis, Pixel, Choice.Light, Choice.Weight * Visibility); }
#endif
		return Sum;
	}
	for (uint I = 0u; I < Tile.Count; ++I)
	{
		if ((Tile.Reached[2u * I + (Place >> 5u)] & (1u << (Place & 31u))) == 0u) { continue; }
		bool bUnshadowed = (Tile.Lights[I] & TILE_LIGHT_UNSHADOWED) != 0u;
		float Visibility = bUnshadowed ? 1.0 : SlotVisibility(Answer, I, ANSWER_LOCAL_SEEN + I, ANSWER_LOCAL_TRACED + I);
		if (Visibility <= 0.0) { continue; }
		AddLight(Sum, Scene, View, Point, Brdf, Basis, Pixel, Tile.Lights[I] & ~TILE_LIGHT_UNSHADOWED, Visibility);
	}
	return Sum;
}

// Over the lobes' albedos, so that filters see light and not textures.
void WriteLobes(uvec2 Pixel, FLobes Sum, FBrdf Brdf, float NdotV, float Roughness)
{
	const float MaxHalf = 65504.0;
	vec3 Diffuse = Sum.Diffuse / max(DiffuseReflectance(Brdf, NdotV), vec3(1.0e-4));
	vec3 Specular = Sum.Specular / max(SpecularReflectance(Brdf, NdotV, Roughness), vec3(1.0e-4));
	if (Push.OutDiffuse != NO_TEXTURE) { imageStore(Images[Push.OutDiffuse], ivec2(Pixel), vec4(min(Diffuse, MaxHalf), 1.0)); }
	if (Push.OutSpecular != NO_TEXTURE) { imageStore(Images[Push.OutSpecular], ivec2(Pixel), vec4(min(Specular, MaxHalf), 1.0)); }
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	uint Place = gl_LocalInvocationIndex;
	uvec2 Pixel = TilePixel(gl_WorkGroupID.xy, Place);
	bool bInside = !IsOutsideView(View, Pixel);
	uint Answer = bInside ? FAnswerRef(Push.Answers).Data[Pixel.y * View.Width + Pixel.x] : 0u;
	FTileLights Tile = FTileLightsRef(Push.TileLights).Data[TileIndex(View, gl_WorkGroupID.xy)];
	if (Place < TILE_LIGHTS) { Seen[Place] = Traced[Place] = 0u; }
	barrier();
	if (Tile.Count == TILE_LIGHTS_MANY) { CountAnswer(Answer, 0u, ANSWER_CHOSEN_SEEN, ANSWER_CHOSEN_TRACED); }
	else
	{
		for (uint I = 0u; I < Tile.Count; ++I) { CountAnswer(Answer, I, ANSWER_LOCAL_SEEN + I, ANSWER_LOCAL_TRACED + I); }
	}
	barrier();
	if (!bInside) { return; }
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	if (Depth <= 0.0 || Tile.Count == 0u)
	{
		WriteLobes(Pixel, FLobes(vec3(0.0), vec3(0.0)), MakeWhiteLambert(), 1.0, 1.0);
		return;
	}
	FLocalPoint Point = LoadLocalPoint(Scene, View, Push.Normals, Pixel, Depth);
	vec4 Material = texelFetch(Textures[Push.Material], ivec2(Pixel), 0);
	FBrdf Brdf = MakeGBufferBrdf(texelFetch(Textures[Push.BaseColor], ivec2(Pixel), 0), Material);
	Brdf.Alpha = max(Brdf.Alpha, 2.0 * MinAlpha); // a perfect mirror would show no point light
	mat3 Basis = MakeBasis(Point.Surface.BentN);
	FLobes Sum = ShadePixel(Tile, Scene, View, Pixel, Place, Answer, Point, Brdf, Basis);
	WriteLobes(Pixel, Sum, Brdf, dot(Point.Surface.BentN, Point.Surface.V), Material.x);
}
