// Step "clamp" of the temporal filter: keeps the history's mean within the range that the window of this frame allows.
//   Takes: the window's mean and standard deviation; the history.
//   Gives: the history with its mean clamped, and worth fewer frames the more the clamp has moved it.
//   Why: the history follows light that changes (Salvi 2016, "An Excursion in Temporal Supersampling"). Where all of the
//   window agrees, the range is about a point: regions that are lit or shadowed have no lag.
#ifndef LANTERN_TEMPORAL_CLAMP_GLSL
#define LANTERN_TEMPORAL_CLAMP_GLSL

#include "Types.glsl"

// Added to the range on either side. If 49 rays all see, up to 6 % of all rays may still be blocked (the rule of three), and in
// a penumbra neighbours differ. Occlusion as slight as that is better smooth than exact.
#ifdef WITH_EXTENT
const float ClampSlack = 0.2;
#else
const float ClampSlack = 0.0;
#endif

void ClampHistory(FWindow Window, inout FAccumulated Past)
{
	if (Push.ClampSigma <= 0.0) { return; }
	FSignal Range = Window.Sigma * Push.ClampSigma + ClampSlack;
	FSignal Clamped = clamp(Past.Mean, Window.Mean - Range, Window.Mean + Range);
	float Moved = GetBrightness(abs(Clamped - Past.Mean));
	float Brightness = max(GetBrightness(Past.Mean), GetBrightness(Clamped));
	Past.Frames *= 1.0 - clamp(Moved / max(Brightness, 1.0e-6), 0.0, 1.0);
	Past.Mean = Clamped;
}

#endif
