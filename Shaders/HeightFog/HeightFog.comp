// Fog whose density falls off with height, scattering once: light of the sun, of local lights and of all around by froxels. Without the last,
// the sky's light has no shadow.
// The sun's light arrives as if no fog lay on its way. HAS_SUN, HAS_SKY: defined if the scene has such.
#version 460
#include "../Shared/HeightFogTypes.h"
#include "../Fog/FogAtlas.glsl"
#include "../IndirectVolume/ReadVolume.glsl"
#include "../Library/Phase.glsl"
#include "../Library/GBuffer.glsl"
#include "../Library/SkyLight.glsl"

layout(local_size_x = HEIGHT_FOG_GROUP_SIZE, local_size_y = HEIGHT_FOG_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FHeightFogConstants Push; };

const float FarAway = 1.0e6; // metres, of the sky

// Integrates the extinction over Length metres. P: relative to the scene's origin.
float OpticalDepth(vec3 P, vec3 Direction, float Length)
{
	float Exponent = clamp(-Push.Falloff * (P.y - Push.BaseHeight), -80.0, 80.0);
	float X = max(Push.Falloff * Direction.y * Length, -80.0);
	float Mean = abs(X) < 1.0e-3 ? 1.0 - 0.5 * X : (1.0 - exp(-X)) / X;
	return Push.Density * exp(Exponent) * Mean * Length;
}

struct FMarch
{
	vec3 Radiance;
	float Transmittance;
};

// Source: radiance that arrives from the fog, over its scattering coefficient. It is exact for a source that is constant over the step.
void Step(inout FMarch March, vec3 Source, vec3 P, vec3 Direction, float Length)
{
	float Left = March.Transmittance * exp(-OpticalDepth(P, Direction, Length));
	March.Radiance += Source * (Push.Albedo * (March.Transmittance - Left));
	March.Transmittance = Left;
}

// Returns what the fog scatters of light that comes by surfaces, the sky and what shines. Far: what it takes where nothing else is known.
vec3 ScatterIndirect(vec2 Pixel, float Distance, float End, vec3 Direction, vec3 Far)
{
	if (Push.VolumeLight == NO_TEXTURE || Distance >= Push.VolumeGrid.Distance) { return Far; }
	return AirScattered(SampleIndirectVolume(Push.VolumeGrid, Push.VolumeLight, Push.VolumeMoment, Pixel, Distance, End), Direction, Push.Phase);
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Pixel = gl_GlobalInvocationID.xy;
	if (IsOutsideView(View, Pixel)) { return; }
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	vec2 At = vec2(Pixel) + 0.5;
	vec3 Direction = CameraRay(View, At);
	float End = Depth > 0.0 ? DistanceFromDepth(View, Depth) : FarAway, PerDistance = 1.0 / dot(Direction, View.CameraForward);
	vec3 Sun = vec3(0.0), Sky = vec3(0.0);
#ifdef HAS_SUN
	Sun = Scene.SunColor * (Scene.SunIrradiance * PhaseFunction(dot(-Scene.SunDirection, Direction), Push.Phase));
#endif
#ifdef HAS_SKY
	vec3 Up = vec3(0.0, 1.0, 0.0);
	Sky = 0.5 * Push.Sky * (SkyAmbient(Scene, Push.SkyLight, Up) + SkyAmbient(Scene, Push.SkyLight, -Up));
#endif
	FMarch March = FMarch(vec3(0.0), 1.0);
	float Begin = 0.0;
	vec3 Indirect = Sky;
	[[dont_unroll]] for (uint Slice = 0u; Slice < Push.Grid.Slices && Begin < End; ++Slice)
	{
		float Next = min(FroxelDistance(Push.Grid, float(Slice + 1u)), End);
		vec4 Lit = SampleFog(Push.Grid, Push.Visibility, Push.Light, At - PixelJitter(View), 0.5 * (Begin + Next), End);
		// It changes more slowly than shadows do.
		if ((Slice & 1u) == 0u) { Indirect = ScatterIndirect(At - PixelJitter(View), 0.5 * (Begin + Next), End, Direction, Sky); }
		vec3 P = View.CameraPosition + RelativePosition(View, At, Begin);
		Step(March, Sun * Lit.w + Lit.xyz + Indirect, P, Direction, (Next - Begin) * PerDistance);
		Begin = Next;
	}
	if (Begin < min(End, Push.VolumeGrid.Distance) && Push.VolumeLight != NO_TEXTURE)
	{
		float Next = min(End, Push.VolumeGrid.Distance);
		vec3 P = View.CameraPosition + RelativePosition(View, At, Begin);
		Indirect = ScatterIndirect(At - PixelJitter(View), 0.5 * (Begin + Next), End, Direction, Sky);
		Step(March, Sun + Indirect, P, Direction, (Next - Begin) * PerDistance);
		Begin = Next;
	}
	if (Begin < End)
	{
		Step(March, Sun + Sky, View.CameraPosition + RelativePosition(View, At, Begin), Direction, (End - Begin) * PerDistance);
	}
	vec3 Behind = texelFetch(Textures[Push.Lighting], ivec2(Pixel), 0).rgb;
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(Behind * March.Transmittance + March.Radiance, 1.0));
}
