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
	vec3 N, Ng;    // shading normal, bent towards the viewer; geometric normal
};

FGBufferPoint LoadGBufferPoint(FViewConstants View, uint Normals, ivec2 Pixel, float Depth)
{
	vec4 Encoded = texelFetch(Textures[Normals], Pixel, 0);
	FGBufferPoint Point;
	Point.Relative = RelativePositionFromDepth(View, uvec2(Pixel), Depth);
	Point.V = -normalize(Point.Relative);
	Point.N = BendNormal(OctDecode(Encoded.xy), Point.V);
	Point.Ng = OctDecode(Encoded.zw);
	return Point;
}

FBrdf MakeGBufferBrdf(vec4 BaseColor, vec4 Material)
{
	return FBrdf(BaseColor.rgb, BaseColor.a, Material.x * Material.x, Material.z * Material.z, Material.w, 1.0);
}

#endif
