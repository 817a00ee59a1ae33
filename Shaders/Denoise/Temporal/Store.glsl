// Step "store" of the temporal filter: writes the mean with its variance for the wavelet, and the history for the next frame.
//   Takes: FAccumulated, and the extent in pixels.
//   Gives: the images Push.Output, Push.OutHistory and Push.OutMoments.
//   Why: the variance of few frames is known less well, and a start that is blurred is better than one that is wrong.
#ifndef LANTERN_TEMPORAL_STORE_GLSL
#define LANTERN_TEMPORAL_STORE_GLSL

#include "Types.glsl"

float GetOutputVariance(FAccumulated A)
{
	float Frames = max(A.Frames, 1.0);
	return min(A.NoiseSigma * A.NoiseSigma / Frames * (1.0 + 1.0 / Frames), MaxHalf);
}

void Store(ivec2 Pixel, FAccumulated A, float Extent)
{
	vec4 Output = WithVariance(A.Mean, GetOutputVariance(A));
	imageStore(Images[Push.Output], Pixel, RoundToHalf(Output + vec4(0.0, 0.0, CHANNELS == 1 ? Extent : 0.0, 0.0)));
	float NoiseSigma = min(A.NoiseSigma, MaxHalf), NeighborhoodMean = min(A.NeighborhoodMean, MaxHalf);
#if CHANNELS == 1
	imageStore(Images[Push.OutHistory], Pixel, RoundToHalf(vec4(A.Mean, NoiseSigma, A.Frames, NeighborhoodMean)));
#else
	imageStore(Images[Push.OutHistory], Pixel, RoundToHalf(vec4(A.Mean, A.Frames)));
	imageStore(Images[Push.OutMoments], Pixel, RoundToHalf(vec4(NoiseSigma, NeighborhoodMean, 0.0, 0.0)));
#endif
}

#endif
