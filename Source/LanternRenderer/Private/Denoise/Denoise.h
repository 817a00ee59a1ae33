// One filter for all noisy signals: accumulates over time where the surface was seen before, estimates the variance that
// is left, and smooths by it along surfaces (Schied et al. 2017, "Spatiotemporal Variance-Guided Filtering"; Dammertz et
// al. 2010, "Edge-Avoiding À-Trous Wavelet Transform"). History is clamped to what the neighbourhood says now (Salvi 2016,
// "An Excursion in Temporal Supersampling"), so that it follows shadows that move.
//
// Nothing that is not a number lives on: signals, histories and guides are tested where they are loaded, and what fails
// counts as not there.
#pragma once

#include "LanternRenderer/Frame.h"

namespace Lantern
{

struct FDenoiseSettings
{
	float HistorySeconds = 0.5f; ///< time constant of the accumulation; ≥ 0, 0: none
	float ClampSigma = 7.0f;     ///< history is kept within the neighbourhood's mean ± this many σ; 0: not clamped
	/// Accumulation starts anew where the neighbourhood's mean is off that over time by more than this many of its standard
	/// errors; 0: never.
	float ChangeSigma = 2.0f;
	/// How much of the difference between a history's texels counts as error where it is resampled between them.
	float Resampling = 0.5f;
	uint32_t Passes = 4;       ///< of the wavelet, 0 to 5; together they reach 2^Passes − 1 pixels
	float SigmaValue = 4.0f;   ///< edge stop on the signal, in standard deviations
	float ReachExtent = 0.25f; ///< standard deviation of the wavelet's reach where extents are known, in extents
	float SigmaNormal = 64.0f; ///< exponent of the cosine between normals
	float SigmaDepth = 1.0f;   ///< edge stop on the distance to the neighbour's plane, in pixel footprints
};

struct FDenoiseInputs
{
	const char* Name = ""; ///< of the signal; names passes and histories, constant over frames
	/// With at least ShaderRead: a pixel's mean over the frame's rays. R16_FLOAT: visibility, each ray's is 0 or 1.
	/// RGBA16_FLOAT: a colour, ≥ 0.
	FGraphTexture Signal;
	uint32_t RaysPerPixel = 1; ///< of visibility
	/// Of visibility, R16_FLOAT: how wide the transition from what is seen to what is not is where the pixel shows a part of
	/// it, pixels; 0: the pixel knows of none. Invalid: as wide as can be.
	FGraphTexture Extent;
	FGraphTexture Depth, Normals, Motion; ///< as in FGBuffer; Motion may be invalid
	FDenoiseSettings Settings;
};

/// The filtered signal, of the same description; where there is no surface, the signal as it is. Passes are named
/// "<Name>Temporal", "<Name>Filter<I>"; what is shared with other signals is "Surface" and, where the host has no motion,
/// "CameraMotion". On an error, which the context then has, the signal itself.
FGraphTexture AddDenoisePasses(FFrameContext& Context, const FDenoiseInputs& Inputs);

} // namespace Lantern
