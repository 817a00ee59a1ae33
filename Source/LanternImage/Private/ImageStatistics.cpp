// Means, percentiles and masks of images.
#include "LanternImage/ImageStatistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace Lantern
{

float GetLuminance(const FImage& Image, uint32_t X, uint32_t Y)
{
	return Image.GetColorChannels() == 1 ? Image.At(X, Y, 0) : GetLuminance(Image.At(X, Y, 0), Image.At(X, Y, 1), Image.At(X, Y, 2));
}

bool IsPixelFinite(const FImage& Image, size_t PixelIndex)
{
	const float* Pixel = &Image.Pixels[PixelIndex * Image.Channels];
	return std::all_of(Pixel, Pixel + Image.GetColorChannels(), [](float Value) { return std::isfinite(Value); });
}

uint64_t CountNonFinitePixels(const FImage& Image)
{
	uint64_t Count = 0;
	for (size_t Pixel = 0; Pixel < Image.GetPixelCount(); ++Pixel) { Count += IsPixelFinite(Image, Pixel) ? 0 : 1; }
	return Count;
}

FImageMeans ComputeMeans(const FImage& Image) { return ComputeMeans(Image, 0, 0, Image.Width, Image.Height); }

FImageMeans ComputeMeans(const FImage& Image, uint32_t X0, uint32_t Y0, uint32_t X1, uint32_t Y1)
{
	FImageMeans Means;
	Means.MaxLuminance = -std::numeric_limits<double>::infinity();
	for (uint32_t Y = Y0; Y < std::min(Y1, Image.Height); ++Y)
	{
		for (uint32_t X = X0; X < std::min(X1, Image.Width); ++X)
		{
			if (!IsPixelFinite(Image, static_cast<size_t>(Y) * Image.Width + X)) { continue; }
			for (uint32_t Channel = 0; Channel < Image.Channels; ++Channel)
			{
				Means.Channel[Channel] += static_cast<double>(Image.At(X, Y, Channel));
			}
			const double Luminance = static_cast<double>(GetLuminance(Image, X, Y));
			Means.Luminance += Luminance;
			Means.MaxLuminance = std::max(Means.MaxLuminance, Luminance);
			++Means.PixelCount;
		}
	}
	const double NaN = std::numeric_limits<double>::quiet_NaN();
	const double Scale = Means.PixelCount > 0 ? 1.0 / static_cast<double>(Means.PixelCount) : NaN;
	for (uint32_t Channel = 0; Channel < Image.Channels; ++Channel) { Means.Channel[Channel] *= Scale; }
	Means.Luminance *= Scale;
	if (Means.PixelCount == 0) { Means.MaxLuminance = NaN; }
	return Means;
}

std::vector<double> ComputeBlockMeans(const FImage& Image, uint32_t BlockSize)
{
	assert(BlockSize > 0);
	std::vector<double> Means;
	for (uint32_t Y = 0; Y < Image.Height; Y += BlockSize)
	{
		for (uint32_t X = 0; X < Image.Width; X += BlockSize)
		{
			Means.push_back(ComputeMeans(Image, X, Y, X + BlockSize, Y + BlockSize).Luminance);
		}
	}
	return Means;
}

double ComputePercentile(std::vector<double> Values, double Fraction)
{
	if (Values.empty()) { return std::numeric_limits<double>::quiet_NaN(); }
	std::sort(Values.begin(), Values.end());
	const double Rank = std::clamp(Fraction, 0.0, 1.0) * static_cast<double>(Values.size() - 1);
	const size_t Below = static_cast<size_t>(Rank);
	const size_t Above = std::min(Below + 1, Values.size() - 1);
	return Values[Below] + (Rank - static_cast<double>(Below)) * (Values[Above] - Values[Below]);
}

std::vector<uint8_t> MakeLuminanceMask(const FImage& Image, float Threshold, bool bBelow)
{
	std::vector<uint8_t> Mask(Image.GetPixelCount(), 0);
	for (uint32_t Y = 0; Y < Image.Height; ++Y)
	{
		for (uint32_t X = 0; X < Image.Width; ++X)
		{
			const size_t Pixel = static_cast<size_t>(Y) * Image.Width + X;
			const float Luminance = GetLuminance(Image, X, Y);
			Mask[Pixel] = IsPixelFinite(Image, Pixel) && (bBelow ? Luminance < Threshold : Luminance > Threshold);
		}
	}
	return Mask;
}

double ComputeMaskOverlap(const std::vector<uint8_t>& A, const std::vector<uint8_t>& B)
{
	assert(A.size() == B.size());
	size_t Both = 0;
	size_t Either = 0;
	for (size_t Index = 0; Index < A.size(); ++Index)
	{
		Both += (A[Index] != 0 && B[Index] != 0) ? 1 : 0;
		Either += (A[Index] != 0 || B[Index] != 0) ? 1 : 0;
	}
	return Either == 0 ? 1.0 : static_cast<double>(Both) / static_cast<double>(Either);
}

} // namespace Lantern
