// The reference: an unbiased path tracer, for the whole frame or for one signal.
// SIGNAL: one signal, which the includer defines. Not defined: the whole frame.
// FROM_GBUFFER: starts at the surfaces of the G-buffer instead of those that camera rays hit. Their textures are filtered.
#ifndef LANTERN_PATH_TRACE_GLSL
#define LANTERN_PATH_TRACE_GLSL

#ifdef HAS_TRANSMISSION
#define TINTED_SHADOWS
#endif
#include "../Shared/ReferenceTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/View.glsl"
#include "../Rays/PathTracing.glsl"

layout(push_constant, scalar) uniform FPush { FReferenceConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer FSampleSumRef { vec4 Data[]; };

#define CameraPdf uintBitsToFloat(0x7f800000u) // infinite: light sampling cannot produce a camera ray

// Traces a camera ray. It passes through the backs of single-sided surfaces, since the raster culls them. Origin: advanced to
// where the last segment starts.
FMaterialHit TraceCamera(FSceneConstants Scene, inout vec3 Origin, vec3 Direction)
{
	FMaterialHit Hit;
	for (uint Layer = 0; Layer < 64u; ++Layer)
	{
		Hit = TraceMaterial(Scene, Origin, Direction);
		bool bPasses = (Hit.Flags & HIT_CULLED_SIDE) != 0u;
#if defined(SIGNAL) && defined(HAS_TRANSMISSION)
		bPasses = bPasses || (IsBlended(Hit) && Hit.Transmission > 0.5); // a signal is of one surface
#endif
		if (Hit.Distance < 0.0 || !bPasses) { break; }
		Origin = OffsetRayOrigin(Origin + Direction * Hit.Distance, -Hit.GeometricNormal, Scene.ObjectReach, Hit.Distance);
	}
	return Hit;
}

#ifdef SIGNAL
// The shader of a signal's reference, Shaders/<Pass>/<Pass>Reference.rgen, defines these two after it includes this file.
float SkyValue(); // the signal where the pixel shows the sky
// Traces one sample of the signal at a surface. P: the ray origin, already offset from the surface; V: towards the viewer.
vec3 TraceSignal(FSceneConstants Scene, FMaterialHit Hit, vec3 P, vec3 V, inout FRandom Random);
#endif

#ifdef FROM_GBUFFER
#ifdef HAS_TRANSMISSION
#include "../Transmission/Layers.glsl"
#endif

FMaterialHit LoadRasterHit(ivec2 Pixel, FGBufferPoint Point)
{
	vec4 BaseColor = texelFetch(Textures[Push.BaseColor], Pixel, 0);
	vec4 Material = texelFetch(Textures[Push.Material], Pixel, 0);
	FMaterialHit Hit;
	Hit.Distance = length(Point.Relative);
	Hit.Normal = Point.N;
	Hit.GeometricNormal = Point.Ng;
	Hit.BaseColor = BaseColor.rgb;
	Hit.Metallic = BaseColor.a;
	Hit.Roughness = Material.x;
	Hit.F0 = Material.z * Material.z;
	Hit.Specular = Material.w;
	Hit.Emissive = Push.Emissive != NO_TEXTURE ? texelFetch(Textures[Push.Emissive], Pixel, 0).rgb : vec3(0.0);
	Hit.EmissiveWeight = 0.0; // it counts whole, as nothing else samples it for the camera
	Hit.Flags = 0u;
	Hit.Channels = AllChannels;
#ifdef HAS_DIFFUSE_TRANSMISSION
	vec4 Back = LoadBack(Push.BackAlbedo, Pixel);
	Hit.BackAlbedo = Back.rgb;
	Hit.DiffuseTransmission = Back.a;
#endif
#ifdef HAS_TRANSMISSION
	Hit.Transmission = 0.0;
	Hit.Material = 0u;
#endif
#ifdef HAS_LIGHT_CHANNELS
	Hit.Channels = LoadPixelChannels(Push.Channels, uvec2(Pixel));
#endif
	return Hit;
}

vec3 TraceRasterSurface(FSceneConstants Scene, FViewConstants View, ivec2 Pixel, inout FRandom Random)
{
	float Depth = LoadDepth(Push.Depth, Pixel);
#ifdef SIGNAL
	if (Depth <= 0.0) { return vec3(SkyValue()); }
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
	ChooseGatherMask(Push.ToonPixels, Pixel);
	vec3 P = RasterRayOrigin(Scene, View, Point);
#ifdef HAS_DIFFUSE_TRANSMISSION
	BackStep = FindBackStep(Scene, View, Point);
#endif
	return TraceSignal(Scene, LoadRasterHit(Pixel, Point), P, Point.V, Random);
#else
#ifdef HAS_TRANSMISSION
	vec3 Start = View.CameraPosition + CameraRayStart(View, vec2(Pixel) + 0.5), Direction = CameraRay(View, vec2(Pixel) + 0.5);
	float Left = Infinity;
	if (Depth > 0.0) { Left = DistanceOfLayers(DistanceFromDepth(View, Depth) / dot(Direction, View.CameraForward)); }
	FMaterialHit Layer;
	if (FindLayer(Scene, Start, Direction, Left, Layer))
	{
		return FollowPath(Scene, Layer, Start, Direction, CameraPdf, 1.0, 0u, Push.MaxBounces, true, Random);
	}
#endif
	if (Depth <= 0.0) { return ShadeMiss(Scene, CameraRay(View, vec2(Pixel) + 0.5), CameraPdf, 1.0, AllChannels); }
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
	FMaterialHit Hit = LoadRasterHit(Pixel, Point);
	vec3 Origin = RasterRayOrigin(Scene, View, Point) + Point.V * Hit.Distance;
#ifdef HAS_DIFFUSE_TRANSMISSION
	FirstBackStep = FindBackStep(Scene, View, Point);
#endif
	return FollowPath(Scene, Hit, Origin, -Point.V, CameraPdf, 1.0, 0u, Push.MaxBounces, true, Random);
#endif
}
#endif

vec3 TraceSample(FSceneConstants Scene, vec3 Origin, vec3 Direction, inout FRandom Random)
{
	FMaterialHit Hit = TraceCamera(Scene, Origin, Direction);
#ifdef SIGNAL
	if (Hit.Distance < 0.0) { return vec3(SkyValue()); }
	vec3 P = OffsetRayOrigin(Origin + Direction * Hit.Distance, Hit.GeometricNormal, Scene.ObjectReach, Hit.Distance);
#ifdef HAS_DIFFUSE_TRANSMISSION
	SetBackStep(Scene, P, Hit.GeometricNormal, Hit.Distance);
#endif
	return TraceSignal(Scene, Hit, P, -Direction, Random);
#else
	return FollowPath(Scene, Hit, Origin, Direction, CameraPdf, 1.0, 0u, Push.MaxBounces, true, Random);
#endif
}

void TracePixel()
{
	uvec2 Pixel = gl_LaunchIDEXT.xy + uvec2(0u, Push.FirstRow);
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FSampleSumRef SumBuffer = FSampleSumRef(Push.Sum);
	uint Index = Pixel.y * View.Width + Pixel.x;
	// Samples are added one after the other, so that the sum does not depend on how dispatches divide them.
	vec4 Sum = SumBuffer.Data[Index];
	for (uint Sample = 0; Sample < Push.SampleCount; ++Sample)
	{
		FRandom Random = MakeRandom(Pixel, Push.FirstSample + Sample, View.Seed);
#ifdef FROM_GBUFFER
		Sum += vec4(TraceRasterSurface(Scene, View, ivec2(Pixel), Random), 1.0);
#else
		vec2 SubPixel = NextRandom4(Random).xy;
		if (Push.bPixelCenters != 0u) { SubPixel = vec2(0.5); }
		vec2 Point = vec2(Pixel) + SubPixel;
		vec3 Origin = View.CameraPosition + CameraRayStart(View, Point);
		Sum += vec4(TraceSample(Scene, Origin, CameraRay(View, Point), Random), 1.0);
#endif
	}
	SumBuffer.Data[Index] = Sum;
}

#endif
