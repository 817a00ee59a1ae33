// What the pipeline and the ray-query path share: which rays a pixel casts. The includer defines
//   bool TraceOcclusion(vec3 Origin, vec3 Direction, float Length)   true: nothing is in the way
// ONE_SAMPLE: SamplesPerPixel is known to be 1. Without the loop nothing but the pixel lives across the trace.
#ifndef LANTERN_AMBIENT_OCCLUSION_PASS_GLSL
#define LANTERN_AMBIENT_OCCLUSION_PASS_GLSL

#include "../Shared/AmbientOcclusionTypes.h"
#include "OcclusionFalloff.glsl"
#include "../Library/Bindings.glsl"
#include "../Library/Random.glsl"
#include "../Library/View.glsl"

layout(push_constant, scalar) uniform FPush { FAmbientOcclusionConstants Push; };

bool TraceOcclusion(vec3 Origin, vec3 Direction, float Length);

#ifdef ONE_SAMPLE
const uint SamplesPerPixel = 1u;
#else
#define SamplesPerPixel Push.SamplesPerPixel
#endif

void ShadePixel(uvec2 Pixel)
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	if (any(greaterThanEqual(Pixel, uvec2(View.Width, View.Height)))) { return; }
	float Depth = texelFetch(Textures[Push.Depth], ivec2(Pixel), 0).x;
	if (Depth <= 0.0) // sky
	{
		imageStore(Images[Push.Output], ivec2(Pixel), vec4(1.0));
		return;
	}
	vec4 Normals = texelFetch(Textures[Push.Normals], ivec2(Pixel), 0);
	vec3 N = OctDecode(Normals.xy), Ng = OctDecode(Normals.zw);
	vec3 Relative = RelativePositionFromDepth(View, Pixel, Depth);
	vec3 Origin = RasterRayOrigin(FSceneRef(Push.Pass.Scene).Data, View, Relative, Ng);
	float Visible = 0.0;
	// Another stream than the sun shadow's, and of its own for the length: two of Sobol's dimensions serve the direction.
	uint Seed = HashPcg(HashPcg(Pixel.x + HashPcg(Pixel.y + HashPcg(View.Seed))) + 1u), LengthSeed = HashPcg(Seed);
	for (uint Sample = 0; Sample < SamplesPerPixel; ++Sample)
	{
		uint Index = View.FrameIndex * SamplesPerPixel + Sample;
		vec3 Direction = SampleOcclusionDirection(N, SobolOwen2(Index, Seed));
		float Length = SampleOcclusionLength(SobolOwen2(Index, LengthSeed).x, Push.Radius);
		if (dot(Ng, Direction) > 0.0 && TraceOcclusion(Origin, Direction, Length)) { Visible += 1.0; }
	}
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(Visible / float(SamplesPerPixel)));
}

#endif
