// Figures of one image, and of masks: what image tests assert.
#pragma once

#include <cstdint>
#include <vector>

#include "LanternImage/Image.h"

namespace Lantern
{

/// Rec.709 luminance; of display values: luma.
inline float GetLuminance(float R, float G, float B) { return 0.2126f * R + 0.7152f * G + 0.0722f * B; }
/// Luminance of a pixel; grey images: the value itself.
float GetLuminance(const FImage& Image, uint32_t X, uint32_t Y);

/// A pixel is finite if its colour channels are.
bool IsPixelFinite(const FImage& Image, size_t PixelIndex);
uint64_t CountNonFinitePixels(const FImage& Image);

/// Mean over the finite pixels, in double precision; NaN where there is none.
struct FImageMeans
{
	double Channel[4] = {}; ///< of channels that the image lacks: 0
	double Luminance = 0.0;
	double MaxLuminance = 0.0;
	uint64_t PixelCount = 0; ///< finite ones
};
FImageMeans ComputeMeans(const FImage& Image);
/// Of the pixels [X0, X1) × [Y0, Y1), cut to the image.
FImageMeans ComputeMeans(const FImage& Image, uint32_t X0, uint32_t Y0, uint32_t X1, uint32_t Y1);

/// Luminance means of BlockSize × BlockSize blocks, row by row, blocks at the right and lower edge being smaller.
/// A block without a finite pixel is NaN.
std::vector<double> ComputeBlockMeans(const FImage& Image, uint32_t BlockSize);

/// Percentile in 0 to 1, linearly interpolated between ranks; NaN for no values. Values must be finite.
double ComputePercentile(std::vector<double> Values, double Fraction);

/// Pixels whose luminance is above (bBelow: below) Threshold: a mask of 0 and 1. Non-finite pixels are 0.
std::vector<uint8_t> MakeLuminanceMask(const FImage& Image, float Threshold, bool bBelow = false);

/// Intersection over union of two masks of equal length, in 0 to 1; two empty masks agree: 1.
double ComputeMaskOverlap(const std::vector<uint8_t>& A, const std::vector<uint8_t>& B);

} // namespace Lantern
