// The reference: an unbiased path tracer, of the whole frame or of one signal.
// SIGNAL: of one signal, which the includer defines.
// FROM_GBUFFER: a signal at the surfaces that the raster saw, not at those that camera rays hit.
#ifndef LANTERN_PATH_TRACE_GLSL
#define LANTERN_PATH_TRACE_GLSL

#include "../Shared/ReferenceTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/View.glsl"
#include "../Rays/PathTracing.glsl"

layout(push_constant, scalar) uniform FPush { FReferenceConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer FSumRef { vec4 Data[]; };

// Camera rays pass through the backs of single-sided surfaces, as the raster culls them.
FMaterialHit TraceCamera(FSceneConstants Scene, inout vec3 Origin, vec3 Direction)
{
	FMaterialHit Hit;
	for (uint Layer = 0; Layer < 64u; ++Layer)
	{
		Hit = TraceMaterial(Scene, Origin, Direction);
		if (Hit.Distance < 0.0 || (Hit.Flags & HIT_CULLED_SIDE) == 0u) { break; }
		Origin = OffsetRayOrigin(Origin + Direction * Hit.Distance, -Hit.GeometricNormal, Scene.ObjectReach, Hit.Distance);
	}
	return Hit;
}

#ifdef SIGNAL
// A signal's own shader, Shaders/<Pass>/<Pass>Reference.rgen, defines these two behind this file.
float SkySignal(); // of pixels without a surface
// One sample of the signal at Hit. P: where rays from there start; V: towards the camera.
vec3 TraceSignal(FSceneConstants Scene, FMaterialHit Hit, vec3 P, vec3 V, inout FRandom Random);
#endif

#ifdef FROM_GBUFFER
vec3 TraceRasterSurface(FSceneConstants Scene, FViewConstants View, ivec2 Pixel, inout FRandom Random)
{
	float Depth = texelFetch(Textures[Push.Depth], Pixel, 0).x;
	if (Depth <= 0.0) { return vec3(SkySignal()); }
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
	vec4 BaseColor = texelFetch(Textures[Push.BaseColor], Pixel, 0);
	vec4 Material = texelFetch(Textures[Push.Material], Pixel, 0);
	FMaterialHit Hit;
	Hit.Distance = length(Point.Relative);
	Hit.Normal = OctDecode(texelFetch(Textures[Push.Normals], Pixel, 0).xy);
	Hit.GeometricNormal = Point.Ng;
	Hit.BaseColor = BaseColor.rgb;
	Hit.Metallic = BaseColor.a;
	Hit.Roughness = Material.x;
	Hit.F0 = Material.z * Material.z;
	Hit.Specular = Material.w;
	Hit.Emissive = vec3(0.0);
	Hit.EmissiveWeight = 0.0;
	Hit.Flags = 0u;
	return TraceSignal(Scene, Hit, RasterRayOrigin(Scene, View, Point.Relative, Point.Ng), Point.V, Random);
}
#endif

vec3 TraceSample(FSceneConstants Scene, vec3 Origin, vec3 Direction, inout FRandom Random)
{
	FMaterialHit Hit = TraceCamera(Scene, Origin, Direction);
#ifdef SIGNAL
	if (Hit.Distance < 0.0) { return vec3(SkySignal()); }
	vec3 P = OffsetRayOrigin(Origin + Direction * Hit.Distance, Hit.GeometricNormal, Scene.ObjectReach, Hit.Distance);
	return TraceSignal(Scene, Hit, P, -Direction, Random);
#else
	float Density = uintBitsToFloat(0x7f800000u); // infinite: light sampling could not have made the direction
	return FollowPath(Scene, Hit, Origin, Direction, Density, 1.0, 0u, Push.MaxBounces, Random);
#endif
}

void TracePixel()
{
	uvec2 Pixel = gl_LaunchIDEXT.xy + uvec2(0u, Push.FirstRow);
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FSumRef Target = FSumRef(Push.Sum);
	uint Index = Pixel.y * View.Width + Pixel.x;
	// One sample after the other, so that the sum does not depend on how dispatches divide them.
	vec4 Sum = Target.Data[Index];
	for (uint S = 0; S < Push.SampleCount; ++S)
	{
		FRandom Random = MakeRandom(Pixel, Push.FirstSample + S, View.Seed);
#ifdef FROM_GBUFFER
		Sum += vec4(TraceRasterSurface(Scene, View, ivec2(Pixel), Random), 1.0);
#else
		vec2 Within = NextRandom4(Random).xy;
		if (Push.bPixelCenters != 0u) { Within = vec2(0.5); }
		vec3 Direction = normalize(CameraRay(View, vec2(Pixel) + Within));
		Sum += vec4(TraceSample(Scene, View.CameraPosition, Direction, Random), 1.0);
#endif
	}
	Target.Data[Index] = Sum;
}

#endif
