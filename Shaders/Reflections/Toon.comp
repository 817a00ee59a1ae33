// The G-buffer as reflections take it: objects with a style reflect with their metal alone, in the strength that artists painted.
#version 460
#include "../Shared/ReflectionTypes.h"
#include "../Shared/TileTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/Toon.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(push_constant, scalar) uniform FPush { FReflectionToonConstants Push; };

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	if (IsOutsideView(View, uvec2(Pixel))) { return; }
	vec4 BaseColor = texelFetch(Textures[Push.Pixels.BaseColor], Pixel, 0), Material = texelFetch(Textures[Push.Pixels.Material], Pixel, 0);
	float Depth = LoadDepth(Push.Pixels.Depth, Pixel);
	if (Depth > 0.0 && ToonOfPixel(texelFetch(Textures[Push.ToonPixels], Pixel, 0).xy) != 0u)
	{
		float Strength = BaseColor.a;
		vec3 Colors = mix(vec3(1.0), BaseColor.rgb / max(MaxComponent(BaseColor.rgb), 1.0e-4), Push.Tint);
		Material.x = round(255.0 * clamp(Material.x, Push.MinRoughness, Push.MaxRoughness)) / 255.0; // as it will be read
		Material.w = 0.0; // nothing of a dielectric
		BaseColor = vec4(0.0);
		if (Strength > Push.Threshold)
		{
			// A metal of the colour by which this view of it reflects Strength · Colors. No Fresnel term shows, but where the colour is
			// darker than what any metal reflects at a grazing angle.
			FGBufferPoint Point = LoadGBufferPoint(View, Push.Pixels.Normals, Pixel, Depth);
			vec2 Albedo = SpecularAlbedo(clamp(dot(Point.BentN, Point.V), 0.0, 1.0), Material.x);
			BaseColor = vec4(clamp((Strength * Colors - Albedo.y) / max(Albedo.x - Albedo.y, 1.0e-3), vec3(0.0), vec3(1.0)), 1.0);
		}
	}
	imageStore(Images[Push.OutBaseColor], Pixel, BaseColor);
	imageStore(Images[Push.OutMaterial], Pixel, Material);
}
