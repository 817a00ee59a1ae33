// FLIP: how strongly a viewer who flips between two images sees them differ.
//  Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, "FLIP: A Difference Evaluator for
//  Alternating Images" (display images); Andersson, Nilsson, Shirley, Akenine-Möller 2021, "Visualizing Errors in
//  Rendered High Dynamic Range Images" (radiance).
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
	/// Of the radiance metric, in stops; zero for display images.
	float StartExposure = 0.0f;
	float StopExposure = 0.0f;
	uint32_t ExposureCount = 0;
};

/// Images of one size with 1 to 4 channels (alpha is ignored), not empty; display images are decoded, linear ones
/// taken as display-linear and clamped to 0 to 1. Values must be finite. Symmetric. Uses all workers.
FFlipResult ComputeFlip(const FImage& Test, const FImage& Reference, float PixelsPerDegree = DefaultPixelsPerDegree);

/// For linear images: the largest error over exposures that range from one that shows the reference's brightest
/// pixel to one that shows its median, through the ACES curve. Negative values count as 0. Not symmetric.
FFlipResult ComputeHdrFlip(const FImage& Test, const FImage& Reference, float PixelsPerDegree = DefaultPixelsPerDegree);

/// Mean of the errors of an error map, and the error that halves their sum (the paper's weighted median). Pixels
/// where Mask is 0 are left out; an empty mask leaves none out. NaN where no pixel is left.
struct FFlipPooled
{
	double Mean = 0.0;
	double WeightedMedian = 0.0;
};
FFlipPooled PoolFlip(const FImage& Map, const std::vector<uint8_t>& Mask = {});

} // namespace Lantern
