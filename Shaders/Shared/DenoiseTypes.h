#ifndef LANTERN_DENOISE_TYPES_H
#define LANTERN_DENOISE_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define DENOISE_GROUP_SIZE 8
#define DENOISE_WINDOW_RADIUS 3 // of the neighbourhood that tells what the signal is now: 7×7 pixels

// What a pixel shows, for those that come back to it: see Library/History.glsl.
struct FSurfaceConstants
{
	FPassConstants Pass;
	uint Depth, Normals; // sampled indices
	uint Motion;         // sampled index, or NO_TEXTURE: no object is known
	uint Output;         // storage index
};
LANTERN_ASSERT_SIZE(FSurfaceConstants, 32);

// Sampled indices but for outputs. Histories: mean, standard deviation of one frame's noise, frames that the mean is worth,
// mean of the neighbourhood. Of three channels: the mean and the frames; the others go to a second texture.
struct FTemporalConstants
{
	FPassConstants Pass;
	uint Signal;
	uint Surface;
	uint Motion, PreviousSurface, History; // NO_TEXTURE: nothing to reproject
	uint Moments;                          // of three channels only
	uint Extent;                           // WITH_EXTENT only: pixels
	uint OutHistory, OutMoments;           // storage indices
	uint Output;                           // storage index: mean, and its variance
	float MinAlpha;                        // weight of a new frame in a mean that has been accumulated for long
	float ClampSigma;                      // 0: not clamped
	float ChangeSigma;                     // 0: changes are not looked for
	float NoiseAlpha;                      // weight of a new frame in the estimate of the noise
	float Resampling;                      // how much is made of what resampling a history that is not smooth may do to it
	float RaysPerPixel;                    // of visibility: that a frame's value is the mean of
};
LANTERN_ASSERT_SIZE(FTemporalConstants, 80);

struct FFilterConstants
{
	FPassConstants Pass;
	uint Input;   // sampled index: mean, and its variance
	uint Surface; // sampled index
	uint Output;  // storage index
	uint Step;    // pixels between taps
	float SigmaValue;
	float SigmaNormal;
	float SigmaDepth;
	float ReachExtent; // WITH_EXTENT only: standard deviation of the reach, in extents
};
LANTERN_ASSERT_SIZE(FFilterConstants, 48);

LANTERN_SHARED_END

#endif
