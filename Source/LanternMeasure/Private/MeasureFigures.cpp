// Error figures of an image against references with noise of their own.
#include "LanternMeasure/MeasureFigures.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "LanternImage/Flip.h"
#include "LanternImage/ImageStatistics.h"

namespace Lantern
{

namespace
{
[[maybe_unused]] bool IsLike(const FImage& A, const FImage& B)
{
	return A.Width == B.Width && A.Height == B.Height && A.Channels == B.Channels;
}

bool AreFinite(std::initializer_list<const FImage*> Images, size_t Pixel)
{
	return std::all_of(Images.begin(), Images.end(), [&](const FImage* Image) { return IsPixelFinite(*Image, Pixel); });
}

/// Calls Visit(index into Pixels) for the colour channels of every pixel that is finite in all images, and counts them.
template <class T>
size_t ForEachValue(std::initializer_list<const FImage*> Images, T&& Visit)
{
	const FImage& First = **Images.begin();
	for ([[maybe_unused]] const FImage* Image : Images) { assert(IsLike(*Image, First)); }
	const uint32_t Colors = First.GetColorChannels();
	size_t Count = 0;
	for (size_t Pixel = 0; Pixel < First.GetPixelCount(); ++Pixel)
	{
		if (!AreFinite(Images, Pixel)) { continue; }
		for (uint32_t C = 0; C < Colors; ++C) { Visit(Pixel * First.Channels + C); }
		Count += Colors;
	}
	return Count;
}

FImage MakeFinite(const FImage& Image, const FImage& Other)
{
	FImage Out = Image;
	for (size_t I = 0; I < Out.Pixels.size(); ++I)
	{
		if (!std::isfinite(Out.Pixels[I])) { Out.Pixels[I] = std::isfinite(Other.Pixels[I]) ? Other.Pixels[I] : 0.0f; }
	}
	return Out;
}
} // namespace

std::optional<double> ComputeUnbiasedRelMse(const FImage& F, const FSignalReference& R)
{
	double Sum = 0.0;
	const size_t Count = ForEachValue({&F, &R.A, &R.B}, [&](size_t I) {
		const double A = R.A.Pixels[I], B = R.B.Pixels[I], Mean = 0.5 * (A + B);
		Sum += (F.Pixels[I] - A) * (F.Pixels[I] - B) / (Mean * Mean + 0.01);
	});
	return Count > 0 ? std::optional(Sum / double(Count)) : std::nullopt;
}

std::optional<double> ComputeSignalFlip(ESignal Signal, const FImage& F, const FImage& R, FImage* OutMap)
{
	assert(IsLike(F, R));
	if (F.IsEmpty()) { return std::nullopt; }
	const FImage Test = MakeFinite(F, R), Reference = MakeFinite(R, F);
	FFlipResult Result = GetSignalInfo(Signal).bRadiance ? ComputeHdrFlip(Test, Reference) : ComputeFlip(Test, Reference);
	const double Mean = PoolFlip(Result.Map).Mean;
	if (OutMap) { *OutMap = std::move(Result.Map); }
	return std::isfinite(Mean) ? std::optional(Mean) : std::nullopt;
}

void FTemporalDeviation::Add(const FImage& F)
{
	if (Frames == 0)
	{
		Width = F.Width;
		Height = F.Height;
		Channels = F.Channels;
		Mean.assign(F.Pixels.size(), 0.0);
		SquareSum.assign(F.Pixels.size(), 0.0);
		Broken.assign(F.GetPixelCount(), 0);
	}
	assert(F.Width == Width && F.Height == Height && F.Channels == Channels);
	++Frames;
	for (size_t I = 0; I < F.Pixels.size(); ++I)
	{
		const double Value = F.Pixels[I];
		if (!std::isfinite(Value))
		{
			Broken[I / Channels] = 1;
			continue;
		}
		const double Step = Value - Mean[I];
		Mean[I] += Step / Frames;
		SquareSum[I] += Step * (Value - Mean[I]);
	}
}

std::optional<double> FTemporalDeviation::GetSigma() const
{
	if (Frames < 2) { return std::nullopt; }
	double Sum = 0.0, Variance = 0.0;
	size_t Count = 0;
	const uint32_t Colors = Channels <= 2 ? 1 : 3;
	for (size_t I = 0; I < Mean.size(); ++I)
	{
		if (Broken[I / Channels] || I % Channels >= Colors) { continue; }
		Sum += Mean[I];
		Variance += SquareSum[I] / (Frames - 1);
		++Count;
	}
	if (!(Sum > 0.0)) { return std::nullopt; }
	return std::sqrt(Variance / double(Count)) / (Sum / double(Count));
}

FImage FTemporalDeviation::GetMap() const
{
	if (Frames < 2) { return {}; }
	FImage Out(Width, Height, 1);
	const uint32_t Colors = Channels <= 2 ? 1 : 3;
	for (size_t I = 0; I < Mean.size(); ++I)
	{
		if (Broken[I / Channels] || I % Channels >= Colors) { continue; }
		Out.Pixels[I / Channels] += static_cast<float>(std::sqrt(SquareSum[I] / (Frames - 1)) / Colors);
	}
	return Out;
}

std::optional<double> ComputeProjection(const FImage& F, const FSignalReference& New, const FSignalReference& Old)
{
	constexpr double LargestError = 0.05;
	double Above = 0.0, AboveSquare = 0.0, Below = 0.0, Noise = 0.0, Square = 0.0;
	const size_t Count = ForEachValue({&F, &New.A, &New.B, &Old.A, &Old.B}, [&](size_t I) {
		const double NewA = New.A.Pixels[I], NewB = New.B.Pixels[I], OldA = Old.A.Pixels[I], OldB = Old.B.Pixels[I];
		const double Mean = 0.5 * (NewA + NewB);
		// Halves A may be traced with the same random numbers in both references: A only ever meets B.
		const double Term = (F.Pixels[I] - NewA) * (OldB - NewB);
		Above += Term;
		AboveSquare += Term * Term;
		Below += (OldA - NewA) * (OldB - NewB);
		Noise += 0.25 * ((OldA - OldB) * (OldA - OldB) + (NewA - NewB) * (NewA - NewB));
		Square += Mean * Mean;
	});
	// The noise of the sum Below, relative to it, is about Noise / sqrt(Count).
	const bool bDiffer = Below > 1e-4 * Square && Below > 0.0 && Below * std::sqrt(double(Count)) > 4.0 * Noise;
	// Standard error of the sum Above, pixels being independent.
	return bDiffer && std::sqrt(AboveSquare) <= LargestError * Below ? std::optional(Above / Below) : std::nullopt;
}

void FFramesTo90::Add(double Projection)
{
	++Frames;
	if (IsDone()) { return; }
	Below = Projection <= Threshold ? Below + 1 : 0;
	if (Below == 2) { Answer = Frames - 1; }
}

std::optional<double> ComputeLeak(const FImage& F, const FImage& R)
{
	constexpr size_t FewestPixels = 16;
	double ReferenceSum = 0.0;
	const size_t Values = ForEachValue({&F, &R}, [&](size_t I) { ReferenceSum += R.Pixels[I]; });
	if (Values == 0 || !(ReferenceSum > 0.0)) { return std::nullopt; }
	const double Mean = ReferenceSum / double(Values);
	double Sum = 0.0;
	size_t Dark = 0;
	const uint32_t Colors = R.GetColorChannels();
	for (size_t Pixel = 0; Pixel < R.GetPixelCount(); ++Pixel)
	{
		const float* const Reference = &R.Pixels[Pixel * R.Channels];
		const float* const Value = &F.Pixels[Pixel * F.Channels];
		if (!AreFinite({&F, &R}, Pixel) || std::any_of(Reference, Reference + Colors, [&](float V) { return V >= 1e-3 * Mean; }))
		{
			continue;
		}
		for (uint32_t C = 0; C < Colors; ++C) { Sum += Value[C]; }
		++Dark;
	}
	return Dark >= FewestPixels ? std::optional(Sum / double(Dark * Colors) / Mean) : std::nullopt;
}

std::optional<double> ComputeMedian(std::vector<double> Values)
{
	if (Values.empty()) { return std::nullopt; }
	const auto Middle = Values.begin() + static_cast<ptrdiff_t>(Values.size() / 2);
	std::nth_element(Values.begin(), Middle, Values.end());
	return *Middle;
}

} // namespace Lantern
