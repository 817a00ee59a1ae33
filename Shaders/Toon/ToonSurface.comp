// Finds what objects have a style, and the normals about which their pixels gather light.
#version 460
#include "../Shared/ToonTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/HostNumbers.glsl"
#include "../Library/ObjectPosition.glsl"
#include "../Library/Toon.glsl"

layout(local_size_x = TOON_GROUP_SIZE, local_size_y = TOON_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FToonSurfaceConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FToonNumberRef { uint Data[]; };

// Returns the pixel's style + 1; 0: it has none.
uint FindToon(FSceneConstants Scene, ivec2 Pixel)
{
	if (Push.Numbers != NO_TEXTURE)
	{
		if (Scene.ToonNumbers == FAddress(0)) { return 0u; }
		return FToonNumberRef(Scene.ToonNumbers).Data[LoadHostNumber(Push.Numbers, Push.NumbersOffset, Pixel)];
	}
	float Object = texelFetch(Textures[Push.Motion], Pixel, 0).w;
	return Object >= 1.0 ? FToonNumberRef(Scene.ObjectToons).Data[uint(Object) - 1u] : 0u;
}

// Turns the normals of a point to those of the sphere, and the shading normal then to the camera.
void StyleNormals(FSceneConstants Scene, FViewConstants View, FToonData Toon, inout FGBufferPoint Point)
{
	const float Least = 1.0e-4; // of the camera's direction, because opposite normals have no mean
	if (Toon.SphereWeight > 0.0)
	{
		FObjectData Object = FObjectRef(Scene.Objects).Data[Toon.Object];
		vec3 Center = CameraRelativePosition(
		    Object.ObjectToWorld, CellOffset(Scene, Object.Cell), Object.Flags, Toon.Center, View.CameraPosition);
		vec3 FromCenter = Point.Relative - Center;
		vec3 N = FromCenter / max(length(FromCenter), 1.0e-6);
		Point.BentN = normalize(mix(Point.BentN, N, Toon.SphereWeight) + Least * Point.V);
		Point.Ng = BendNormal(normalize(mix(Point.Ng, N, Toon.SphereWeight) + Least * Point.V), Point.V);
	}
	Point.BentN = BendNormal(normalize(mix(Point.BentN, Point.V, Toon.Bend) + Least * Point.V), Point.V);
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	if (IsOutsideView(View, uvec2(Pixel))) { return; }
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	vec4 Normals = texelFetch(Textures[Push.Normals], Pixel, 0);
	float Depth = LoadDepth(Push.Depth, Pixel), Sphere = 0.0;
	uint Toon = Depth > 0.0 ? FindToon(Scene, Pixel) : 0u;
	if (Toon != 0u)
	{
		FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
		FToonData Style = LoadToon(Scene, Toon);
		Sphere = Style.SphereWeight;
		StyleNormals(Scene, View, Style, Point);
		vec2 Geometric = MarkBack(OctEncode(Point.Ng), IsBack(Normals.zw));
		Normals = vec4(OctEncode(Point.BentN), View.bDerivedNormals != 0u ? MarkSure(Geometric, Point.bSure) : Geometric);
	}
	imageStore(Images[Push.OutNormals], Pixel, Normals);
	imageStore(Images[Push.OutPixels], Pixel, vec4(Sphere, float(Toon), 0.0, 0.0));
}
