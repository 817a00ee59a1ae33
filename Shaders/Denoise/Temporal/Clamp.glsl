// Step "clamp" of the temporal filter, for colours: keeps the history's mean within the range that the window of this frame allows.
//   Takes: the window's mean and standard deviation; the history.
//   Gives: the history with its mean clamped. The range is at least the history's own noise, up to the mean: a window may miss what few rays
//   meet. A pixel that asked for no ray to an emitter says nothing of the range, nor does a window of such. There it is that noise, many times.
//   Why: the history follows light that changes (Salvi 2016, "An Excursion in Temporal Supersampling"). Visibility does without:
//   the step "change" finds what changes there, and a clamp made ambient occlusion worse (Docs/Performance.md).
#ifndef LANTERN_TEMPORAL_CLAMP_GLSL
#define LANTERN_TEMPORAL_CLAMP_GLSL

#include "Types.glsl"

#if CHANNELS != 1
void ClampHistory(FWindow Window, inout FAccumulated Past)
{
	if (Push.ClampSigma <= 0.0) { return; }
	FSignal Sigma = Window.Sigma;
	if (LoadChance() == CHANCE_OF_NOBODY) { Sigma = max(Sigma, FSignal(Past.NoiseSigma)); }
	FSignal Range = max(Sigma * Push.ClampSigma, min(FSignal(Past.NoiseSigma), Window.Mean)); // where a channel is dark, nothing may stay
	Past.Mean = clamp(Past.Mean, Window.Mean - Range, Window.Mean + Range);
}
#endif

#endif
