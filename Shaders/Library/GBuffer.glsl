// Reads the surface of a pixel from the host's G-buffer. A depth of 0 is the sky.
// BaseColor texels: rgb base colour, a metallic. Material texels: roughness, occlusion, sqrt(F0), specular.
#ifndef LANTERN_GBUFFER_GLSL
#define LANTERN_GBUFFER_GLSL

#include "Bindings.glsl"
#include "Brdf.glsl"
#include "View.glsl"

struct FGBufferPoint
{
	vec3 Relative; // position relative to the camera, metres
	vec3 V;        // towards the camera
	vec3 N;        // shading normal, as the material has it
	vec3 BentN;    // shading normal, bent so that it faces the viewer
	vec3 Ng;       // geometric normal, towards the viewer
};

float LoadDepth(uint Texture, ivec2 Pixel) { return texelFetch(Textures[Texture], Pixel, 0).x; }

// Normals: sampled index. Depth: of this pixel, > 0.
FGBufferPoint LoadGBufferPoint(FViewConstants View, uint Normals, ivec2 Pixel, float Depth)
{
	vec4 OctNormals = texelFetch(Textures[Normals], Pixel, 0);
	FGBufferPoint Point;
	Point.Relative = RelativePositionFromDepth(View, uvec2(Pixel), Depth);
	Point.V = -ViewDirection(View, Point.Relative);
	Point.N = OctDecode(OctNormals.xy);
	Point.BentN = BendNormal(Point.N, Point.V);
	Point.Ng = OctDecode(OctNormals.zw);
	return Point;
}

FBrdf MakeGBufferBrdf(vec4 BaseColor, vec4 Material)
{
	return FBrdf(BaseColor.rgb, BaseColor.a, Material.x * Material.x, Material.z * Material.z, Material.w, 1.0);
}

#endif
