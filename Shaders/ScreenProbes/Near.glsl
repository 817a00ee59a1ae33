// Short rays of pixels: they see what lies nearer to a pixel than the probes around it know. One pixel of four has one, in turn.
#ifndef LANTERN_SCREEN_PROBE_NEAR_GLSL
#define LANTERN_SCREEN_PROBE_NEAR_GLSL

#ifndef QUARTER
#define QUARTER
#endif
#include "ScreenProbes.glsl"
#include "../Library/GBuffer.glsl"
#include "../Library/Random.glsl"
#include "../Library/Rate.glsl"
#include "../Library/Sampling.glsl"

// Returns the direction of a pixel's short ray in this frame, cosine-weighted about its shading normal.
vec3 NearDirection(FViewConstants View, uvec2 Pixel, FGBufferPoint Point)
{
	uint Seed = HashPcg(Pixel.x + HashPcg(Pixel.y + HashPcg(View.Seed + 0x1b873593u)));
	return MakeBasis(Point.BentN) * SampleCosineHemisphere(SobolOwen2(View.FrameIndex, Seed));
}

#endif
