// Step "resample" of the temporal filter, for visibility: reads the history between texels sharply, and estimates the error of doing so.
//   Takes: a history that has been interpolated bilinearly, and the range of its four nearest texels.
//   Gives: the history's mean by cubic weights, and ResamplingVariance.
//   Why: bilinear weights blur what is resampled frame after frame; cubic ones (Catmull & Rom 1974) hardly do. What remains
//   of the error grows with the range of the texels. It counts as variance of the history (Blend.glsl), so that a moving edge
//   relies on new frames and a smooth region does not.
#ifndef LANTERN_TEMPORAL_RESAMPLE_GLSL
#define LANTERN_TEMPORAL_RESAMPLE_GLSL

#include "Types.glsl"

#if CHANNELS == 1
const float RangeError = 0.05;    // share of the squared range that counts as error
const float NoiseOfRange = 12.0; // squared range that noise alone makes, in variances of a texel

struct FSignalRange
{
	FSignal Low, High;
};

// Squared range that noise does not explain.
float GetStructure(FSignalRange Range, FAccumulated Past)
{
	float Spread = GetBrightness(Range.High - Range.Low);
	return max(Spread * Spread - NoiseOfRange * Past.NoiseSigma * Past.NoiseSigma / Past.Frames, 0.0);
}

// A texel that shows another surface counts as the bilinear mean. The result stays within Range: cubic weights overshoot.
void ResampleCubic(FViewConstants View, FReprojection R, uvec2 Pixel, FSurface Surface, FSignalRange Range, inout FHistory History)
{
	History.ResamplingVariance = Push.Resampling * RangeError * GetStructure(Range, History.Past);
	FExpectedSurface Expected = ExpectSurface(View, Pixel, Surface, texelFetch(Textures[Push.Motion], ivec2(Pixel), 0));
	Expected.DistanceSlope *= 2.0; // texels are up to two pixels away
	vec4 X = CubicWeights(R.Fraction.x), Y = CubicWeights(R.Fraction.y);
	FSignal Sum = FSignal(0.0);
	[[dont_unroll]] for (int Tap = 0; Tap < 16; ++Tap)
	{
		ivec2 P = clamp(R.Base + ivec2(Tap & 3, Tap >> 2) - 1, ivec2(0), ivec2(View.PreviousWidth, View.PreviousHeight) - 1);
		vec4 H = texelFetch(Textures[Push.History], P, 0);
		bool bSame = AreFinite(H) && ShowedSurface(Expected, Push.PreviousSurface, P);
		Sum += (bSame ? GetSignal(H) : History.Past.Mean) * (X[Tap & 3] * Y[Tap >> 2]);
	}
	History.Past.Mean = clamp(Sum, Range.Low, Range.High);
}
#endif

#endif
