// Reads the surface of a pixel from the host's G-buffer. A depth of 0 is the sky.
// BaseColor texels: rgb base colour, a metallic. Material texels: roughness, occlusion, sqrt(F0), specular.
// BACK_PIXELS: the host says which pixels show light from behind (FGBuffer::BackAlbedo).
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
	bool bBack;    // light from behind counts as well
};

// Normals that HostSurface derives from depth may be wrong. The lowest bit of the first coordinate in RGBA16_SNORM says which are sure.
const float OctSteps = 32767.0;
vec2 MarkSure(vec2 OctNormal, bool bSure)
{
	int X = clamp(int(round(OctNormal.x * OctSteps)), -32766, 32766) & ~1;
	return vec2(float(bSure ? X | 1 : X) / OctSteps, OctNormal.y);
}
// The lowest bit of the second coordinate says which pixels show light from behind. Without BACK_PIXELS it says nothing.
// The ends mark nothing, so that normals along axes stay exact.
bool IsBackCode(int Y) { return (Y & 1) != 0 && abs(Y) < int(OctSteps); }
vec2 MarkBack(vec2 OctNormal, bool bBack)
{
	int Y = int(round(OctNormal.y * OctSteps));
	if (IsBackCode(Y) != bBack) { Y -= abs(Y) == int(OctSteps) ? 2 * sign(Y) : Y > 0 ? 1 : -1; }
	return vec2(OctNormal.x, float(Y) / OctSteps); // a whole number of steps, which no store rounds elsewhere
}
bool IsBack(vec2 OctNormal) { return IsBackCode(int(round(OctNormal.y * OctSteps))); }
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
#ifdef BACK_PIXELS
	Point.bBack = IsBack(OctNormals.zw);
#else
	Point.bBack = false;
#endif
	return Point;
}

// Returns the normal that tells the sides of a surface.
vec3 SideNormal(FGBufferPoint Point) { return Point.bSure ? Point.Ng : Point.BentN; }

// Turns a surface that shows light from behind to face Direction.
void FaceDirection(inout FGBufferPoint Point, vec3 Direction)
{
	if (!Point.bBack || dot(SideNormal(Point), Direction) >= 0.0) { return; }
	Point.Ng = -Point.Ng;
	Point.N = -Point.N;
	Point.BentN = -Point.BentN;
}

// Whether the pixel sends light from Direction to the viewer, if its lobes do: of light from behind, both normals must have it there.
bool MayShow(FGBufferPoint Point, vec3 Direction, float LocalZ) { return !Point.bBack || dot(SideNormal(Point), Direction) * LocalZ > 0.0; }

// Returns the origin of rays that leave the surface of a pixel, on the side that Ng faces.
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
	float Turned = Point.bBack && dot(Point.Ng, Point.V) < 0.0 ? -1.0 : 1.0;
	vec3 Away = bDerived ? Turned * Point.V / max(min(Turned * dot(Point.Ng, Point.V), abs(dot(Point.N, Point.V))), 0.1) : Point.Ng;
	return OffsetRasterPoint(View.CameraPosition + Point.Relative, Away, Scene.ObjectReach, PixelHeight(View, Length), Along);
}

// From where rays leave the front of a pixel's surface to where they leave its back.
vec3 FindBackStep(FSceneConstants Scene, FViewConstants View, FGBufferPoint Point)
{
	FGBufferPoint Turned = Point;
	FaceDirection(Turned, -SideNormal(Point));
	return RasterRayOrigin(Scene, View, Turned) - RasterRayOrigin(Scene, View, Point);
}

// Whether a ray along Direction leaves the surface to the side of Ng. With normals that are not exact, rays that may do so count. Those
// that do not meet the surface itself, if it is among what they can meet. Spread: counts a ray along any unit vector that is no farther from
// Direction.
bool LeavesSurface(FViewConstants View, FGBufferPoint Point, vec3 Direction, float Spread)
{
	if (!Point.bSure || Point.bBack) { return true; }
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
	FBrdf Brdf = MakeWhiteLambert();
	Brdf.BaseColor = BaseColor.rgb;
	Brdf.Metallic = BaseColor.a;
	Brdf.Alpha = Material.x * Material.x;
	Brdf.F0 = Material.z * Material.z;
	Brdf.Specular = Material.w;
	return Brdf;
}

// Texture: sampled index of FGBuffer::BackAlbedo, or NO_TEXTURE. Returns FBrdf::BackAlbedo, and in a what the Lambert base loses to it.
vec4 LoadBack(uint Texture, ivec2 Pixel) { return Texture != NO_TEXTURE ? clamp(texelFetch(Textures[Texture], Pixel, 0), 0.0, 1.0) : vec4(0.0); }

// Adds the lobe of light from behind.
void AddBackLobe(uint Texture, ivec2 Pixel, inout FBrdf InOut)
{
#ifdef BACK_PIXELS
	vec4 Back = LoadBack(Texture, Pixel);
	InOut.Diffuse -= Back.a;
	InOut.BackAlbedo = Back.rgb;
#endif
}

#endif
