// Comparison of an image with a reference.
#pragma once

#include <cstdint>

#include "LanternImage/Flip.h"
#include "LanternImage/Image.h"
#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// All over the colour channels; alpha is ignored and grey counts as three equal channels. Radiance (EXR, PFM) is
/// compared as it is, display pictures (PNG) by their stored values in 0 to 1, except for FLIP, which decodes them.
///
/// A pixel with a NaN or an infinity in one of its channels, in either image, is counted in NonFinite and left out
/// of both images in every other figure, so that one broken pixel neither hides nor swamps the rest. Where no
/// pixel is left, every figure is NaN. For FLIP, whose filters look at neighbours, such a pixel first takes the
/// other image's value (0 where both are broken).
struct FImageMetrics
{
	uint64_t NonFinite[2] = {}; ///< pixels of A and of B
	double Mse = 0.0;
	double Rmse = 0.0;
	double RelMse = 0.0; ///< mean of (a − b)² / (b² + 0.01)
	/// dB; peak 1 for display pictures, the reference's largest value for radiance. Infinite for equal images.
	double Psnr = 0.0;
	double Flip = 0.0; ///< mean of FLIP; HDR-FLIP for radiance
	double FlipWeightedMedian = 0.0;
	double MeanRatio[3] = {}; ///< mean of A / mean of B; 1 where both are 0
	/// Of |a − b| / (b + 0.01), a and b being luminance means of 16 × 16 blocks. Blocks cut by the right or lower
	/// edge count like others; a negative b counts as 0 in the denominator.
	double Block16Median = 0.0;
	double Block16P95 = 0.0;
	FFlipResult FlipResult; ///< the error map and the exposures
};

/// A against the reference B. InvalidArgument where a size is empty or differs, or where one holds radiance and
/// the other a display picture.
FRTStatus CompareImages(const FImage& A, const FImage& B, FImageMetrics& OutMetrics);

} // namespace Lantern
