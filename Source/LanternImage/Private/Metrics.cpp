// Compares two images by every metric.
#include "LanternImage/Metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "LanternImage/ImageStatistics.h"

namespace Lantern
{

namespace
{

constexpr double RelMseFloor = 0.01;
constexpr uint32_t BlockSize = 16;
constexpr double BlockFloor = 0.01;
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

FRTStatus CheckComparable(const FImage& A, const FImage& B)
{
	if (A.IsEmpty() || B.IsEmpty()) { return FRTStatus::Error(ERTResult::InvalidArgument, "an image without pixels cannot be compared"); }
	if (A.Width != B.Width || A.Height != B.Height)
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "the images differ in size: %u x %u and %u x %u", A.Width, A.Height, B.Width, B.Height);
	}
	if (A.Space != B.Space)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument,
		    "one image holds radiance (EXR, PFM), the other a display picture (PNG): their values "
		    "cannot be compared");
	}
	return FRTStatus::Success();
}

/// The two images in three channels, and which pixels count.
struct FPair
{
	FImage A;
	FImage B;
	std::vector<uint8_t> Mask; ///< 1: finite in both

	bool Counts(size_t Pixel) const { return Mask[Pixel] != 0; }
};

FPair MakePair(const FImage& A, const FImage& B, uint64_t OutNonFinite[2])
{
	FPair Pair = {MakeColorImage(A), MakeColorImage(B), std::vector<uint8_t>(A.GetPixelCount(), 1)};
	for (size_t Pixel = 0; Pixel < Pair.Mask.size(); ++Pixel)
	{
		const bool bFinite[2] = {IsPixelFinite(Pair.A, Pixel), IsPixelFinite(Pair.B, Pixel)};
		OutNonFinite[0] += bFinite[0] ? 0 : 1;
		OutNonFinite[1] += bFinite[1] ? 0 : 1;
		Pair.Mask[Pixel] = bFinite[0] && bFinite[1];
		for (size_t Index = Pixel * 3; Index < Pixel * 3 + 3; ++Index)
		{
			float& ValueA = Pair.A.Pixels[Index];
			float& ValueB = Pair.B.Pixels[Index];
			if (!bFinite[0]) { ValueA = bFinite[1] ? ValueB : 0.0f; }
			if (!bFinite[1]) { ValueB = bFinite[0] ? ValueA : 0.0f; }
		}
	}
	return Pair;
}

/// 0/0 is equal, hence 1; anything else over 0 is infinite.
double ComputeRatio(double A, double B) { return A == B && !std::isnan(A) ? 1.0 : A / B; }

void ComputeErrors(const FPair& Pair, FImageMetrics& OutMetrics)
{
	double Squares = 0.0;
	double RelativeSquares = 0.0;
	double Sums[2][3] = {};
	double Peak = -std::numeric_limits<double>::infinity();
	uint64_t Count = 0;
	for (size_t Pixel = 0; Pixel < Pair.Mask.size(); ++Pixel)
	{
		if (!Pair.Counts(Pixel)) { continue; }
		for (size_t Channel = 0; Channel < 3; ++Channel)
		{
			const double A = static_cast<double>(Pair.A.Pixels[Pixel * 3 + Channel]);
			const double B = static_cast<double>(Pair.B.Pixels[Pixel * 3 + Channel]);
			const double Square = (A - B) * (A - B);
			Squares += Square;
			RelativeSquares += Square / (B * B + RelMseFloor);
			Sums[0][Channel] += A;
			Sums[1][Channel] += B;
			Peak = std::max(Peak, B);
			++Count;
		}
	}
	const double Scale = Count > 0 ? 1.0 / static_cast<double>(Count) : NaN;
	OutMetrics.Mse = Squares * Scale;
	OutMetrics.Rmse = std::sqrt(OutMetrics.Mse);
	OutMetrics.RelMse = RelativeSquares * Scale;
	if (Pair.B.Space == EImageSpace::Display) { Peak = 1.0; }
	OutMetrics.Psnr = 10.0 * std::log10(Peak * Peak / OutMetrics.Mse);
	if (OutMetrics.Mse == 0.0) { OutMetrics.Psnr = std::numeric_limits<double>::infinity(); }
	for (size_t Channel = 0; Channel < 3; ++Channel)
	{
		OutMetrics.MeanRatio[Channel] = Count > 0 ? ComputeRatio(Sums[0][Channel], Sums[1][Channel]) : NaN;
	}
}

void ComputeBlocks(const FPair& Pair, FImageMetrics& OutMetrics)
{
	// A pixel that is left out must be so in both images: as NaN it is skipped by the block means.
	FImage Masked[2] = {Pair.A, Pair.B};
	for (size_t Pixel = 0; Pixel < Pair.Mask.size(); ++Pixel)
	{
		if (!Pair.Counts(Pixel)) { Masked[0].Pixels[Pixel * 3] = Masked[1].Pixels[Pixel * 3] = std::numeric_limits<float>::quiet_NaN(); }
	}
	const std::vector<double> MeansA = ComputeBlockMeans(Masked[0], BlockSize);
	const std::vector<double> MeansB = ComputeBlockMeans(Masked[1], BlockSize);
	std::vector<double> Errors;
	for (size_t Block = 0; Block < MeansA.size(); ++Block)
	{
		if (!std::isnan(MeansB[Block]))
		{
			Errors.push_back(std::abs(MeansA[Block] - MeansB[Block]) / (std::max(MeansB[Block], 0.0) + BlockFloor));
		}
	}
	OutMetrics.Block16Median = ComputePercentile(Errors, 0.5);
	OutMetrics.Block16P95 = ComputePercentile(std::move(Errors), 0.95);
}

} // namespace

FRTStatus CompareImages(const FImage& A, const FImage& B, FImageMetrics& OutMetrics)
{
	if (FRTStatus Status = CheckComparable(A, B); !Status) { return Status; }
	OutMetrics = FImageMetrics();
	const FPair Pair = MakePair(A, B, OutMetrics.NonFinite);
	ComputeErrors(Pair, OutMetrics);
	ComputeBlocks(Pair, OutMetrics);
	OutMetrics.FlipResult = B.Space == EImageSpace::Linear ? ComputeHdrFlip(Pair.A, Pair.B) : ComputeFlip(Pair.A, Pair.B);
	const FFlipPooled Pooled = PoolFlip(OutMetrics.FlipResult.Map, Pair.Mask);
	OutMetrics.Flip = Pooled.Mean;
	OutMetrics.FlipWeightedMedian = Pooled.WeightedMedian;
	return FRTStatus::Success();
}

} // namespace Lantern
