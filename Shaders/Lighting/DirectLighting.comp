// Composites the frame: direct light of the sun and of local lights, indirect light, emission, and the sky itself.
// HAS_SUN, HAS_LIGHTS, HAS_AREA_LIGHTS, HAS_SKY: defined if the scene has such; other code is not compiled. HAS_SKY is for the ambient light of
// the sky, which replaces indirect light that was not traced. LOCAL_EMISSIVE: emissive triangles are among local lights.
// HAS_TOON: some objects have a style of their own in indirect light (Library/Toon.glsl).
// HAS_LIGHT_PROFILES, HAS_LIGHT_CHANNELS: see LightProfile.glsl.
#version 460
#include "../Shared/LightingTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/LightCells.glsl"
#include "../Library/Lights.glsl"
#include "../Library/Random.glsl"
#include "../Library/SkyLight.glsl"
#include "../Library/Sun.glsl"
#ifdef HAS_TOON
#include "../Library/Toon.glsl"
#endif

layout(local_size_x = LIGHTING_GROUP_SIZE, local_size_y = LIGHTING_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FLightingConstants Push; };

vec3 ShadeSky(FSceneConstants Scene, vec3 Direction)
{
	vec3 L = SampleSkyRadiance(Scene, Direction);
#ifdef HAS_SUN
	if (Scene.SunOneMinusCos > 0.0 && IsInSunDisk(Scene, Direction)) { L += SunRadiance(Scene); }
#endif
	return L;
}

#ifdef HAS_SUN
// bMirror: it shows the disk of the sun as it is. The lobe of a smooth surface would have a halo around it.
vec3 ShadeSun(FSceneConstants Scene, FGBufferPoint Point, FBrdf Brdf, vec3 LocalV, vec3 ToSun, bool bMirror)
{
	vec3 Diffuse, Specular;
	EvaluateLobes(Brdf, LocalV, ToSun, Diffuse, Specular);
	// A disk far below a pixel would be missed: the lobe is wider.
	if (bMirror && Scene.SunOneMinusCos > 2.0 * MinAlpha * MinAlpha)
	{
		vec3 Shown = IsInSunDisk(Scene, reflect(-Point.V, Point.BentN)) ? SunRadiance(Scene) : vec3(0.0);
		return Diffuse * abs(ToSun.z) * Scene.SunColor * Scene.SunIrradiance + SpecularFresnel(Brdf, LocalV.z) * Shown;
	}
	return (Diffuse + Specular) * abs(ToSun.z) * Scene.SunColor * Scene.SunIrradiance;
}
#endif

vec3 ShadeDirect(FSceneConstants Scene, FViewConstants View, ivec2 Pixel, FGBufferPoint Point, FBrdf Brdf, mat3 Basis, vec3 LocalV)
{
	vec3 Radiance = vec3(0.0);
	bool bShowsSun = IsMirror(Brdf);
	Brdf.Alpha = max(Brdf.Alpha, 2.0 * MinAlpha); // a perfect mirror would show no point light
	uint Channels = AllChannels;
#ifdef HAS_LIGHT_CHANNELS
	Channels = LoadPixelChannels(Push.Channels, uvec2(Pixel));
#endif
#ifdef HAS_SUN
	float SunVisibility = Push.SunVisibility != NO_TEXTURE ? texelFetch(Textures[Push.SunVisibility], Pixel, 0).x : 1.0;
	vec3 ToSun = -Scene.SunDirection * Basis;
	if (SunVisibility > 0.0 && SunSharesChannel(Scene, Channels) && MayShow(Point, -Scene.SunDirection, ToSun.z))
	{
		Radiance += ShadeSun(Scene, Point, Brdf, LocalV, ToSun, bShowsSun) * SunVisibility;
	}
#endif
#ifdef HAS_LIGHTS
	if (Push.LightsDiffuse != NO_TEXTURE) { return Radiance; }
	vec3 P = View.CameraPosition + Point.Relative;
	FRandom Random = MakeRandom(uvec2(Pixel), View.FrameIndex, View.Seed);
	FLightRef Lights = FLightRef(Scene.Lights);
	FLightWalk Walk = WalkLights(Scene, P, false);
	for (uint I = NextLight(Walk); I < Scene.LightCount; I = NextLight(Walk))
	{
		if (!SharesChannel(Lights.Data[I], Channels)) { continue; }
#ifdef HAS_AREA_LIGHTS
		if (!Point.bBack && EstimateLight(Scene, Lights.Data[I], P, Point.Ng) <= 0.0) { continue; }
		FLightSample Sample = SampleLight(Scene, Lights.Data[I], P, NextRandom4(Random).xy);
#else
		FLightSample Sample = SampleLight(Scene, Lights.Data[I], P, vec2(0.0));
#endif
		vec3 ToLight = Sample.Direction * Basis;
		bool bReaches = Point.bBack ? MayShow(Point, Sample.Direction, ToLight.z) : dot(Point.Ng, Sample.Direction) > 0.0;
		if (MaxComponent(Sample.Irradiance) > 0.0 && bReaches)
		{
			Radiance += EvaluateBrdfCos(Brdf, LocalV, ToLight) * Sample.Irradiance;
		}
	}
#endif
	return Radiance;
}

// Returns the light of local lights where it is known with its shadows.
vec3 ShadeLocal(ivec2 Pixel, FBrdf Brdf, float NdotV, float Roughness)
{
	vec3 Radiance = vec3(0.0);
#if defined(HAS_LIGHTS) || defined(LOCAL_EMISSIVE)
	if (Push.LightsDiffuse == NO_TEXTURE) { return Radiance; }
	Brdf.Alpha = max(Brdf.Alpha, 2.0 * MinAlpha);
	Radiance += DiffuseReflectance(Brdf, NdotV) * texelFetch(Textures[Push.LightsDiffuse], Pixel, 0).rgb;
	Radiance += SpecularReflectance(Brdf, NdotV, Roughness) * texelFetch(Textures[Push.LightsSpecular], Pixel, 0).rgb;
#endif
	return Radiance;
}

// Estimates the occlusion of a specular lobe from ambient occlusion, which covers the whole hemisphere. The fit is that of
// Lagarde and de Rousiers (2014, "Moving Frostbite to Physically Based Rendering").
float SpecularOcclusion(float NdotV, float Visibility, float Roughness)
{
	return clamp(pow(NdotV + Visibility, exp2(-16.0 * Roughness - 1.0)) - 1.0 + Visibility, 0.0, 1.0);
}

#ifdef HAS_SKY
// Stands in for the light that comes from where the sky is hidden. Without rays of its own it can only be guessed: from surfaces
// as open to sky and sun as this one is. Closed places are dark.
vec3 GuessSurroundings(FSceneConstants Scene, vec3 SkyLight, float Visibility)
{
	vec3 Light = SkyLight;
#ifdef HAS_SUN
	Light += Scene.SunColor * (Scene.SunIrradiance / Pi);
#endif
	return Light * (Push.Surroundings * Visibility);
}
#endif

#ifdef HAS_TOON
// Returns the diffuse light of a pixel as its object's style shows it. bTraced: the signal has been graded already.
vec3 ApplyToonStyle(FSceneConstants Scene, FViewConstants View, ivec2 Pixel, vec3 Diffuse, float Visibility, bool bTraced)
{
	uint Toon = Push.ToonPixels != NO_TEXTURE ? ToonOfPixel(texelFetch(Textures[Push.ToonPixels], Pixel, 0).xy) : 0u;
	if (Toon == 0u) { return Diffuse; }
	FToonData Style = LoadToon(Scene, Toon);
	if (!bTraced) { Diffuse = GradeToonLight(Style, Diffuse, View.Exposure); }
	return Diffuse * mix(1.0, Visibility, Style.Occlusion);
}
#endif

// Material: texel of the G-buffer; y: the material's own occlusion.
vec3 ShadeIndirect(FSceneConstants Scene, FViewConstants View, ivec2 Pixel, FBrdf Brdf, FGBufferPoint Point, float NdotV, vec4 Material)
{
	vec3 Ambient = vec3(0.0), Mirrored = vec3(0.0), Surroundings = vec3(0.0);
	float Visibility = Push.SkyVisibility != NO_TEXTURE ? texelFetch(Textures[Push.SkyVisibility], Pixel, 0).x : 1.0;
#ifdef HAS_SKY
	vec3 GatherN = Point.BentN;
#ifdef HAS_TOON
	if (Push.ToonNormals != NO_TEXTURE) { GatherN = BendNormal(OctDecode(texelFetch(Textures[Push.ToonNormals], Pixel, 0).xy), Point.V); }
#endif
	Ambient = SkyAmbient(Scene, Push.SkyLight, GatherN) * Material.y;
	if (HasBack(Brdf)) { Ambient = mix(Ambient, SkyAmbient(Scene, Push.SkyLight, -GatherN) * Material.y, ShareOfSide(Brdf, true)); }
	Mirrored = SkyAmbient(Scene, Push.SkyLight, reflect(-Point.V, Point.BentN)) * Material.y;
	Surroundings = GuessSurroundings(Scene, SkyAmbient(Scene, Push.SkyLight, GatherN), Visibility) * Material.y;
#endif
	vec3 Diffuse = mix(Surroundings, Ambient, Visibility);
#ifdef HAS_TOON
	float Layer = Visibility;
#endif
	if (Push.IndirectDiffuse != NO_TEXTURE)
	{
		// Where no reflection is traced, the specular lobe sees the sky as far as indirect light says that it is open, and that light elsewhere.
		Diffuse = Surroundings = texelFetch(Textures[Push.IndirectDiffuse], Pixel, 0).rgb;
		Visibility = MaxComponent(Mirrored) > 0.0 ? clamp(Luminance(Diffuse) / max(Luminance(Ambient), 1.0e-30), 0.0, 1.0) : 0.0;
	}
#ifdef HAS_TOON
	Diffuse = ApplyToonStyle(Scene, View, Pixel, Diffuse, Layer, Push.IndirectDiffuse != NO_TEXTURE);
#endif
	vec4 Specular = Push.IndirectSpecular != NO_TEXTURE ? texelFetch(Textures[Push.IndirectSpecular], Pixel, 0) : vec4(0.0);
	if (Specular.a < 1.0)
	{
		vec3 Incident = Push.IndirectRough != NO_TEXTURE ? texelFetch(Textures[Push.IndirectRough], Pixel, 0).rgb
		                                                 : mix(Surroundings, Mirrored, SpecularOcclusion(NdotV, Visibility, Material.x));
		Specular.rgb = mix(Incident * SpecularReflectance(Brdf, NdotV, Material.x), Specular.rgb, Specular.a);
	}
	return DiffuseReflectance(Brdf, NdotV) * Diffuse + Specular.rgb;
}

vec3 ShadeSurface(FSceneConstants Scene, FViewConstants View, ivec2 Pixel, float Depth)
{
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
	vec4 Material = texelFetch(Textures[Push.Material], Pixel, 0);
	FBrdf Brdf = MakeGBufferBrdf(texelFetch(Textures[Push.BaseColor], Pixel, 0), Material);
	AddBackLobe(Push.BackAlbedo, Pixel, Brdf);
	mat3 Basis = MakeBasis(Point.BentN);
	vec3 LocalV = Point.V * Basis;
	return texelFetch(Textures[Push.Emissive], Pixel, 0).rgb + ShadeDirect(Scene, View, Pixel, Point, Brdf, Basis, LocalV) +
	       ShadeLocal(Pixel, Brdf, LocalV.z, Material.x) + ShadeIndirect(Scene, View, Pixel, Brdf, Point, LocalV.z, Material);
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Pixel = gl_GlobalInvocationID.xy;
	if (IsOutsideView(View, Pixel)) { return; }
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	vec3 Radiance = Depth > 0.0 ? ShadeSurface(Scene, View, ivec2(Pixel), Depth)
	                            : ShadeSky(Scene, CameraRay(View, vec2(Pixel) + 0.5));
	imageStore(Images[Push.Output], ivec2(Pixel), RoundToHalf(vec4(Radiance, 1.0)));
}
