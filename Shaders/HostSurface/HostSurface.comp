// Reads the G-buffer of a host, whatever its conventions are, and writes it as passes read it: FGBuffer says how.
#version 460
#include "../Shared/HostSurfaceTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/Motion.glsl"

layout(local_size_x = HOST_SURFACE_GROUP_SIZE, local_size_y = HOST_SURFACE_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FHostSurfaceConstants Push; };

bool Has(uint Flag) { return (Push.Flags & Flag) != 0u; }

vec4 Fetch(uint Texture, ivec2 Pixel) { return texelFetch(Textures[Texture], Pixel + ivec2(Push.Offset & 0xffffu, Push.Offset >> 16u), 0); }

// Distance along the view, metres; 0: sky. Neither sum loses digits to a difference: near depth 1 it is 1 − depth that counts.
float LoadDistance(ivec2 Pixel)
{
	float Depth = Fetch(Push.Depth, Pixel).x;
	if (Has(HOST_DEPTH_LINEAR)) { return Depth > 0.0 && Depth < Push.DepthAtOne ? Depth * Push.DepthAtZero : 0.0; }
	// Not-a-number is sky, too.
	if (!(Has(HOST_DEPTH_REVERSED) ? Depth > 0.0 : Depth < 1.0)) { return 0.0; }
	float Value = (1.0 - Depth) * Push.DepthAtZero + Depth * Push.DepthAtOne;
	return Has(HOST_DEPTH_ORTHOGRAPHIC) ? Value : 1.0 / Value;
}

vec3 DecodeNormal(vec4 Texel)
{
	if (Has(HOST_NORMALS_UNSIGNED)) { Texel = Texel * 2.0 - 1.0; }
	vec3 N = Has(HOST_NORMALS_OCTAHEDRAL) ? OctDecode(Texel.xy) : Texel.xyz;
	vec3 NormalZ = cross(Push.NormalX, Push.NormalY);
	if (Has(HOST_NORMALS_MIRRORED)) { NormalZ = -NormalZ; }
	return NormalizeOr(Push.NormalX * N.x + Push.NormalY * N.y + NormalZ * N.z, vec3(0.0));
}

float DistanceError(FViewConstants View, float Distance)
{
	return View.DepthError.x + Distance * (View.DepthError.y + Distance * View.DepthError.z);
}

// A step along one axis of the picture, on the surface of the pixel: to that side whose depth goes on more evenly. The depth of a
// plane is even as 1 / distance, or as distance in orthographic views. A neighbour in the plane of the shading normal N is on the
// surface, too, whatever lies behind it, but an even side is better. Length 0: neither side shows the surface.
vec3 FindStep(FViewConstants View, ivec2 Pixel, ivec2 Axis, float Distance, vec3 Position, vec3 N)
{
	vec3 Step = vec3(0.0);
	// A bend by more than the pixel's own size, or than rounding makes, is an edge.
	float EdgeBend = max(4.0 * DistanceError(View, Distance), 0.5 * PixelHeight(View, Distance)), Limit = EdgeBend;
	for (int Sign = -1; Sign <= 1; Sign += 2)
	{
		ivec2 P1 = Pixel + Axis * Sign, P2 = Pixel + Axis * (2 * Sign);
		ivec2 Last = ivec2(View.Width, View.Height) - 1;
		if (any(lessThan(P1, ivec2(0))) || any(greaterThan(P1, Last))) { continue; }
		float D1 = LoadDistance(P1);
		if (D1 <= 0.0) { continue; }
		float D2 = any(lessThan(P2, ivec2(0))) || any(greaterThan(P2, Last)) ? 0.0 : LoadDistance(P2);
		bool bOrthographic = View.bOrthographic != 0u;
		float Expected = bOrthographic ? 2.0 * D1 - D2 : 1.0 / max(2.0 / D1 - 1.0 / D2, 1.0e-12);
		float Bend = D2 > 0.0 ? abs(Expected - Distance) : EdgeBend;
		vec3 Found = (RelativePosition(View, vec2(P1) + 0.5, D1) - Position) * float(Sign);
		if (Bend >= EdgeBend && abs(dot(Found, N)) < 0.03 * length(Found)) { Bend = EdgeBend * 0.999; }
		if (Bend >= Limit) { continue; }
		Limit = Bend;
		Step = Found;
	}
	return Step;
}

vec3 TowardsCamera(vec3 N, vec3 ViewDirection) { return dot(N, ViewDirection) > 0.0 ? -N : N; }

// A shading normal that may face away: at silhouettes it leans over the edge, and further round it is that of a surface's back.
vec3 ShadingTowardsCamera(vec3 N, vec3 ViewDirection)
{
	float Away = dot(N, ViewDirection);
	return Away > 0.0 && Away < 0.5 ? N - 2.0 * Away * ViewDirection : TowardsCamera(N, ViewDirection);
}

// The normal of the surface around a pixel, towards the camera. N: the shading normal, for where depth does not tell.
vec3 DeriveNormal(FViewConstants View, ivec2 Pixel, float Distance, vec3 Position, vec3 N, out bool bSure)
{
	bSure = false;
	vec3 Fallback = ShadingTowardsCamera(N, ViewDirection(View, Position));
	// Steps in depth that are large against the pixel turn the normal by as much.
	if (DistanceError(View, Distance) > 0.1 * PixelHeight(View, Distance)) { return Fallback; }
	vec3 X = FindStep(View, Pixel, ivec2(1, 0), Distance, Position, N);
	vec3 Y = FindStep(View, Pixel, ivec2(0, 1), Distance, Position, N);
	vec3 Derived = TowardsCamera(NormalizeOr(cross(X, Y), vec3(0.0)), ViewDirection(View, Position));
	// Shading normals lean from the geometric ones, but hardly by this much: the neighbours were of another surface. Only if both agree
	// is the normal sure.
	float Agreement = dot(Derived, Fallback);
	bSure = Agreement > 0.98;
	return Agreement > 0.25 ? Derived : Fallback;
}

void StoreNormals(FViewConstants View, ivec2 Pixel, float Distance, vec3 Position)
{
	vec4 Texel = Fetch(Push.Normals, Pixel);
	vec3 Forward = ViewDirection(View, Position);
	vec3 N = DecodeNormal(Texel);
	if (N == vec3(0.0)) { N = -Forward; }
	vec3 Ng;
	bool bSure = true;
	if (Has(HOST_GEOMETRIC_IN_ZW)) { Ng = DecodeNormal(Texel.zwzw); }
	else if (Push.GeometricNormals != NO_TEXTURE) { Ng = DecodeNormal(Fetch(Push.GeometricNormals, Pixel)); }
	else { Ng = DeriveNormal(View, Pixel, Distance, Position, N, bSure); }
	if (Ng == vec3(0.0)) { Ng = -Forward; }
	vec2 Geometric = OctEncode(TowardsCamera(Ng, Forward));
	if (Push.BackAlbedo != NO_TEXTURE) { Geometric = MarkBack(Geometric, Fetch(Push.BackAlbedo, Pixel).rgb != vec3(0.0)); }
	imageStore(Images[Push.OutNormals], Pixel, vec4(OctEncode(N), View.bDerivedNormals != 0u ? MarkSure(Geometric, bSure) : Geometric));
}

void StoreMotion(FViewConstants View, ivec2 Pixel, vec3 Position)
{
	vec4 Texel = Fetch(Push.Motion, Pixel);
	vec3 OfCamera = ComputeMotion(View, Position, Position + View.CameraMotion);
	if (Has(HOST_MOTION_PARTIAL) && Texel.xy == vec2(0.0))
	{
		imageStore(Images[Push.OutMotion], Pixel, vec4(OfCamera, 0.0));
		return;
	}
	vec2 Motion = (Texel.xy * Push.MotionScale + Push.MotionOffset) * (Has(HOST_MOTION_IN_UV) ? vec2(View.Width, View.Height) : vec2(1.0));
	imageStore(Images[Push.OutMotion], Pixel, vec4(Motion, Has(HOST_MOTION_DISTANCE) ? Texel.zw : vec2(OfCamera.z, 0.0)));
}

void StoreMaterial(ivec2 Pixel)
{
	vec4 BaseColor = Fetch(Push.BaseColor, Pixel), Material = Fetch(Push.Material, Pixel);
	if (Has(HOST_MATERIAL_UNREAL))
	{
		// Metallic, specular, roughness; the base colour's alpha is occlusion. Unreal's specular is F0 / 0.08.
		BaseColor = vec4(BaseColor.rgb, Material.x);
		Material = vec4(Material.z, Fetch(Push.BaseColor, Pixel).a, sqrt(0.08 * Material.y), 1.0);
	}
	if (Push.OutBaseColor != NO_TEXTURE) { imageStore(Images[Push.OutBaseColor], Pixel, BaseColor); }
	if (Push.OutMaterial != NO_TEXTURE) { imageStore(Images[Push.OutMaterial], Pixel, Material); }
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	if (IsOutsideView(View, gl_GlobalInvocationID.xy)) { return; }
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	float Distance = LoadDistance(Pixel);
	if (Push.OutDepth != NO_TEXTURE) { imageStore(Images[Push.OutDepth], Pixel, vec4(Distance > 0.0 ? View.Near / Distance : 0.0)); }
	vec3 Position = RelativePosition(View, vec2(Pixel) + 0.5, Distance);
	if (Push.OutNormals != NO_TEXTURE)
	{
		if (Distance > 0.0) { StoreNormals(View, Pixel, Distance, Position); }
		else { imageStore(Images[Push.OutNormals], Pixel, vec4(0.0)); }
	}
	if (Push.OutMotion != NO_TEXTURE)
	{
		if (Distance > 0.0) { StoreMotion(View, Pixel, Position); }
		else { imageStore(Images[Push.OutMotion], Pixel, vec4(0.0)); }
	}
	if (Push.OutBackAlbedo != NO_TEXTURE) { imageStore(Images[Push.OutBackAlbedo], Pixel, Fetch(Push.BackAlbedo, Pixel)); }
	if (Push.OutBaseColor != NO_TEXTURE || Push.OutMaterial != NO_TEXTURE) { StoreMaterial(Pixel); }
}
