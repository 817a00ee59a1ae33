// Step "blend" of the temporal filter: joins this frame's value with the mean of those before.
//   Takes: this frame's value, the history, and the noise of one frame.
//   Gives: FAccumulated, what the pixel keeps.
//   Why: the weights follow from the variances on both sides (Kalman 1960). The history's variance is what accumulation has
//   left of the noise, plus the error of resampling. With many frames the weight becomes constant: the mean is then
//   exponential, with a time constant in seconds.
#ifndef LANTERN_TEMPORAL_BLEND_GLSL
#define LANTERN_TEMPORAL_BLEND_GLSL

#include "Noise.glsl"

#if CHANNELS == 1
// Variance that a disagreement with the frame adds to a resampled history beside an edge, for it belongs to the other side.
// The caller leaves out a history of the very same point: its disagreement is chance, because rays differ.
float GetEdgeVariance(FFrameEstimate Frame, FHistory History)
{
	float Difference = Frame.Value - History.Past.Mean;
	return (1.0 - GetSoftness(Frame.Extent)) * Difference * Difference;
}
#endif

// What agrees with the history without any noise, at the edge of certainty, still adds to what is known: only then does a single ray that
// sees through the leaves count as one of many.
const float AgreedDifference = 2.0e-3;

// Least weight of a frame's value, whatever is known: it says how long the history lasts.
float GetMinAlpha()
{
#if CHANNELS == 1 || defined(KNOWN_NOISE)
	return Push.MinAlpha;
#else
	// What was chosen of many has more noise than half a second averages.
	float Chance = LoadChance();
	return Chance == CHANCE_OF_MANY || Chance == CHANCE_OF_NOBODY ? 0.5 * Push.MinAlpha : Push.MinAlpha;
#endif
}

// Weight of the frame's value.
float GetAlpha(FFrameEstimate Frame, FHistory History, float Noise)
{
	float Frames = History.Past.Frames;
	if (Frames <= 0.0) { return 1.0; }
#ifdef NO_ADAPTION // r.RT.Debug.Denoise.Adapt
	return max(1.0 / (Frames + 1.0), GetMinAlpha());
#else
	float PastVariance = Noise / Frames + History.ResamplingVariance;
	if (Noise > 1.0e-6 * (1.0 + PastVariance)) { return max(PastVariance / (PastVariance + Noise / Frame.Rays), GetMinAlpha()); }
	bool bAgrees = abs(GetBrightness(Frame.Value) - GetBrightness(History.Past.Mean)) < AgreedDifference;
	return bAgrees ? max(Frame.Rays / (Frames + Frame.Rays), GetMinAlpha()) : 1.0;
#endif
}

FAccumulated Blend(FFrameEstimate Frame, FHistory History, float Noise)
{
	float Alpha = GetAlpha(Frame, History, Noise);
	FAccumulated Past = History.Past;
	float NeighborhoodMean = mix(Past.NeighborhoodMean, Frame.Neighborhood.Mean, Alpha);
	return FAccumulated(mix(Past.Mean, Frame.Value, Alpha), sqrt(Noise), Frame.Rays / Alpha, NeighborhoodMean);
}

// For a pixel without a value: the history if there is one, else the mean of what is around it. What stands for the value counts the
// more, the less is known of how the history has changed.
// Unchanged: share of the history that still holds.
FAccumulated FillIn(FFrameEstimate Frame, FHistory History, float Noise, float Unchanged)
{
	FAccumulated Past = History.Past;
#if CHANNELS != 1 && !defined(KNOWN_NOISE)
	if (Past.Frames > 0.0 && IsFilled())
	{
		const float Others = 2.0; // of which it is the mean, at least
		float Share = History.ResamplingVariance / (History.ResamplingVariance + Noise * (1.0 / Past.Frames + 1.0 / Others) + 1.0e-12);
		Share = max(Share, 1.0 - Unchanged);
		Past.Mean = mix(Past.Mean, Frame.Value, Share);
		Past.NeighborhoodMean = mix(Past.NeighborhoodMean, Frame.Neighborhood.Mean, Share);
		Past.Frames = mix(Past.Frames, 1.0, Share);
	}
#endif
	if (Past.Frames > 0.0) { return Past; }
#if CHANNELS == 1
	FSignal Around = Frame.Neighborhood.Mean;
#elif defined(KNOWN_NOISE)
	FSignal Around = Frame.Value;
#else
	FSignal Around = IsFilled() ? Frame.Value : Frame.Window.Mean;
#endif
	return FAccumulated(Around, sqrt(Noise), 0.0, Frame.Neighborhood.Mean);
}

#endif
