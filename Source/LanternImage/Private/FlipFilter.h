// The spatial filters of FLIP, separated into rows and columns (sections 4.1.1 and 4.2 of the 2020 paper).
#pragma once

#include <vector>

#include "LanternImage/Image.h"

namespace Lantern
{

/// 2 · radius + 1 weights.
using FFlipKernel = std::vector<float>;

/// Weights along one axis; the two-dimensional filters are products of these.
struct FFlipKernels
{
	/// Contrast sensitivity to achromatic, red-green and blue-yellow detail. The last is a sum of two Gaussians.
	FFlipKernel Achromatic, RedGreen, BlueYellow[2];
	/// A Gaussian and its first and second derivative, which find edges and points.
	FFlipKernel Gaussian, Edge, Point;
};

FFlipKernels MakeFlipKernels(float PixelsPerDegree);

/// The maps that are compared, one value per pixel each: Hunt-adjusted CIELAB as the eye resolves it, and feature strengths.
struct FFlipView
{
	std::vector<float> Lab[3];
	std::vector<float> Edge;
	std::vector<float> Point;
};

/// Rows after the horizontal pass; kept between calls to save allocations.
struct FFlipScratch
{
	std::vector<float> Planes[7];
};

/// LinearRgb has three channels in 0 to 1. Beyond the border, the pixels of the border repeat. All workers take part.
void FilterForFlip(const FImage& LinearRgb, const FFlipKernels& Kernels, FFlipScratch& Scratch, FFlipView& OutView);

} // namespace Lantern
