// Ambient occlusion of a pixel; the ray-tracing pipeline and the ray-query path share it. The includer defines
//   bool IsUnoccluded(vec3 Origin, vec3 Direction, float Length)   true: the ray hits nothing
// ONE_SAMPLE: see SamplesPerPixel.glsl.
#ifndef LANTERN_AMBIENT_OCCLUSION_PASS_GLSL
#define LANTERN_AMBIENT_OCCLUSION_PASS_GLSL

#include "../Shared/AmbientOcclusionTypes.h"
#include "OcclusionFalloff.glsl"
#include "../Library/GBuffer.glsl"
#include "../Library/Random.glsl"

layout(push_constant, scalar) uniform FPush { FAmbientOcclusionConstants Push; };

bool IsUnoccluded(vec3 Origin, vec3 Direction, float Length);

#include "../Rays/SamplesPerPixel.glsl"

void TracePixel(uvec2 Pixel)
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	if (IsOutsideView(View, Pixel)) { return; }
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	if (Depth <= 0.0) // sky
	{
		imageStore(Images[Push.Output], ivec2(Pixel), vec4(1.0));
		return;
	}
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, ivec2(Pixel), Depth);
	vec3 Origin = RasterRayOrigin(FSceneRef(Push.Pass.Scene).Data, View, Point);
	float VisibleSamples = 0.0;
	// The seed differs from the sun shadow's, and the length has a seed of its own: the direction takes both Sobol dimensions.
	uint Seed = HashPcg(HashPcg(Pixel.x + HashPcg(Pixel.y + HashPcg(View.Seed))) + 1u), LengthSeed = HashPcg(Seed);
	for (uint Sample = 0; Sample < SamplesPerPixel; ++Sample)
	{
		uint Index = View.FrameIndex * SamplesPerPixel + Sample;
		vec3 Direction = SampleOcclusionDirection(Point.N, SobolOwen2(Index, Seed));
		float Length = SampleOcclusionLength(SobolOwen2(Index, LengthSeed).x, Push.Radius);
		if (LeavesSurface(View, Point, Direction) && IsUnoccluded(Origin, Direction, Length)) { VisibleSamples += 1.0; }
	}
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(VisibleSamples / float(SamplesPerPixel)));
}

#endif
