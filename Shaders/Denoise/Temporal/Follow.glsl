// Step "follow" of the temporal filter, for colours: adds to the history what the scene knows to have changed since the last frame.
//   Takes: the image Push.Change, a difference and the standard deviation of its error; the image Push.ChangedShare; the estimate of this
//   frame; the history. A negative deviation: the history is worth nothing.
//   Gives: the history with its means moved. The error counts as that of resampling (Blend.glsl).
//   Why: a lamp that is switched is known. To find it in noise takes frames, or drops what was right.
#ifndef LANTERN_TEMPORAL_FOLLOW_GLSL
#define LANTERN_TEMPORAL_FOLLOW_GLSL

#include "../ChangedShare.glsl"
#include "Types.glsl"

#if CHANNELS != 1
// Shortens a history of which a share has changed, nobody knows how, and adds the error. What has come may be brighter than all that was there.
void FollowShare(ivec2 Pixel, FFrameEstimate Frame, inout FHistory History)
{
	if (Push.ChangedShare == NO_TEXTURE) { return; }
	vec2 Changed = texelFetch(Textures[Push.ChangedShare], Pixel, 0).xy;
	float Brightness = max(GetBrightness(History.Past.Mean), Frame.Neighborhood.Mean), Error = GetChangeError(Changed, Brightness);
	if (Error <= 0.0) { return; }
	History.Past.Frames *= GetKeptShare(Error, Brightness);
	History.ResamplingVariance += Error * Error;
}

void FollowChange(ivec2 Pixel, inout FHistory History)
{
	if (Push.Change == NO_TEXTURE) { return; }
	vec4 Change = texelFetch(Textures[Push.Change], Pixel, 0);
	if (!AreFinite(Change)) { return; }
	if (Change.w < 0.0)
	{
		History.Past.Frames = 0.0;
		return;
	}
	History.Past.Mean = max(History.Past.Mean + Change.xyz, 0.0);
	History.Past.NeighborhoodMean = max(History.Past.NeighborhoodMean + GetBrightness(Change.xyz), 0.0);
	History.ResamplingVariance += Change.w * Change.w;
}
#endif

#endif
