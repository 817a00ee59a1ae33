// Step "reproject" of the temporal filter: reads the accumulated signal where the pixel's surface was in the previous frame.
//   Takes: the previous frame's images (Push.History, Push.Moments) and where the surface was in it (Push.Reprojection; of colours:
//   Push.Anchors).
//   Gives: FHistory. Frames is 0 if the surface was not seen.
//   Why: the four nearest texels count only if they showed the same surface (Library/History.glsl), so that nothing leaks
//   from one object to another. Visibility is read between them. Variances add up, and so the numbers of frames have a harmonic mean.
//   Colours take one texel as it is: what lies between texels would blur them, frame after frame.
#ifndef LANTERN_TEMPORAL_REPROJECT_GLSL
#define LANTERN_TEMPORAL_REPROJECT_GLSL

#include "Resample.glsl"

const FAccumulated NothingAccumulated = FAccumulated(FSignal(0.0), 0.0, 0.0, 0.0);
const FHistory NoHistory = FHistory(NothingAccumulated, 0.0, false, ivec2(0));

// Frames is 0 if the texel holds nothing, or something that is not finite.
FAccumulated LoadAccumulated(ivec2 Texel)
{
	vec4 History = texelFetch(Textures[Push.History], Texel, 0);
#if CHANNELS == 1
	vec2 Moments = History.yw;
	float Frames = History.z;
#else
	vec2 Moments = texelFetch(Textures[Push.Moments], Texel, 0).xy;
	float Frames = History.w;
#endif
	if (!AreFinite(History) || !AreFinite(Moments) || Frames <= 0.0) { return NothingAccumulated; }
	return FAccumulated(GetSignal(History), Moments.x, Frames, Moments.y);
}

#if CHANNELS == 1
FHistory ReprojectHistory(FViewConstants View, uvec2 Pixel, FSurface Surface)
{
	if (Push.History == NO_TEXTURE) { return NoHistory; }
	FReprojection R = LoadReprojection(Push.Reprojection, ivec2(Pixel));
	FAccumulated Sum = NothingAccumulated; // Frames: sum of their inverses
	float Weights = 0.0;
	FSignalRange Range = FSignalRange(FSignal(MaxHalf), FSignal(0.0));
	[[dont_unroll]] for (int Tap = 0; Tap < 4; ++Tap)
	{
		float Weight = R.Weights[Tap];
		if (Weight <= 0.0) { continue; }
		FAccumulated Texel = LoadAccumulated(GetTap(R, Tap));
		if (Texel.Frames <= 0.0) { continue; }
		Sum.Mean += Texel.Mean * Weight;
		Sum.NoiseSigma += Texel.NoiseSigma * Weight;
		Sum.NeighborhoodMean += Texel.NeighborhoodMean * Weight;
		Sum.Frames += Weight / Texel.Frames;
		Weights += Weight;
		Range = FSignalRange(min(Range.Low, Texel.Mean), max(Range.High, Texel.Mean));
	}
	if (Weights <= 0.0) { return NoHistory; }
	// A history of few texels is worth less: it is as noisy as these, and its noise is theirs.
	float Known = R.Coverage * Weights;
	float Frames = Weights / Sum.Frames * Known * Known;
	FAccumulated Past = FAccumulated(Sum.Mean / Weights, Sum.NoiseSigma / Weights, Frames, Sum.NeighborhoodMean / Weights);
	bool bResampled = any(greaterThan(R.Fraction * (1.0 - R.Fraction), vec2(1.0e-4)));
	FHistory History = FHistory(Past, 0.0, bResampled, R.Base + ivec2(R.Fraction + 0.5));
	// If all texels are equal, or the position is a texel's, interpolation is exact already.
	if (bResampled && Range.Low != Range.High) { ResampleCubic(View, R, Pixel, Surface, Range, History); }
	return History;
}
#else
FHistory ReprojectHistory(FViewConstants View, uvec2 Pixel, FSurface Surface)
{
	const float WorthOfOthers = 0.25, MostFramesOfOthers = 16.0; // of a history that is another surface's
	if (Push.History == NO_TEXTURE) { return NoHistory; }
	FAnchor Anchor = LoadAnchor(Push.Anchors, ivec2(Pixel));
	if (!Anchor.bFound) { return NoHistory; }
	FAccumulated Past = LoadAccumulated(Anchor.Texel);
	if (Anchor.bOther) { Past.Frames = min(WorthOfOthers * Past.Frames, MostFramesOfOthers); }
	return FHistory(Past, 0.0, false, Anchor.Texel);
}
#endif

#endif
