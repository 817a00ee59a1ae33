// Comparison of an image with a reference.
#pragma once

#include <cstdint>

#include "LanternImage/Flip.h"
#include "LanternImage/Image.h"
#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// Figures are over the colour channels. Alpha is ignored, and grey counts as three equal channels. Radiance (EXR, PFM) is compared as it
/// is. Display pictures (PNG) are compared by their stored values in 0 to 1; only FLIP decodes them.
///
/// A pixel with a NaN or an infinity in a channel is counted in NonFinite. It is left out of both images in every other figure, so that it
/// neither hides nor swamps the rest. If no pixel is left, every figure is NaN. The filters of FLIP look at neighbours. There such a pixel
/// first takes the value of the other image, or 0 if that is not finite either.
struct FImageMetrics
{
	uint64_t NonFinite[2] = {}; ///< pixels of A and of B
	double Mse = 0.0;
	double Rmse = 0.0;
	double RelMse = 0.0; ///< mean of (a − b)² / (b² + 0.01)
	/// dB. The peak is 1 for display pictures and the largest value of the reference for radiance. Infinite for equal images.
	double Psnr = 0.0;
	double Flip = 0.0; ///< mean of FLIP; HDR-FLIP for radiance
	double FlipWeightedMedian = 0.0;
	double MeanRatio[3] = {}; ///< mean of A / mean of B; 1 where both are 0
	/// Median and 95th percentile of |a − b| / (b + 0.01), where a and b are luminance means of 16 × 16 blocks. Blocks cut by the right
	/// or lower edge count like others. A negative b counts as 0 in the denominator.
	double Block16Median = 0.0;
	double Block16P95 = 0.0;
	FFlipResult FlipResult; ///< the error map and the exposures
};

/// Compares A with the reference B. InvalidArgument if an image is empty, if sizes differ, or if one holds radiance and the other a
/// display picture.
FRTStatus CompareImages(const FImage& A, const FImage& B, FImageMetrics& OutMetrics);

} // namespace Lantern
