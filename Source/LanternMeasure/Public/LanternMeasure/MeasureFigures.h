// Figures of a sequence of frames against references: error, temporal noise and lag. These are pure functions of images.
//
// F is a frame, R a reference of its signal, A and B are R's independent halves. A figure that does not apply, or has nothing
// to be measured on, is absent. Images must have one size and number of channels. Pixels in which any image is not finite are
// left out. Sums are in double precision.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "LanternImage/Image.h"
#include "LanternMeasure/SignalReference.h"
#include "LanternSignals/Signals.h"

namespace Lantern
{

/// Computes the relative squared error mean((F − A)(F − B) / (R² + 0.01)) over pixels and channels, with R = (A + B) / 2. It
/// excludes the noise of the reference, which mean((F − R)² / …) would add to every method alike. The mean for a perfect frame
/// is zero; a figure may be slightly negative by chance. The divisor still contains R's noise. If R has few samples of a signal
/// that is mostly 0, the figure is therefore too large, for all methods alike.
std::optional<double> ComputeUnbiasedRelMse(const FImage& F, const FSignalReference& R);

/// Computes the mean FLIP of F against R: LDR-FLIP for signals in 0 to 1, HDR-FLIP for radiance. OutMap may be null.
std::optional<double> ComputeSignalFlip(ESignal Signal, const FImage& F, const FImage& R, FImage* OutMap = nullptr);

/// σ: temporal noise of frames in which nothing changes. It is sqrt(mean over pixels and channels of the variance over frames) /
/// (mean over pixels, channels and frames). The variance is the unbiased one (n − 1).
class FTemporalDeviation
{
public:
	void Add(const FImage& F);
	uint32_t GetFrameCount() const { return Frames; }
	/// Absent for fewer than two frames, or a mean of zero.
	std::optional<double> GetSigma() const;
	/// Returns the standard deviation of each pixel over the frames, averaged over channels. Empty before the second frame.
	FImage GetMap() const;

private:
	uint32_t Frames = 0;
	uint32_t Width = 0, Height = 0, Channels = 0;
	std::vector<double> Mean, SquareSum; // Welford 1962
	std::vector<uint8_t> Broken;         // not finite in some frame
};

/// Measures how much of the reference Old is still in F, which should show New. It is the projection of F − New on Old − New:
///   Σ (F − New.A)(Old.B − New.B) / Σ (Old.A − New.A)(Old.B − New.B).
/// The noise of the references biases neither sum. 1: F equals Old; 0: F equals New, perhaps with noise. The figure is absent
/// if Old and New differ by less than their noise, or by less than 1e-4 of New in the mean square. It is also absent if F's
/// noise leaves a standard error above 0.05.
std::optional<double> ComputeProjection(const FImage& F, const FSignalReference& New, const FSignalReference& Old);

/// Frames to 90 %: the first frame after a switch, counted from 1, that begins two consecutive frames with a projection of at
/// most 0.1. Add must be called in order.
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

/// Measures leaked light. It is the mean of F over dark pixels, divided by the mean of the reference. A pixel is dark if every
/// channel of the reference is below 1e-3 of that mean. Absent for fewer than 16 such pixels, or a black reference.
std::optional<double> ComputeLeak(const FImage& F, const FImage& R);

/// Returns the median, the upper one of an even count. Absent if Values is empty.
std::optional<double> ComputeMedian(std::vector<double> Values);

} // namespace Lantern
