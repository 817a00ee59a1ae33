// Accumulation over time, of colours whose noise is known: the same steps as those of Temporal.comp, without what looks for noise and for
// changes in the pixels around.
#version 460
#include "../Shared/DenoiseTypes.h"
#include "../Library/View.glsl"

layout(local_size_x = DENOISE_GROUP_SIZE, local_size_y = DENOISE_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FTemporalConstants Push; };

#define KNOWN_NOISE
#include "Temporal/Noise.glsl"
#include "Temporal/Reproject.glsl"
#include "Temporal/Follow.glsl"
#include "Temporal/Blend.glsl"
#include "Temporal/Store.glsl"
#include "Temporal/View.glsl"

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	if (IsOutsideView(View, uvec2(Pixel))) { return; }
	FSurface Surface = LoadSurface(Push.Surface, Pixel);
	FFrameEstimate Frame = EstimateFrame();
	if (Surface.Distance <= 0.0) // the sky: the signal as it is
	{
		Store(Pixel, FAccumulated(Frame.Value, 0.0, 0.0, 0.0), 0.0);
		DrawCertain(Pixel, true);
		return;
	}
	FHistory History = ReprojectHistory(View, uvec2(Pixel), Surface);
	FollowChange(Pixel, History);
	FollowShare(Pixel, Frame, History);
	float Noise = EstimateNoise(Frame, History.Past, 1.0);
	float Kept = History.Past.Frames > 0.0 ? 1.0 : NothingKept;
	FAccumulated Now = Frame.bHasValue ? Blend(Frame, History, Noise) : FillIn(Frame, History, Noise, 1.0);
	Store(Pixel, Now, Frame.Extent);
	DrawHistory(Pixel, Now.Frames, Kept);
}
