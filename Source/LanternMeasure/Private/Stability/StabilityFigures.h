// Figures over parts of pictures. A mask has a byte for each pixel. Pixels with mask 0, or with a value that is not
// finite, are left out. A figure is NaN if no pixel is left.
#pragma once

#include <cstdint>
#include <vector>

#include "LanternMeasure/SignalReference.h"
#include "LanternMeasure/Stability/StabilityStage.h"

namespace Lantern
{

using FPixelMask = std::vector<uint8_t>;

uint64_t CountPixels(const FPixelMask& Mask);
/// Mean over pixels and colour channels.
double MeanOver(const FImage& Image, const FPixelMask& Mask);
double MeanOver(const FImage& Image);
/// mean((F − A)(F − B) / (R² + 0.01)): the reference's own noise is not in it, since its halves are independent.
double RelMseOver(const FImage& F, const FSignalReference& Reference, const FPixelMask& Mask);
/// Mean of frames of one size.
FImage MeanImage(const std::vector<FImage>& Frames);
/// |mean F − mean R| of each quarter of the picture, averaged, over the mean of R: errors of light and lag, not of noise.
double QuarterError(const FImage& F, const FImage& R);
/// Mean over pixels of the standard deviation over the frames, over the mean. An empty mask: all pixels.
double TemporalSigma(const std::vector<FImage>& Frames, const FPixelMask& Mask = {});
FPixelMask MakeFullMask(const FImage& Image);

/// Whether the paths of the method that is in force end in radiance cells.
bool HasRadianceCells();

/// Shots of one view, which keep their pictures from number KeepFrom on.
std::vector<FStabilityShot> RepeatView(const FView& View, size_t Frames, size_t KeepFrom);
/// What FStabilityStage::Play returned, without the pictures that were not kept.
std::vector<FImage> DropUnkept(std::vector<FImage> Frames);
/// Number of frames from First until a mean reaches Level, or falls to it; 1: the frame First itself. NaN: none does.
double CountFramesTo(const std::vector<double>& Means, size_t First, double Level, bool bRise);

} // namespace Lantern
