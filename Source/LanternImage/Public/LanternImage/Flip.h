// FLIP: how strongly a viewer who flips between two images sees them differ.
//
// Display images: Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images".
//
// Radiance: Andersson et al. 2021, "Visualizing Errors in Rendered High Dynamic Range Images".
#pragma once

#include <cstdint>

#include <vector>

#include "LanternImage/Image.h"

namespace Lantern
{

/// A 0.7 m wide 3840-pixel display seen from 0.7 m: 3840 · π / 180.
inline constexpr float DefaultPixelsPerDegree = 67.0206f;

struct FFlipResult
{
	FImage Map; ///< one channel, 0 (no difference) to 1
	/// Exposures of the radiance metric, in stops; 0 for display images.
	float StartExposure = 0.0f;
	float StopExposure = 0.0f;
	uint32_t ExposureCount = 0;
};

/// Compares two images of one size, not empty, with 1 to 4 channels. Alpha is ignored. Display images are decoded; linear images count
/// as display-linear and are clamped to 0 to 1. Values must be finite. The result is symmetric. All workers take part.
FFlipResult ComputeFlip(const FImage& Test, const FImage& Reference, float PixelsPerDegree = DefaultPixelsPerDegree);

/// Compares two linear images at several exposures, through the ACES curve, and keeps the largest error. The exposures range from one that
/// shows the brightest pixel of Reference to one that shows its median. Negative values count as 0. The result is not symmetric.
FFlipResult ComputeHdrFlip(const FImage& Test, const FImage& Reference, float PixelsPerDegree = DefaultPixelsPerDegree);

/// Mean of the errors of an error map, and the error that halves their sum (the paper's weighted median). Pixels with a Mask of 0 are left
/// out; an empty Mask leaves none out. NaN if no pixel is left.
struct FFlipPooled
{
	double Mean = 0.0;
	double WeightedMedian = 0.0;
};
FFlipPooled PoolFlip(const FImage& Map, const std::vector<uint8_t>& Mask = {});

} // namespace Lantern
