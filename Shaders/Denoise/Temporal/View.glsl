// Step "view" of the temporal filter: draws what it knows of a pixel, for r.RT.Debug.View.
//   Takes: frames that the pixel's mean is worth, and the share of the history that was kept; negative: there was none.
//   Gives: the image Push.OutView.
//   Why: it answers why a pixel is noisy. Confidence: black is one frame, white are 32 and more. Change: the redder, the more was
//   dropped. Blue has no history, and green is without noise, so that it needs none.
#ifndef LANTERN_TEMPORAL_VIEW_GLSL
#define LANTERN_TEMPORAL_VIEW_GLSL

#include "Types.glsl"

const float NothingKept = -1.0;

void DrawHistory(ivec2 Pixel, float Frames, float Kept)
{
	if (Push.OutView == NO_TEXTURE) { return; }
	float Confidence = clamp(log2(max(Frames, 1.0)) / 5.0, 0.0, 1.0);
	vec3 Color = Push.bViewChange != 0u ? vec3(1.0 - Kept, vec2(0.15 * Confidence)) : vec3(Confidence);
	if (Kept < 0.0) { Color = vec3(0.15, 0.25, 0.9); }
	imageStore(Images[Push.OutView], Pixel, vec4(Color, 1.0));
}

void DrawCertain(ivec2 Pixel, bool bSky)
{
	if (Push.OutView != NO_TEXTURE) { imageStore(Images[Push.OutView], Pixel, vec4(bSky ? vec3(0.0) : vec3(0.05, 0.35, 0.1), 1.0)); }
}

#endif
