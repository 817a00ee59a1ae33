// Figures of a sequence of frames against references: how wrong, how restless, how late. Pure: images in, numbers out.
//
// F is a frame, R a reference of the same signal, A and B its independent halves. A figure that does not apply, or that
// has nothing to be measured on, is absent. Images must have one size and count of channels; pixels in which any of them
// is not finite are left out, sums are in double precision.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "LanternImage/Image.h"
#include "LanternMeasure/SignalReference.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

/// mean((F − A)(F − B) / (R² + 0.01)) over pixels and channels, R = (A + B) / 2: the relative squared error without the
/// noise of the reference, which in mean((F − R)² / …) would be added to every method alike. Zero for a perfect frame on
/// average; a little below zero by chance. R's noise still is in the divisor: where R is a handful of samples of something
/// that is mostly 0, the figure is too large, for all methods alike.
std::optional<double> ComputeUnbiasedRelMse(const FImage& F, const FSignalReference& R);

/// Mean FLIP of F against R.Mean: LDR-FLIP for signals in 0 to 1, HDR-FLIP for radiance. OutMap may be null.
std::optional<double> ComputeSignalFlip(ESignal Signal, const FImage& F, const FImage& R, FImage* OutMap = nullptr);

/// σ: restlessness of frames in which nothing changes. sqrt(mean over pixels and channels of the variance over the frames)
/// / mean over pixels, channels and frames. The variance is the unbiased one (n − 1).
class FTemporalDeviation
{
public:
	void Add(const FImage& F);
	uint32_t GetFrameCount() const { return Frames; }
	/// Absent: fewer than two frames, or a mean of zero.
	std::optional<double> GetSigma() const;
	/// Pixel's standard deviation over the frames, mean of the channels. Empty before the second frame.
	FImage GetMap() const;

private:
	uint32_t Frames = 0;
	uint32_t Width = 0, Height = 0, Channels = 0;
	std::vector<double> Mean, SquareSum; // Welford 1962
	std::vector<uint8_t> Broken;         // not finite in some frame
};

/// How much of Old is still in F, where New is what should be there: the projection of F − New on Old − New,
///   Σ (F − New.A)(Old.B − New.B) / Σ (Old.A − New.A)(Old.B − New.B),
/// which the references' noise biases neither above nor below the line. 1: F is Old, 0: F is New (or New and noise).
/// Absent: Old and New do not differ (relative to New, by less than 1e-4 in the mean square, or than their noise), or F's noise
/// leaves a standard error above 0.05.
std::optional<double> ComputeProjection(const FImage& F, const FSignalReference& New, const FSignalReference& Old);

/// Frames to 90 %: the first frame after the switch (from 1) from which on two frames in turn have a projection of at
/// most 0.1. Feed in order.
class FFramesTo90
{
public:
	static constexpr double Threshold = 0.1;
	void Add(double Projection);
	bool IsDone() const { return Answer.has_value(); }
	std::optional<uint32_t> Get() const { return Answer; }
	uint32_t GetFrameCount() const { return Frames; }

private:
	uint32_t Frames = 0, Below = 0;
	std::optional<uint32_t> Answer;
};

/// Light where there should be none: mean of F over pixels whose reference is below 1e-3 of the reference's mean (in every
/// channel), over the reference's mean. Absent: fewer than 16 such pixels, or a black reference.
std::optional<double> ComputeLeak(const FImage& F, const FImage& R);

/// Middle value, of an even count the upper; absent for none.
std::optional<double> ComputeMedian(std::vector<double> Values);

} // namespace Lantern
