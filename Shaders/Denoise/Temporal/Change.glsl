// Step "change" of the temporal filter: asks whether the light has changed, and how much of the history still holds.
//   Takes: the neighbourhood of this frame, and its mean over time in the history.
//   Gives: a share, 0 to 1, by which the caller multiplies the history's number of frames.
//   Why: motion vectors know nothing of a shadow that moves over a floor. If the neighbourhood's mean differs from its mean
//   over time by more standard errors than chance explains, accumulation starts anew. "Gradient Estimation for Real-Time
//   Adaptive Temporal Filtering" (Schied et al. 2018) traces old samples again for this. Here the frame's own samples serve.
#ifndef LANTERN_TEMPORAL_CHANGE_GLSL
#define LANTERN_TEMPORAL_CHANGE_GLSL

#include "Noise.glsl"

const float LeastChange = 0.01; // of visibility
const float FullChange = 1.75;  // in Push.ChangeSigma: nothing is kept from here on

#if CHANNELS == 1
// Noise of visibility around a texel of the history. A region that has always been lit, or always shadowed, has hardly any: a
// shadow that enters it is seen at once. Frames that agree prove little if they are few. Laplace's rule of succession, with
// half a ray of either kind, accounts for that.
float GetPastNoise(ivec2 Texel, ivec2 Size, float Frames)
{
	float Sum = 0.0;
	[[dont_unroll]] for (int Y = -NeighborhoodRadius; Y <= NeighborhoodRadius; ++Y)
	{
		[[dont_unroll]] for (int X = -NeighborhoodRadius; X <= NeighborhoodRadius; ++X)
		{
			float P = texelFetch(Textures[Push.History], clamp(Texel + ivec2(X, Y), ivec2(0), Size - 1), 0).x;
			P = IsFinite(P) ? clamp((P * Frames + 0.5) / (Frames + 1.0), 0.0, 1.0) : 0.5;
			Sum += GetVisibilityVariance(P);
		}
	}
	float Width = float(2 * NeighborhoodRadius + 1);
	return Sum / (Width * Width);
}
#endif

// Variance of one pixel's value that chance explains.
float GetExpectedVariance(FFrameEstimate Frame, FHistory History, ivec2 Size)
{
#if CHANNELS == 1
	// Where a shadow has moved, the history is blurred and sees noise everywhere. What is sharp in this frame is no noise.
	float Binomial = GetVisibilityVariance(GetProbability(Frame.Neighborhood, 2.0));
	float NoiseNow = max(Frame.Neighborhood.OutlierVariance, 0.3 * Binomial);
	return min(GetPastNoise(History.Texel, Size, History.Past.Frames), NoiseNow);
#else
	return max(max(Frame.NoiseVariance, History.Past.NoiseSigma * History.Past.NoiseSigma), 0.25 * Frame.Window.Variance);
#endif
}

float GetUnchangedShare(FFrameEstimate Frame, FHistory History, ivec2 Size)
{
	if (Push.ChangeSigma <= 0.0 || History.Past.Frames <= 0.0) { return 1.0; }
#ifdef WITH_EXTENT
	if (!Frame.bHasValue) { return 1.0; } // else chance would drop the histories of pixels with few values more often than those of others
#endif
	float Past = History.Past.NeighborhoodMean;
	float Difference = abs(Frame.Neighborhood.Mean - Past);
#if CHANNELS == 1
	if (!(Difference > LeastChange)) { return 1.0; }
#endif
	float Noise = GetExpectedVariance(Frame, History, Size);
	float Variance = Noise / Frame.Neighborhood.Count * (1.0 + 1.0 / History.Past.Frames);
	float StandardErrors = Difference * inversesqrt(Variance + 1.0e-12);
	return 1.0 - smoothstep(Push.ChangeSigma, FullChange * Push.ChangeSigma, StandardErrors);
}

#endif
