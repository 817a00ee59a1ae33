// Figures of one image, and of masks: what image tests assert.
#pragma once

#include <cstdint>
#include <vector>

#include "LanternImage/Image.h"

namespace Lantern
{

/// Rec.709 luminance, or luma if the values are display values.
inline float GetLuminance(float R, float G, float B) { return 0.2126f * R + 0.7152f * G + 0.0722f * B; }
/// Luminance of a pixel. In a grey image it is the value itself.
float GetLuminance(const FImage& Image, uint32_t X, uint32_t Y);

/// A pixel is finite if its colour channels are.
bool IsPixelFinite(const FImage& Image, size_t PixelIndex);
uint64_t CountNonFinitePixels(const FImage& Image);

/// Means over the finite pixels, in double precision; NaN if there is none.
struct FImageMeans
{
	double Channel[4] = {}; ///< 0 for channels that the image lacks
	double Luminance = 0.0;
	double MaxLuminance = 0.0;
	uint64_t PixelCount = 0; ///< finite pixels
};
FImageMeans ComputeMeans(const FImage& Image);
/// Means over the pixels [X0, X1) × [Y0, Y1), cut to the image.
FImageMeans ComputeMeans(const FImage& Image, uint32_t X0, uint32_t Y0, uint32_t X1, uint32_t Y1);

/// Luminance means of BlockSize × BlockSize blocks, row by row. Blocks at the right and lower edge are smaller. A block without a finite
/// pixel is NaN.
std::vector<double> ComputeBlockMeans(const FImage& Image, uint32_t BlockSize);

/// The value at Fraction (0 to 1) of the sorted Values, linearly interpolated between ranks; NaN for no values. Values must be finite.
double ComputePercentile(std::vector<double> Values, double Fraction);

/// A mask with 1 for pixels whose luminance is above Threshold, or below it if bBelow. Other pixels and non-finite ones are 0.
std::vector<uint8_t> MakeLuminanceMask(const FImage& Image, float Threshold, bool bBelow = false);

/// Intersection over union of two masks of equal length, 0 to 1. It is 1 for two empty masks.
double ComputeMaskOverlap(const std::vector<uint8_t>& A, const std::vector<uint8_t>& B);

} // namespace Lantern
