// Gives filtered reflections the colour and the Fresnel term of the surfaces that reflect them, and fades them out with roughness.
#version 460
#include "../Shared/ReflectionTypes.h"
#include "../Shared/TileTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/Rgbe.glsl"
#include "../Library/SkyMap.glsl"
#include "../Library/UintTextures.glsl"
#include "Fade.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(push_constant, scalar) uniform FPush { FReflectionCombineConstants Push; };

const float MaxHalf = 65504.0;

vec4 Combine(FViewConstants View, ivec2 Pixel, float Depth)
{
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Pixels.Normals, Pixel, Depth);
	vec4 Material = texelFetch(Textures[Push.Pixels.Material], Pixel, 0);
	FBrdf Lobe = MakeSpecularLobe(MakeGBufferBrdf(texelFetch(Textures[Push.Pixels.BaseColor], Pixel, 0), Material));
	vec3 Albedo = LobeAlbedo(Lobe, dot(Point.BentN, Point.V), Material.x);
	float Share = ReflectedShare(Push.Fade, Material.x);
	vec3 Radiance = vec3(0.0);
	if (Share > 0.0)
	{
		Radiance = texelFetch(Textures[Push.Radiance], Pixel, 0).rgb;
		if (IsMirror(Lobe))
		{
			uvec2 Mirrored = texelFetch(UintTextures[Push.Mirrored], Pixel, 0).xy;
			Radiance = Radiance * UnpackRgbe(Mirrored.x) + UnpackRgbe(Mirrored.y);
		}
	}
#ifdef HAS_SKY
	else { Radiance = SampleSkyRadiance(FSceneRef(Push.Pass.Scene).Data, reflect(-Point.V, Point.BentN)); }
#endif
	return vec4(clamp(Albedo * Radiance, vec3(0.0), vec3(MaxHalf)), Share);
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	if (IsOutsideView(View, uvec2(Pixel))) { return; }
	float Depth = LoadDepth(Push.Pixels.Depth, Pixel);
	imageStore(Images[Push.Output], Pixel, RoundToHalf(Depth > 0.0 ? Combine(View, Pixel, Depth) : vec4(0.0, 0.0, 0.0, 1.0)));
}
