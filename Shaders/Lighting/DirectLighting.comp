// The composite: direct light of the sun and the scene's lights, indirect light, emission, and the sky itself.
// HAS_SUN, HAS_LIGHTS, HAS_SKY: what the scene has; the rest is not compiled. HAS_SKY is for the sky's ambient light, which
// stands in where indirect light was not traced.
#version 460
#include "../Shared/LightingTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/Lights.glsl"
#include "../Library/Sun.glsl"

layout(local_size_x = LIGHTING_GROUP_SIZE, local_size_y = LIGHTING_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FLightingConstants Push; };

vec3 ShadeSky(FSceneConstants Scene, vec3 Direction)
{
	vec3 L = Scene.SkyRadiance;
#ifdef HAS_SUN
	if (Scene.SunOneMinusCos > 0.0 && IsInSunDisk(Scene, Direction)) { L += SunRadiance(Scene); }
#endif
	return L;
}

vec3 ShadeDirect(FSceneConstants Scene, FViewConstants View, ivec2 Pixel, FGBufferPoint Point, FBrdf B, mat3 Basis, vec3 LocalV)
{
	vec3 Radiance = vec3(0.0);
	B.Alpha = max(B.Alpha, 2.0 * MinAlpha); // a point light has no image in a perfect mirror
#ifdef HAS_SUN
	float Sun = Push.SunVisibility != NO_TEXTURE ? texelFetch(Textures[Push.SunVisibility], Pixel, 0).x : 1.0;
	if (Sun > 0.0)
	{
		Radiance += EvaluateBrdfCos(B, LocalV, -Scene.SunDirection * Basis) * Scene.SunColor * (Scene.SunIrradiance * Sun);
	}
#endif
#ifdef HAS_LIGHTS
	vec3 P = View.CameraPosition + Point.Relative;
	FLightRef Lights = FLightRef(Scene.Lights);
	for (uint I = 0; I < Scene.LightCount; ++I)
	{
		vec3 Towards;
		float Distance;
		vec3 Irradiance = PunctualIrradiance(Lights.Data[I], P, Towards, Distance);
		if (MaxComponent(Irradiance) > 0.0 && dot(Point.Ng, Towards) > 0.0)
		{
			Radiance += EvaluateBrdfCos(B, LocalV, Towards * Basis) * Irradiance;
		}
	}
#endif
	return Radiance;
}

// Lagarde and de Rousiers 2014 ("Moving Frostbite to Physically Based Rendering"): fits how ambient occlusion, which is about
// the whole hemisphere, narrows to a lobe.
float SpecularOcclusion(float NdotV, float Visibility, float Roughness)
{
	return clamp(pow(NdotV + Visibility, exp2(-16.0 * Roughness - 1.0)) - 1.0 + Visibility, 0.0, 1.0);
}

vec3 ShadeIndirect(FSceneConstants Scene, ivec2 Pixel, FBrdf B, float NdotV, vec4 Material)
{
	vec3 Ambient = vec3(0.0);
	float Visibility = 1.0;
#ifdef HAS_SKY
	Ambient = Scene.SkyRadiance * Material.y;
	if (Push.SkyVisibility != NO_TEXTURE) { Visibility = texelFetch(Textures[Push.SkyVisibility], Pixel, 0).x; }
#endif
	vec3 Diffuse = Ambient * Visibility;
	if (Push.IndirectDiffuse != NO_TEXTURE) { Diffuse = texelFetch(Textures[Push.IndirectDiffuse], Pixel, 0).rgb; }
	vec4 Specular = Push.IndirectSpecular != NO_TEXTURE ? texelFetch(Textures[Push.IndirectSpecular], Pixel, 0) : vec4(0.0);
	if (Specular.a <= 0.0)
	{
		Specular.rgb = Ambient * SpecularReflectance(B, NdotV, Material.x) * SpecularOcclusion(NdotV, Visibility, Material.x);
	}
	return DiffuseReflectance(B, NdotV) * Diffuse + Specular.rgb;
}

vec3 ShadeSurface(FSceneConstants Scene, FViewConstants View, ivec2 Pixel, float Depth)
{
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
	vec4 Material = texelFetch(Textures[Push.Material], Pixel, 0);
	FBrdf B = MakeGBufferBrdf(texelFetch(Textures[Push.BaseColor], Pixel, 0), Material);
	mat3 Basis = MakeBasis(Point.N);
	vec3 LocalV = Point.V * Basis;
	return texelFetch(Textures[Push.Emissive], Pixel, 0).rgb + ShadeDirect(Scene, View, Pixel, Point, B, Basis, LocalV) +
	       ShadeIndirect(Scene, Pixel, B, LocalV.z, Material);
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Pixel = gl_GlobalInvocationID.xy;
	if (any(greaterThanEqual(Pixel, uvec2(View.Width, View.Height)))) { return; }
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	float Depth = texelFetch(Textures[Push.Depth], ivec2(Pixel), 0).x;
	vec3 Radiance = Depth > 0.0 ? ShadeSurface(Scene, View, ivec2(Pixel), Depth) : ShadeSky(Scene, normalize(CameraRay(View, vec2(Pixel) + 0.5)));
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(Radiance, 1.0));
}
