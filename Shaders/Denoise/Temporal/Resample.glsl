// Step "resample" of the temporal filter: reads the history between texels sharply, and estimates the error of doing so.
//   Takes: a history that has been interpolated bilinearly, and the range of its four nearest texels.
//   Gives: the history's mean by cubic weights, and ResamplingVariance.
//   Why: bilinear weights blur what is resampled frame after frame; cubic ones (Catmull & Rom 1974) hardly do. What remains
//   of the error grows with the second differences of the history. It counts as variance of the history (Blend.glsl), so
//   that a moving edge relies on new frames and a smooth region does not.
#ifndef LANTERN_TEMPORAL_RESAMPLE_GLSL
#define LANTERN_TEMPORAL_RESAMPLE_GLSL

#include "Types.glsl"

const float SecondDifferenceVariance = 6.0; // of independent texels, in variances of a texel: 1² + 2² + 1²
const float RangeError = 0.05;              // share of the squared range that counts as error

struct FSignalRange
{
	FSignal Low, High;
};

// Mean square of the second differences around the middle of 4×4 texels: 0 over a slope, large at edges.
float GetRoughness(float Texels[16])
{
	const ivec4 Inner = ivec4(5, 6, 9, 10);
	float Sum = 0.0;
	[[dont_unroll]] for (int I = 0; I < 4; ++I)
	{
		int T = Inner[I];
		vec2 Bend = vec2(Texels[T - 1] + Texels[T + 1], Texels[T - 4] + Texels[T + 4]) - 2.0 * Texels[T];
		Sum += dot(Bend, Bend);
	}
	return Sum / 8.0;
}

// Fraction: position between the texels. What noise explains of the differences is no error of resampling.
float GetResamplingVariance(float Texels[16], vec2 Fraction, FSignalRange Range, FAccumulated Past)
{
	float OfNoise = 2.0 * SecondDifferenceVariance * Past.NoiseSigma * Past.NoiseSigma / Past.Frames;
	vec2 Between = Fraction * (1.0 - Fraction);
	float Spread = GetBrightness(Range.High - Range.Low);
	float Bend = max(GetRoughness(Texels) - OfNoise, 0.0) * min(Between.x + Between.y, 0.25);
	return Push.Resampling * (Bend + RangeError * max(Spread * Spread - OfNoise, 0.0));
}

// A texel that shows another surface counts as the bilinear mean. The result stays within Range: cubic weights overshoot.
void ResampleCubic(FViewConstants View, FReprojection R, FSurface Surface, FSignalRange Range, inout FHistory History)
{
	vec4 X = CubicWeights(R.Fraction.x), Y = CubicWeights(R.Fraction.y);
	FSignal Sum = FSignal(0.0);
	float Texels[16];
	[[dont_unroll]] for (int Tap = 0; Tap < 16; ++Tap)
	{
		ivec2 P = clamp(R.Base + ivec2(Tap & 3, Tap >> 2) - 1, ivec2(0), ivec2(View.Width, View.Height) - 1);
		vec4 H = texelFetch(Textures[Push.History], P, 0);
		bool bSame = AreFinite(H) && IsSameSurface(Surface, LoadSurface(Push.PreviousSurface, P), R.ExpectedDistance, 2.0 * R.DistanceSlope);
		FSignal Value = bSame ? GetSignal(H) : History.Past.Mean;
		Sum += Value * (X[Tap & 3] * Y[Tap >> 2]);
		Texels[Tap] = GetBrightness(Value);
	}
	History.ResamplingVariance = GetResamplingVariance(Texels, R.Fraction, Range, History.Past);
	History.Past.Mean = clamp(Sum, Range.Low, Range.High);
}

#endif
