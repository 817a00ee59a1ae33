// FLIP of display images, HDR-FLIP of radiance, and the pooling of error maps.
#include "LanternImage/Flip.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "FlipColor.h"
#include "FlipFilter.h"
#include "LanternCore/Tasks/Tasks.h"
#include "LanternImage/ImageStatistics.h"
#include "LanternImage/ToneMap.h"

namespace Lantern
{

namespace
{

constexpr size_t PixelGrain = 8192;

/// Luminance that the first exposure gives the brightest pixel and the last one the median pixel.
constexpr double TargetLuminance = 0.85;

/// A median that is darker counts as this many stops below the maximum. Without a bound, a mostly black reference would ask for any number
/// of exposures.
constexpr double MostStops = 24.0;

// ACES curve of the paper: that of ToneMap.h with its input scaled by 0.6.
constexpr double CurveInput = 0.6;

float ToneMapForFlip(float Linear) { return ToneMapAces(static_cast<float>(CurveInput) * Linear); }

/// Where the curve reaches TargetLuminance: the positive root of a quadratic equation.
double InvertCurve()
{
	const double A = 2.51 - TargetLuminance * 2.43;
	const double B = 0.03 - TargetLuminance * 0.59;
	const double C = -TargetLuminance * 0.14;
	return (-B + std::sqrt(B * B - 4.0 * A * C)) / (2.0 * A) / CurveInput;
}

/// Compares pairs of display-linear images; keeps its buffers between exposures.
class FFlipComparer
{
public:
	explicit FFlipComparer(float PixelsPerDegree) : Kernels(MakeFlipKernels(PixelsPerDegree)) {}

	/// Raises OutMap to the error of this pair where that is larger.
	void Accumulate(const FImage& Test, const FImage& Reference, FImage& OutMap)
	{
		FilterForFlip(Test, Kernels, Scratch, TestView);
		FilterForFlip(Reference, Kernels, Scratch, ReferenceView);
		ParallelFor(OutMap.GetPixelCount(), PixelGrain, [&](size_t Begin, size_t End) {
			for (size_t Pixel = Begin; Pixel < End; ++Pixel) { OutMap.Pixels[Pixel] = std::max(OutMap.Pixels[Pixel], ComputeError(Pixel)); }
		});
	}

private:
	float ComputeError(size_t Pixel) const
	{
		const FColor3 A = {TestView.Lab[0][Pixel], TestView.Lab[1][Pixel], TestView.Lab[2][Pixel]};
		const FColor3 B = {ReferenceView.Lab[0][Pixel], ReferenceView.Lab[1][Pixel], ReferenceView.Lab[2][Pixel]};
		const float ColorError = ComputeFlipColorError(A, B);
		const float Strongest = std::max(
		    std::abs(TestView.Edge[Pixel] - ReferenceView.Edge[Pixel]), std::abs(TestView.Point[Pixel] - ReferenceView.Point[Pixel]));
		// q_f = 0.5; 1/√2 since a feature can be full in both directions at once.
		const float FeatureError = std::min(std::sqrt(Strongest * 0.70710678f), 1.0f);
		return std::pow(ColorError, 1.0f - FeatureError);
	}

	FFlipKernels Kernels;
	FFlipScratch Scratch;
	FFlipView TestView;
	FFlipView ReferenceView;
};

/// Every value of a three-channel image through Function, on all workers.
template <class T>
void MapValues(const FImage& Source, FImage& OutResult, const T& Function)
{
	ParallelFor(Source.Pixels.size(), PixelGrain, [&](size_t Begin, size_t End) {
		for (size_t Index = Begin; Index < End; ++Index) { OutResult.Pixels[Index] = Function(Source.Pixels[Index]); }
	});
}

FImage MakeDisplayLinear(const FImage& Image)
{
	FImage Color = MakeColorImage(Image);
	const bool bDecode = Image.Space == EImageSpace::Display;
	MapValues(Color, Color, [bDecode](float Value) {
		const float Clamped = std::clamp(Value, 0.0f, 1.0f);
		return bDecode ? SrgbToLinear(Clamped) : Clamped;
	});
	return Color;
}

struct FExposureRange
{
	double Start = 0.0;
	double Stop = 0.0;
	uint32_t Count = 2;
};

FExposureRange FindExposures(const FImage& Reference)
{
	std::vector<float> Luminances(Reference.GetPixelCount());
	for (size_t Pixel = 0; Pixel < Luminances.size(); ++Pixel)
	{
		const float* Rgb = &Reference.Pixels[Pixel * 3];
		Luminances[Pixel] = GetLuminance(Rgb[0], Rgb[1], Rgb[2]);
	}
	const double Largest = static_cast<double>(*std::max_element(Luminances.begin(), Luminances.end()));
	if (Largest <= 0.0) { return {}; }
	// If the number is even, the metric's own tool takes the upper middle.
	const auto Middle = Luminances.begin() + static_cast<ptrdiff_t>(Luminances.size() / 2);
	std::nth_element(Luminances.begin(), Middle, Luminances.end());
	const double Median = std::max(static_cast<double>(*Middle), Largest * std::exp2(-MostStops));
	const double Target = InvertCurve();
	FExposureRange Range;
	Range.Start = std::log2(Target / Largest);
	Range.Stop = std::log2(Target / Median);
	Range.Count = std::max(2u, static_cast<uint32_t>(std::ceil(Range.Stop - Range.Start)));
	return Range;
}

void CheckPair(const FImage& Test, const FImage& Reference, [[maybe_unused]] float PixelsPerDegree)
{
	assert(!Test.IsEmpty() && PixelsPerDegree > 0.0f);
	assert(Test.Width == Reference.Width && Test.Height == Reference.Height);
	static_cast<void>(Test);
	static_cast<void>(Reference);
}

} // namespace

FFlipResult ComputeFlip(const FImage& Test, const FImage& Reference, float PixelsPerDegree)
{
	CheckPair(Test, Reference, PixelsPerDegree);
	FFlipResult Result;
	Result.Map = FImage(Test.Width, Test.Height, 1);
	FFlipComparer(PixelsPerDegree).Accumulate(MakeDisplayLinear(Test), MakeDisplayLinear(Reference), Result.Map);
	return Result;
}

FFlipResult ComputeHdrFlip(const FImage& Test, const FImage& Reference, float PixelsPerDegree)
{
	CheckPair(Test, Reference, PixelsPerDegree);
	assert(Test.Space == EImageSpace::Linear && Reference.Space == EImageSpace::Linear);
	FImage Images[2] = {MakeColorImage(Test), MakeColorImage(Reference)};
	for (FImage& Image : Images)
	{
		MapValues(Image, Image, [](float Value) { return std::max(Value, 0.0f); });
	}

	const FExposureRange Range = FindExposures(Images[1]);
	FFlipResult Result;
	Result.Map = FImage(Test.Width, Test.Height, 1);
	Result.StartExposure = static_cast<float>(Range.Start);
	Result.StopExposure = static_cast<float>(Range.Stop);
	Result.ExposureCount = Range.Count;

	FFlipComparer Comparer(PixelsPerDegree);
	FImage Mapped[2] = {Images[0], Images[1]};
	for (uint32_t Step = 0; Step < Range.Count; ++Step)
	{
		const double Exposure = Range.Start + (Range.Stop - Range.Start) * Step / (Range.Count - 1);
		const float Scale = static_cast<float>(std::exp2(Exposure));
		for (int Index = 0; Index < 2; ++Index)
		{
			MapValues(Images[Index], Mapped[Index], [Scale](float Value) { return ToneMapForFlip(Scale * Value); });
		}
		Comparer.Accumulate(Mapped[0], Mapped[1], Result.Map);
	}
	return Result;
}

FFlipPooled PoolFlip(const FImage& Map, const std::vector<uint8_t>& Mask)
{
	assert(Mask.empty() || Mask.size() == Map.GetPixelCount());
	std::vector<float> Errors;
	for (size_t Pixel = 0; Pixel < Map.GetPixelCount(); ++Pixel)
	{
		if (Mask.empty() || Mask[Pixel] != 0) { Errors.push_back(Map.Pixels[Pixel]); }
	}
	if (Errors.empty())
	{
		const double NaN = std::numeric_limits<double>::quiet_NaN();
		return {NaN, NaN};
	}
	std::sort(Errors.begin(), Errors.end());
	double Sum = 0.0;
	for (const float Error : Errors) { Sum += static_cast<double>(Error); }
	FFlipPooled Pooled;
	Pooled.Mean = Sum / static_cast<double>(Errors.size());
	double Below = 0.0;
	for (const float Error : Errors)
	{
		Below += static_cast<double>(Error);
		Pooled.WeightedMedian = static_cast<double>(Error);
		if (Below >= 0.5 * Sum) { break; }
	}
	return Pooled;
}

} // namespace Lantern
