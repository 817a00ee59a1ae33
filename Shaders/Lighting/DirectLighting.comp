// Direct light of the sun and the scene's lights, the sky's ambient, emission, and the sky itself.
// HAS_SUN, HAS_LIGHTS, HAS_SKY: what the scene has; the rest is not compiled.
#version 460
#include "../Shared/LightingTypes.h"
#include "../Library/Brdf.glsl"
#include "../Library/Lights.glsl"
#include "../Library/Sun.glsl"
#include "../Library/View.glsl"

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

vec3 ShadeSurface(FSceneConstants Scene, FViewConstants View, ivec2 Pixel, float Depth)
{
	vec4 Normals = texelFetch(Textures[Push.Normals], Pixel, 0);
	vec4 BaseColor = texelFetch(Textures[Push.BaseColor], Pixel, 0);
	vec4 Material = texelFetch(Textures[Push.Material], Pixel, 0);
	vec3 Radiance = texelFetch(Textures[Push.Emissive], Pixel, 0).rgb;
	vec3 Relative = RelativePositionFromDepth(View, uvec2(Pixel), Depth);
	vec3 N = OctDecode(Normals.xy), Ng = OctDecode(Normals.zw), V = -normalize(Relative);
	// A shading normal that faces away from the viewer is bent back to grazing.
	float NdotV = dot(N, V);
	if (NdotV < 1.0e-3) { N = normalize(N + V * (1.0e-3 - NdotV)); }

	FBrdf B;
	B.BaseColor = BaseColor.rgb;
	B.Metallic = BaseColor.a;
	B.Alpha = max(Material.x * Material.x, 2.0 * MinAlpha); // a point light has no image in a perfect mirror
	B.F0 = Material.z * Material.z;
	B.Specular = Material.w;
	mat3 Basis = MakeBasis(N);
	vec3 LocalV = V * Basis;

#ifdef HAS_SUN
	float Sun = Push.SunShadow != NO_TEXTURE ? texelFetch(Textures[Push.SunShadow], Pixel, 0).x : 1.0;
	if (Sun > 0.0)
	{
		Radiance += EvaluateBrdfCos(B, LocalV, -Scene.SunDirection * Basis) * Scene.SunColor * (Scene.SunIrradiance * Sun);
	}
#endif
#ifdef HAS_LIGHTS
	vec3 P = View.CameraPosition + Relative;
	FLightRef Lights = FLightRef(Scene.Lights);
	for (uint I = 0; I < Scene.LightCount; ++I)
	{
		vec3 Towards;
		float Distance;
		vec3 Irradiance = PunctualIrradiance(Lights.Data[I], P, Towards, Distance);
		if (MaxComponent(Irradiance) > 0.0 && dot(Ng, Towards) > 0.0)
		{
			Radiance += EvaluateBrdfCos(B, LocalV, Towards * Basis) * Irradiance;
		}
	}
#endif
#ifdef HAS_SKY
	// Unoccluded sky until ambient occlusion and global illumination take over.
	Radiance += DirectionalAlbedo(B, LocalV.z, Material.x) * Scene.SkyRadiance * Material.y;
#endif
	return Radiance;
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
