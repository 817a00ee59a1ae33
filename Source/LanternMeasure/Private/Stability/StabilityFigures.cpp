// Figures of stability cases over parts of pictures: means, errors, deviations.
#include "Stability/StabilityFigures.h"

#include <cmath>
#include <limits>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternImage/ImageStatistics.h"

namespace Lantern
{

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// F(value, weight index) over finite, unmasked values.
template <class FVisit>
void Visit(const FImage& Image, const FPixelMask& Mask, FVisit Function)
{
	const uint32_t Colors = Image.GetColorChannels();
	for (size_t Pixel = 0; Pixel < Image.GetPixelCount(); ++Pixel)
	{
		if ((!Mask.empty() && !Mask[Pixel]) || !IsPixelFinite(Image, Pixel)) { continue; }
		for (uint32_t C = 0; C < Colors; ++C) { Function(Pixel, Pixel * Image.Channels + C); }
	}
}
} // namespace

uint64_t CountPixels(const FPixelMask& Mask)
{
	uint64_t Count = 0;
	for (const uint8_t Value : Mask) { Count += Value ? 1 : 0; }
	return Count;
}

double MeanOver(const FImage& Image, const FPixelMask& Mask)
{
	double Sum = 0.0;
	uint64_t Count = 0;
	Visit(Image, Mask, [&](size_t, size_t I) {
		Sum += double(Image.Pixels[I]);
		++Count;
	});
	return Count ? Sum / double(Count) : NaN;
}

double MeanOver(const FImage& Image) { return MeanOver(Image, {}); }

double RelMseOver(const FImage& F, const FSignalReference& Reference, const FPixelMask& Mask)
{
	double Sum = 0.0;
	uint64_t Count = 0;
	Visit(F, Mask, [&](size_t, size_t I) {
		const double Value = double(F.Pixels[I]), R = double(Reference.Mean.Pixels[I]);
		Sum += (Value - double(Reference.A.Pixels[I])) * (Value - double(Reference.B.Pixels[I])) / (R * R + 0.01);
		++Count;
	});
	return Count ? Sum / double(Count) : NaN;
}

FImage MeanImage(const std::vector<FImage>& Frames)
{
	FImage Mean = Frames[0];
	for (size_t I = 0; I < Mean.Pixels.size(); ++I)
	{
		double Sum = 0.0;
		for (const FImage& Frame : Frames) { Sum += double(Frame.Pixels[I]); }
		Mean.Pixels[I] = static_cast<float>(Sum / double(Frames.size()));
	}
	return Mean;
}

double QuarterError(const FImage& F, const FImage& R)
{
	double Sum = 0.0;
	for (uint32_t Quarter = 0; Quarter < 4; ++Quarter)
	{
		FPixelMask Mask(F.GetPixelCount());
		for (size_t Pixel = 0; Pixel < Mask.size(); ++Pixel)
		{
			const uint32_t X = static_cast<uint32_t>(Pixel % F.Width), Y = static_cast<uint32_t>(Pixel / F.Width);
			Mask[Pixel] = (X >= F.Width / 2 ? 1u : 0u) + (Y >= F.Height / 2 ? 2u : 0u) == Quarter ? 1 : 0;
		}
		Sum += std::abs(MeanOver(F, Mask) - MeanOver(R, Mask)) / 4.0;
	}
	return Sum / MeanOver(R);
}

double TemporalSigma(const std::vector<FImage>& Frames, const FPixelMask& Mask)
{
	double Deviation = 0.0, Mean = 0.0;
	Visit(Frames[0], Mask, [&](size_t, size_t I) {
		double Sum = 0.0, Squares = 0.0;
		for (const FImage& Frame : Frames)
		{
			Sum += double(Frame.Pixels[I]);
			Squares += double(Frame.Pixels[I]) * double(Frame.Pixels[I]);
		}
		const double N = double(Frames.size());
		Deviation += std::sqrt(std::max(0.0, (Squares - Sum * Sum / N) / (N - 1.0)));
		Mean += Sum / N;
	});
	return Deviation / Mean;
}

FPixelMask MakeFullMask(const FImage& Image) { return FPixelMask(Image.GetPixelCount(), 1); }

bool HasRadianceCells()
{
	const FRTConsoleVariable* const Route = FConsoleVariables::Get().Find("r.RT.GI");
	const FRTCVarValue Value = Route ? Route->GetValue() : FRTCVarValue();
	const int32_t* const Number = std::get_if<int32_t>(&Value);
	return Number && *Number >= 2;
}

std::vector<FStabilityShot> RepeatView(const FView& View, size_t Frames, size_t KeepFrom)
{
	std::vector<FStabilityShot> Shots(Frames);
	for (size_t I = 0; I < Frames; ++I)
	{
		Shots[I].View = View;
		Shots[I].bKeep = I >= KeepFrom;
	}
	return Shots;
}

std::vector<FImage> DropUnkept(std::vector<FImage> Frames)
{
	std::erase_if(Frames, [](const FImage& Frame) { return Frame.IsEmpty(); });
	return Frames;
}

double CountFramesTo(const std::vector<double>& Means, size_t First, double Level, bool bRise)
{
	for (size_t I = First; I < Means.size(); ++I)
	{
		if (bRise ? Means[I] >= Level : Means[I] <= Level) { return double(I - First + 1); }
	}
	return std::numeric_limits<double>::quiet_NaN();
}

} // namespace Lantern
