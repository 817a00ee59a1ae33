// Step "reproject" of the temporal filter: reads the accumulated signal where the pixel's surface was in the previous frame.
//   Takes: the previous frame's images (Push.History, Push.Moments) and where the surface was in it (Push.Reprojection; of colours:
//   Push.Anchors).
//   Gives: FHistory. Frames is 0 if the surface was not seen.
//   Why: the four nearest texels count only if they showed the same surface (Library/History.glsl), so that nothing leaks
//   from one object to another. Visibility is read between them. Variances add up, and so the numbers of frames have a harmonic mean.
//   Colours take one texel as it is: what lies between texels would blur them, frame after frame. A picture of another size comes once, and
//   is read between texels.
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

// Sums of texels. Frames is the sum of their inverses, since variances add up.
void AddTexel(FAccumulated Texel, float Weight, inout FAccumulated Sum)
{
	Sum.Mean += Texel.Mean * Weight;
	Sum.NoiseSigma += Texel.NoiseSigma * Weight;
	Sum.NeighborhoodMean += Texel.NeighborhoodMean * Weight;
	Sum.Frames += Weight / Texel.Frames;
}

// Weights: sum of those that were added, above 0.
FAccumulated MeanOfTexels(FAccumulated Sum, float Weights)
{
	return FAccumulated(Sum.Mean / Weights, Sum.NoiseSigma / Weights, Weights / Sum.Frames, Sum.NeighborhoodMean / Weights);
}

#if CHANNELS == 1
FHistory ReprojectHistory(FViewConstants View, uvec2 Pixel, FSurface Surface)
{
	if (Push.History == NO_TEXTURE) { return NoHistory; }
	FReprojection R = LoadReprojection(Push.Reprojection, ivec2(Pixel));
	FAccumulated Sum = NothingAccumulated;
	float Weights = 0.0;
	FSignalRange Range = FSignalRange(FSignal(MaxHalf), FSignal(0.0));
	[[dont_unroll]] for (int Tap = 0; Tap < 4; ++Tap)
	{
		float Weight = R.Weights[Tap];
		if (Weight <= 0.0) { continue; }
		FAccumulated Texel = LoadAccumulated(GetTap(R, Tap));
		if (Texel.Frames <= 0.0) { continue; }
		AddTexel(Texel, Weight, Sum);
		Weights += Weight;
		Range = FSignalRange(min(Range.Low, Texel.Mean), max(Range.High, Texel.Mean));
	}
	if (Weights <= 0.0) { return NoHistory; }
	// A history of few texels is worth less: it is as noisy as these, and its noise is theirs.
	float Known = R.Coverage * Weights;
	FAccumulated Past = MeanOfTexels(Sum, Weights);
	Past.Frames = Past.Frames * Known * Known;
	bool bResampled = any(greaterThan(R.Fraction * (1.0 - R.Fraction), vec2(1.0e-4)));
	FHistory History = FHistory(Past, 0.0, bResampled, R.Base + ivec2(R.Fraction + 0.5));
	// If all texels are equal, or the position is a texel's, interpolation is exact already.
	if (bResampled && Range.Low != Range.High) { ResampleCubic(View, R, Pixel, Surface, Range, History); }
	return History;
}
#else
// Whether a texel beside another shows the surface of that one. At grazing angles their distances are far apart.
bool IsBeside(FSurface Its, FSurface Other)
{
	const float SameNormal = 0.95, SameDepth = 0.05, MostDepth = 0.5; // depths: over the distance
	float Apart = abs(Its.Distance - Other.Distance) / Its.Distance;
	bool bSame = Its.Identity == Other.Identity && dot(Its.Normal, Other.Normal) > SameNormal;
	return Other.Distance > 0.0 && Apart < (bSame ? MostDepth : SameDepth) && HasSameNormal(Its, Other);
}

// Pictures of another size have no texel for each pixel: taken as they are, they would show as blocks. Returns what lies around the anchor's
// place, of its surface alone. By how much it differs from what is beside it, it is uncertain: an edge may have been anywhere between texels.
FHistory ResampleOtherSize(FViewConstants View, FAnchor Anchor)
{
	const float LostShare = 0.0625; // of a difference's square: a quarter of it is lost between texels
	vec2 Place = vec2(Anchor.Texel) - Anchor.Offset;
	ivec2 Base = ivec2(floor(Place)), Last = ivec2(View.PreviousWidth, View.PreviousHeight) - 1;
	vec2 F = Place - vec2(Base);
	FSurface Its = LoadSurface(Push.PreviousSurface, Anchor.Texel);
	FAccumulated Past = LoadAccumulated(Anchor.Texel), Sum = NothingAccumulated;
	float Known = 0.0, Squares = 0.0, Count = 0.0;
	[[dont_unroll]] for (int Tap = 0; Tap < 16; ++Tap)
	{
		ivec2 Step = ivec2(Tap % 4, Tap / 4) - 1, P = clamp(Base + Step, ivec2(0), Last);
		FSurface Other = LoadSurface(Push.PreviousSurface, P);
		FAccumulated Texel = LoadAccumulated(P);
		if (Texel.Frames <= 0.0 || !IsBeside(Its, Other)) { continue; }
		vec2 Near = max(1.0 - abs(vec2(Step) - F), 0.0);
		float Weight = Near.x * Near.y, Difference = GetBrightness(Texel.Mean) - GetBrightness(Past.Mean);
		Squares += Difference * Difference;
		Count += 1.0;
		AddTexel(Texel, Weight, Sum);
		Known += Weight;
	}
	if (Known > 0.0) { Past = MeanOfTexels(Sum, Known); }
	return FHistory(Past, LostShare * Squares / max(Count, 1.0), false, Anchor.Texel);
}

FHistory ReprojectHistory(FViewConstants View, uvec2 Pixel, FSurface Surface)
{
	if (Push.History == NO_TEXTURE) { return NoHistory; }
	FAnchor Anchor = LoadAnchor(Push.Anchors, ivec2(Pixel));
	if (!Anchor.bFound) { return NoHistory; }
	FHistory History = FHistory(NothingAccumulated, 0.0, false, Anchor.Texel);
	if (Push.PreviousSurface != NO_TEXTURE) { History = ResampleOtherSize(View, Anchor); }
	else { History.Past = LoadAccumulated(Anchor.Texel); }
	History.Past.Frames = GetAnchoredFrames(Anchor, History.Past.Frames);
	return History;
}
#endif

#endif
