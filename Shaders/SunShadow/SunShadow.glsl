// Sun visibility of a pixel; the ray-tracing pipeline and the ray-query path share it. The includer defines
//   float TraceSunRay(vec3 Origin, vec3 Direction)   distance to a blocker; negative: the ray is unblocked
//
// WITH_PENUMBRA: also writes the width of the penumbra, for the denoiser.
// ONE_SAMPLE: see SamplesPerPixel.glsl.
#ifndef LANTERN_SUN_SHADOW_GLSL
#define LANTERN_SUN_SHADOW_GLSL

#include "../Shared/SunShadowTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/Random.glsl"
#include "../Library/Sun.glsl"

layout(push_constant, scalar) uniform FPush { FSunShadowConstants Push; };

float TraceSunRay(vec3 Origin, vec3 Direction);

#include "../Rays/SamplesPerPixel.glsl"

void StorePenumbra(uvec2 Pixel, float Penumbra)
{
#ifdef WITH_PENUMBRA
	if (Push.OutPenumbra != NO_TEXTURE) { imageStore(Images[Push.OutPenumbra], ivec2(Pixel), vec4(min(Penumbra, 65504.0))); }
#endif
}

void TracePixel(uvec2 Pixel)
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	if (IsOutsideView(View, Pixel)) { return; }
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	if (Depth <= 0.0) // sky
	{
		imageStore(Images[Push.Output], ivec2(Pixel), vec4(1.0));
		StorePenumbra(Pixel, 0.0);
		return;
	}
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, ivec2(Pixel), Depth);
	float VisibleSamples = 0.0, BlockerDistanceSum = 0.0, BlockedSamples = 0.0;
	FTileSequence Sequence = MakeTileSequence(Pixel, View.FrameIndex, HashPcg(View.Seed));
	for (uint Sample = 0; Sample < SamplesPerPixel; ++Sample)
	{
		vec3 Direction = -Scene.SunDirection;
		if (Push.bSoft != 0u) { Direction = SampleSunDirection(Scene, SobolOwen2(Sequence.Index * SamplesPerPixel + Sample, Sequence.Seed)); }
		if (!LeavesSurface(View, Point, Direction)) { continue; }
		float BlockerDistance = TraceSunRay(RasterRayOrigin(Scene, View, Point), Direction);
		VisibleSamples += BlockerDistance < 0.0 ? 1.0 : 0.0;
		BlockedSamples += BlockerDistance < 0.0 ? 0.0 : 1.0;
		BlockerDistanceSum += max(BlockerDistance, 0.0);
	}
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(VisibleSamples / float(SamplesPerPixel)));
	// Width of the penumbra in pixels: the diameter of the sun's disk, projected past the mean blocker onto the surface. 0: no
	// blocker. A surface that turns away from the sun gives no blocker distance; its width is set to 1e-3.
	float Diameter = 2.0 * sqrt(2.0 * Scene.SunOneMinusCos);
	float Penumbra = VisibleSamples < float(SamplesPerPixel) ? 1.0e-3 : 0.0;
	if (BlockedSamples > 0.0)
	{
		float Foreshortening = abs(dot(Point.Ng, Point.V));
		Penumbra = Diameter * BlockerDistanceSum / BlockedSamples * Foreshortening / PixelHeight(View, DistanceFromDepth(View, Depth));
	}
	StorePenumbra(Pixel, Penumbra);
}

#endif
