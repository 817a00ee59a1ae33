#ifndef LANTERN_DENOISE_TYPES_H
#define LANTERN_DENOISE_TYPES_H

#include "SettledTypes.h"

LANTERN_SHARED_BEGIN

#define DENOISE_GROUP_SIZE 8 // threads in x and y
#define DENOISE_VISIBILITY_GROUP_SIZE 16 // of accumulation: pixels around a group are loaded again; colours would take too much memory
#define DENOISE_WINDOW_RADIUS 3 // pixels; the signal's range in this frame comes from a window of 7×7

// How much chance is in a colour: its fourth channel, see FDenoiseInputs::Signal.
#define CHANCE_NONE 0.0
#define CHANCE_SOME 1.0
#define CHANCE_OF_OTHERS 2.0 // the mean of other pixels stands for it
#define CHANCE_OF_MANY 3.0   // chosen of many
#define CHANCE_OF_NOBODY 4.0 // nothing was asked of dim emitters in this frame
#define CHANCE_OF_SEVERAL 8.0 // and what is above it: the value is the mean of so many, each with the chance of others' one

// Constants of Denoise/Surface.comp, which packs the surface that each pixel shows (Library/History.glsl).
struct FSurfaceConstants
{
	FPassConstants Pass;
	uint Depth, Normals;  // sampled indices
	uint Motion;          // sampled index; NO_TEXTURE: objects are unknown, and PreviousSurface is NO_TEXTURE as well
	uint PreviousSurface; // sampled index; NO_TEXTURE: there is nothing to reproject
	uint Output, OutReprojection; // storage indices
	uint PreviousAnchors; // sampled index; NO_TEXTURE: there are none
	uint OutAnchors;      // storage index
};
LANTERN_ASSERT_SIZE(FSurfaceConstants, 48);

// Constants of Denoise/Temporal.comp and TemporalKnown.comp. Inputs are sampled indices, outputs are storage indices.
// A history of one channel holds the mean, one frame's noise (standard deviation), the frames that the mean is worth, and the
// neighbourhood's mean. With three channels it holds the mean and the frames; a second texture, Moments, holds the rest.
struct FTemporalConstants
{
	FPassConstants Pass;
	uint Signal; // a mean over the frame's rays
	uint Surface;
	uint Motion, History; // NO_TEXTURE, both: nothing to reproject
	uint PreviousSurface; // of three channels only where the previous frame had another size; else NO_TEXTURE
	uint Reprojection;    // one channel only
	uint Moments;                          // three channels only
	// WITH_EXTENT only. x: width of the transition (penumbra), pixels; 0: unknown. y: rays of the pixel; 0 or absent: RaysPerPixel.
	uint Extent;
	uint OutHistory, OutMoments;           // written for the next frame; OutMoments: three channels only
	uint Output;                           // mean, and its variance
	float MinAlpha;                        // least weight of a new frame, 0 to 1
	float ClampSigma;                      // range of the clamp, in the window's standard deviations; 0: not clamped
	float ChangeSigma;                     // change that shortens the history, in standard errors; 0: changes are not looked for
	float Resampling;                      // one channel only: share of the history's second differences that counts as error of resampling
	float RaysPerPixel;                    // one channel only: number of rays of which a frame's value is the mean
	FAddress Casters; // FMovedCaster[CasterCount]: those that moved in the last frames
	uint CasterCount;
	uint bChangesKnown; // 1: the signal changes only where these shadows fall, or on surfaces that move. 0: it may anywhere
	float CasterSpread; // of a half shadow's border, metres per metre
	uint OutView;       // storage index of a picture of the history (r.RT.Debug.View), or NO_TEXTURE
	uint bViewChange;   // 1: it shows what was dropped of the history; 0: how much the history is worth
	uint Change;        // three channels only: FDenoiseInputs::Change; NO_TEXTURE: nothing is known to have changed
	uint ChangedShare;  // three channels only: FDenoiseInputs::ChangedShare, or NO_TEXTURE
	uint Anchors;       // three channels only: see Library/History.glsl
};
LANTERN_ASSERT_SIZE(FTemporalConstants, 120);

// Constants of Denoise/Filter.comp.
struct FFilterConstants
{
	FPassConstants Pass;
	uint Input;        // sampled index: mean, and its variance
	uint Surface;      // sampled index
	uint Output;       // storage index
	uint Step;         // pixels between taps
	float SigmaValue;  // edge stop on the signal, in standard deviations
	float SigmaNormal; // exponent of the cosine between normals
	float SigmaDepth;  // edge stop on the distance to the neighbour's plane, in pixel footprints
	float ReachExtent; // WITH_EXTENT only: standard deviation of the reach, in extents
	uint SecondInput, SecondOutput; // PAIR only, as Input and Output
	uint Reach;        // WITH_REACH only: sampled index: FDenoiseInputs::Reach
	uint Pad;
};
LANTERN_ASSERT_SIZE(FFilterConstants, 64);

LANTERN_SHARED_END

#endif
