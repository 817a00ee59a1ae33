// Step "noise" of the temporal filter: the variance that chance gives to one frame's value.
//   Takes: neighbourhood, extents and, for colours, the window of this frame; the history.
//   Gives: FFrameEstimate with the noise of the frame alone, and EstimateNoise with what the history adds.
//   Why: a signal without noise needs neither other frames nor a filter, however much structure it has. Hard shadows stay as
//   they are. Visibility is a mean of rays that see or do not see: its variance is binomial and needs no estimate but p's.
//   Where a transition is narrower than a pixel, it is an edge and no noise: a frame alone is right about it. SIGMA, of
//   NVIDIA's Real-Time Denoisers, takes the size of its blur from the same extent. The noise of a colour is that of its outliers.
#ifndef LANTERN_TEMPORAL_NOISE_GLSL
#define LANTERN_TEMPORAL_NOISE_GLSL

#include "Types.glsl"

// Extents in pixels: a transition up to the first is an edge, one from the second on is a soft penumbra.
const float EdgeExtent = 0.2, SoftExtent = 1.0;
const float EdgeNoise = 1.0e-3;          // share of the noise that an edge keeps
const float TrustedHistoryFrames = 16.0; // with so many, the history says as much about p as the neighbourhood does

#ifdef KNOWN_NOISE
FFrameEstimate EstimateFrame()
{
	vec4 Texel = texelFetch(Textures[Push.Signal], ivec2(gl_GlobalInvocationID.xy), 0);
	bool bValid = AreFinite(Texel) && Texel.w >= 0.0;
	FSignal Value = SanitizeSignal(GetSignal(Texel), bValid);
	float Brightness = GetBrightness(Value), Sigma = bValid ? Texel.w * Brightness : 0.0;
	return FFrameEstimate(Value, bValid, FNeighborhood(Brightness), Sigma * Sigma, 1.0, MaxHalf);
}
#else
// Variance of the mean of a frame's rays if each sees with probability P.
float GetVisibilityVariance(float P)
{
	P = clamp(P, 0.0, 1.0);
	return P * (1.0 - P) / Push.RaysPerPixel;
}

// Extent of the transition in which the pixel lies, or beside which it lies: the mean of those around it that know theirs.
float MeasureExtent()
{
#ifdef WITH_EXTENT
	float InverseDepth = TileInverseDepth[GetTileIndex(ivec2(0))];
	float Sum = 0.0, Weights = 0.0;
	[[dont_unroll]] for (int Y = -WindowRadius; Y <= WindowRadius; ++Y)
	{
		[[dont_unroll]] for (int X = -WindowRadius; X <= WindowRadius; ++X)
		{
			int I = GetTileIndex(ivec2(X, Y));
			if (TileExtent[I] <= 0.0 || IsAtOtherDepth(I, InverseDepth)) { continue; }
			float Weight = 1.0 / float(1 + X * X + Y * Y);
			Sum += Weight * TileExtent[I];
			Weights += Weight;
		}
	}
	return Weights > 0.0 ? min(Sum / Weights, MaxHalf) : MaxHalf;
#else
	return MaxHalf;
#endif
}

// Chance that a ray sees, from a neighbourhood's rays and Doubt more of either kind. Few rays that agree prove no certainty: where
// one ray in 20 sees, a quarter of all neighbourhoods of 25 are black (Agresti & Coull 1998). If rays know the distance of their
// blockers, the extent says that no transition is near, and nothing is added.
float GetProbability(FNeighborhood Neighborhood, float Doubt)
{
#ifdef WITH_EXTENT
	return Neighborhood.Mean;
#else
	float Rays = Neighborhood.Count * Push.RaysPerPixel;
	return (Neighborhood.Mean * Rays + Doubt) / (Rays + 2.0 * Doubt);
#endif
}

#if CHANNELS == 1
// Some pixels trace more rays than others (Tiles/MoreRays.comp).
float LoadRays()
{
#ifdef WITH_EXTENT
	float Rays = texelFetch(Textures[Push.Extent], ivec2(gl_GlobalInvocationID.xy), 0).y;
	return Rays >= 1.0 && IsFinite(Rays) ? Rays / Push.RaysPerPixel : 1.0;
#else
	return 1.0;
#endif
}
#endif

#ifdef FINDS_EVEN
// Of an even group. Its extent is a stand-in until CompleteEvenFrame.
FFrameEstimate EstimateEvenFrame()
{
	int Own = GetTileIndex(ivec2(0));
	// Nobody asks how many neighbours there are where nothing may have changed.
	FNeighborhood Neighborhood = FNeighborhood(HasValue(Own) ? GetEvenValue() : 0.0, 0.0, 1.0);
	return FFrameEstimate(TileSignal[Own], HasValue(Own), Neighborhood, 0.0, LoadRays(), MaxHalf);
}

// Past: the history's mean. Where it agrees and lies on texels, the extent says nothing.
void CompleteEvenFrame(bool bResampled, FSignal Past, inout FFrameEstimate Frame)
{
	if (bResampled || Past != Frame.Value) { Frame.Extent = MeasureExtent(); }
}
#endif

FFrameEstimate EstimateFrame()
{
	int Own = GetTileIndex(ivec2(0));
	FNeighborhood Neighborhood = MeasureNeighborhood();
#if CHANNELS == 1
	float Noise = GetVisibilityVariance(Neighborhood.Mean);
	return FFrameEstimate(TileSignal[Own], HasValue(Own), Neighborhood, Noise, LoadRays(), MeasureExtent());
#else
	FWindow Window = MeasureWindow();
	float Rays = max(TileRays[Own], 1.0);
	float Noise = Neighborhood.OutlierVariance >= 0.0 ? Neighborhood.OutlierVariance : Window.Variance * Rays;
	return FFrameEstimate(TileSignal[Own], HasValue(Own), Window, Neighborhood, Noise, Rays, MeasureExtent());
#endif
}

#if CHANNELS != 1
// The same where the signal is 0 all around.
FFrameEstimate EstimateDarkFrame()
{
	const FWindow Dark = FWindow(FSignal(0.0), FSignal(0.0), 0.0);
	return FFrameEstimate(FSignal(0.0), HasValue(GetTileIndex(ivec2(0))), Dark, MeasureNeighborhood(), 0.0, 1.0, MaxHalf);
}
#endif
#endif

// 0: the transition is an edge; 1: it is a soft penumbra.
float GetSoftness(float Extent) { return smoothstep(EdgeExtent, SoftExtent, Extent); }

// Noise of one frame with the help of the history, of which the share Unchanged still holds.
float EstimateNoise(FFrameEstimate Frame, FAccumulated Past, float Unchanged)
{
#if CHANNELS == 1
	float Frames = Past.Frames * Unchanged;
	float P = mix(GetProbability(Frame.Neighborhood, 0.5), Past.Mean, Frames / (Frames + TrustedHistoryFrames));
	return GetVisibilityVariance(P) * max(GetSoftness(Frame.Extent), EdgeNoise);
#else
	if (Past.Frames <= 0.0) { return Frame.NoiseVariance; }
	// The estimate remembers as long as the mean does. Else the wavelet would take for structure what a bright path has left in the mean.
	float Alpha = Frame.bHasValue ? max(Push.MinAlpha, 1.0 / (Past.Frames + 1.0)) : 0.0;
	return mix(Frame.NoiseVariance, Past.NoiseSigma * Past.NoiseSigma, (1.0 - Alpha) * Unchanged);
#endif
}

#endif
