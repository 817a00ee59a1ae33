// The specular lobe of a pixel that the paths of its diffuse lobe light as well.
#ifndef LANTERN_SECOND_LOBE_GLSL
#define LANTERN_SECOND_LOBE_GLSL

#include "../Library/GBuffer.glsl"

// Narrower lobes are widened: the filter follows surfaces and not what they mirror.
const float LeastRoughness = 0.2;

// Returns the directional albedo of the lobe. BaseColor, Material: sampled indices. OutShare: of paths that the lobe should draw, like the
// share that it has of the reflected light, so that none counts for more than 4/3 of the albedo.
vec3 FindSecondLobe(uint BaseColor, uint MaterialTexture, ivec2 Pixel, FGBufferPoint Point, out FBrdf OutLobe, out float OutShare)
{
	const float MostShare = 0.75;
	vec4 Material = texelFetch(Textures[MaterialTexture], Pixel, 0);
	Material.x = max(Material.x, LeastRoughness);
	FBrdf Brdf = MakeGBufferBrdf(texelFetch(Textures[BaseColor], Pixel, 0), Material);
	OutLobe = MakeSpecularLobe(Brdf);
	float NdotV = dot(Point.BentN, Point.V);
	vec3 Albedo = SpecularReflectance(OutLobe, NdotV, Material.x);
	float Specular = Luminance(Albedo), Diffuse = Luminance(DiffuseReflectance(Brdf, NdotV));
	OutShare = MostShare * Specular / max(Specular + Diffuse, 1.0e-4);
	return Albedo;
}

#endif
