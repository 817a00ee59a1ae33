// Accumulation over time: where the pixel's surface was seen before, this frame's value joins the mean of those before it.
// SPARSE: most tiles of the screen may show nothing.
// QUARTER: of colours of which one pixel of each 2×2 has a value of its own, in turn (Library/Rate.glsl).
// main() lists the steps. Each is a file of the folder Temporal/ that says what it takes, what it gives, why, and its source.
#version 460
#include "../Shared/DenoiseTypes.h"
#include "../Library/View.glsl"

#if CHANNELS == 1
#define GROUP_SIZE DENOISE_VISIBILITY_GROUP_SIZE
#else
#define GROUP_SIZE DENOISE_GROUP_SIZE
#endif
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FTemporalConstants Push; };

#include "Temporal/Load.glsl"
#include "Temporal/Window.glsl"
#include "Temporal/Neighborhood.glsl"
#include "Temporal/Noise.glsl"
#include "Temporal/Known.glsl"
#include "Temporal/Reproject.glsl"
#include "Temporal/Resample.glsl"
#include "Temporal/Follow.glsl"
#include "Temporal/Change.glsl"
#include "Temporal/Clamp.glsl"
#include "Temporal/Blend.glsl"
#include "Temporal/Store.glsl"
#include "Temporal/View.glsl"

const float EnoughRays = 4.0;      // that stand without a history
const float CertainSigma = 1.0e-3; // standard deviation of a history without noise

// PreviousSize: of the history, pixels. Unchanged: gets the share of the history that is kept.
FAccumulated Accumulate(FFrameEstimate Frame, FHistory History, ivec2 PreviousSize, bool bMayHaveChanged, out float Unchanged)
{
#ifndef NO_ADAPTION // r.RT.Debug.Denoise.Adapt
	// Where light may change, certainty of long standing would hide the first rays that say otherwise.
	if (bMayHaveChanged && History.Past.NoiseSigma < CertainSigma) { History.Past.Frames = min(History.Past.Frames, 1.0); }
#endif
	Unchanged = bMayHaveChanged ? GetUnchangedShare(Frame, History, PreviousSize) : 1.0;
#if CHANNELS == 1 && !defined(NO_ADAPTION) // r.RT.Debug.Denoise.Adapt
	// Further rays at a border that may have moved are worth more than what was there before. Those of lamps are few, and ask for a history:
	// without one they would be asked for again in each frame.
	if (bMayHaveChanged && Push.bChangesKnown != 0u && Frame.Rays >= EnoughRays) { Unchanged = 0.0; }
#endif
	// Between texels a history holds no edge: what is narrower than a pixel is this frame's alone.
	if (History.bResampled) { Unchanged *= GetSoftness(Frame.Extent); }
	float Noise = EstimateNoise(Frame, History.Past, Unchanged);
	History.Past.Frames *= Unchanged;
#if CHANNELS == 1
	if (History.bResampled && Frame.bHasValue) { History.ResamplingVariance += GetEdgeVariance(Frame, History); }
#else
	if (bMayHaveChanged) { ClampHistory(Frame.Window, History.Past); }
#endif
	return Frame.bHasValue ? Blend(Frame, History, Noise) : FillIn(Frame, History, Noise, Unchanged);
}

#if CHANNELS != 1
shared uint bLit; // some pixel of the group's tile has a signal

// Called by all threads, with a barrier before. Dim lights seldom ask for rays (r.RT.Lights.DimEmitters): what looks at neighbours is left out.
bool IsGroupDark(bool bMine)
{
	if (bMine) { bLit = 1u; }
	barrier();
	return bLit == 0u;
}
#endif

#ifdef SPARSE
shared uint bAnything;

// Called by all threads. False: no pixel of the group shows anything, and what that needs has been stored.
bool ShowsAnything(ivec2 Pixel, ivec2 Size)
{
	bool bInside = all(lessThan(Pixel, Size));
	if (gl_LocalInvocationIndex == 0u) { bAnything = 0u; }
	barrier();
	if (bInside && texelFetch(Textures[Push.Surface], Pixel, 0).x > 0.0) { bAnything = 1u; }
	barrier();
	if (bAnything != 0u) { return true; }
	if (!bInside) { return false; }
	FSignal Value = GetSignal(texelFetch(Textures[Push.Signal], Pixel, 0));
	Store(Pixel, FAccumulated(SanitizeSignal(Value, IsSignalFinite(Value)), 0.0, 0.0, 0.0), 0.0);
	DrawCertain(Pixel, true);
	return false;
}
#endif

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Size = ivec2(View.Width, View.Height), Pixel = ivec2(gl_GlobalInvocationID.xy);
#ifdef SPARSE
	if (!ShowsAnything(Pixel, Size)) { return; }
#endif
	StartTouched();
#ifdef FINDS_EVEN
	StartEven();
	barrier();
#endif
#if CHANNELS != 1
	if (gl_LocalInvocationIndex == 0u) { bLit = 0u; }
#endif
	FindTurn(View.FrameIndex);
	bool bLoadedAny = LoadTile(Size);
	barrier();
	NoteDistances();
#ifdef FINDS_EVEN
	if (IsEven()) { ClearOutliers(); }
	else { MeasureOutliers(); }
#elif CHANNELS == 1
	MeasureOutliers();
#else
	if (IsGroupDark(bLoadedAny)) { ClearOutliers(); }
	else
	{
		MeasureOutliers();
		SumWindowRows();
	}
#endif
	barrier();
	FindTouched(View);
	if (any(greaterThanEqual(Pixel, Size))) { return; }
	FSurface Surface = LoadSurface(Push.Surface, Pixel);
	if (Surface.Distance <= 0.0) // the sky: the signal as it is
	{
		FSignal Value = GetSignal(texelFetch(Textures[Push.Signal], Pixel, 0));
		Store(Pixel, FAccumulated(SanitizeSignal(Value, IsSignalFinite(Value)), 0.0, 0.0, 0.0), 0.0);
		DrawCertain(Pixel, true);
		return;
	}
	bool bMayHaveChanged = MayHaveChanged(View, uvec2(Pixel), Surface.Distance);
	FFrameEstimate Frame;
#ifdef FINDS_EVEN
	bool bEven = IsEven() && !bMayHaveChanged;
	if (bEven) { Frame = EstimateEvenFrame(); }
	else { Frame = EstimateFrame(); }
#elif CHANNELS == 1
	Frame = EstimateFrame();
#else
	if (bLit != 0u) { Frame = EstimateFrame(); }
	else { Frame = EstimateDarkFrame(); }
	if (IsCertain())
	{
		Store(Pixel, FAccumulated(Frame.Value, 0.0, 1.0, Frame.Neighborhood.Mean), Frame.Extent);
		DrawCertain(Pixel, false);
		return;
	}
#endif
	FHistory History = ReprojectHistory(View, uvec2(Pixel), Surface);
#ifdef FINDS_EVEN
	if (bEven) { CompleteEvenFrame(History.bResampled, History.Past.Mean, Frame); }
#elif CHANNELS != 1
	FollowChange(Pixel, History);
	FollowShare(Pixel, Frame, History);
#endif
	bool bKnown = History.Past.Frames > 0.0;
	float Unchanged;
	FAccumulated Now = Accumulate(Frame, History, ivec2(View.PreviousWidth, View.PreviousHeight), bMayHaveChanged, Unchanged);
	Store(Pixel, Now, Frame.Extent);
	DrawHistory(Pixel, Now.Frames, bKnown ? Unchanged : NothingKept);
}
