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
	bool bSure;    // Ng is right; else it may be any
};

// Normals that HostSurface derives from depth may be wrong. The lowest bit of the first coordinate in RGBA16_SNORM says which are sure.
const float OctSteps = 32767.0;
vec2 MarkSure(vec2 OctNormal, bool bSure)
{
	int X = clamp(int(round(OctNormal.x * OctSteps)), -32766, 32766) & ~1;
	return vec2(float(bSure ? X | 1 : X) / OctSteps, OctNormal.y);
}
bool IsSure(vec2 OctNormal) { return (int(round(OctNormal.x * OctSteps)) & 1) != 0; }

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
	Point.bSure = View.bDerivedNormals == 0u || IsSure(OctNormals.zw);
	return Point;
}

// Returns the origin of rays that leave the surface of a pixel.
vec3 RasterRayOrigin(FSceneConstants Scene, FViewConstants View, FGBufferPoint Point)
{
	float Distance = dot(View.CameraForward, Point.Relative), Length = length(Point.Relative);
	bool bDerived = View.bDerivedNormals != 0u;
	// The depth's error moves the point along the camera ray; the part along the normal is what can bury it.
	float DepthError = View.DepthError.x + Distance * (View.DepthError.y + Distance * View.DepthError.z);
	float Facing = bDerived ? 1.0 : min(abs(dot(Point.Ng, Point.V)) + View.NormalError, 1.0);
	float Along = DepthError * Facing * (View.bOrthographic != 0u ? 1.0 : Length / Distance);
	// A derived normal may be any, and could lead to the surface's other side. The way to the camera is free. It is the longer, the more
	// the surface turns away, and the shading normal knows that, too.
	vec3 Away = bDerived ? Point.V / max(min(dot(Point.Ng, Point.V), abs(dot(Point.N, Point.V))), 0.1) : Point.Ng;
	return OffsetRasterPoint(View.CameraPosition + Point.Relative, Away, Scene.ObjectReach, PixelHeight(View, Length), Along);
}

// Whether a ray along Direction leaves the surface to the side of Ng. With normals that are not exact, rays that may do so count. Those
// that do not meet the surface itself, if it is among what they can meet. Spread: counts a ray along any unit vector that is no farther from
// Direction.
bool LeavesSurface(FViewConstants View, FGBufferPoint Point, vec3 Direction, float Spread)
{
	if (!Point.bSure) { return true; }
	float Facing = dot(Point.Ng, Direction), Error = View.NormalError + Spread;
	if (View.bDerivedNormals != 0u)
	{
		// Where depth and shading say different things, the surface may face anywhere between them, and as far beyond.
		Facing = max(Facing, dot(faceforward(Point.N, -Point.Ng, Point.N), Direction));
		Error += length(cross(Point.N, Point.Ng));
	}
	return Facing > -Error;
}
bool LeavesSurface(FViewConstants View, FGBufferPoint Point, vec3 Direction) { return LeavesSurface(View, Point, Direction, 0.0); }

FBrdf MakeGBufferBrdf(vec4 BaseColor, vec4 Material)
{
	return FBrdf(BaseColor.rgb, BaseColor.a, Material.x * Material.x, Material.z * Material.z, Material.w, 1.0);
}

#endif
