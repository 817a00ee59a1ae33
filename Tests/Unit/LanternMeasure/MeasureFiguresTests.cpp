// Figures on synthetic images whose answers are known.
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "LanternMeasure/MeasureFigures.h"

namespace Lantern
{
namespace
{

constexpr uint32_t Size = 64;

FImage MakeConstant(float Value, uint32_t Channels = 1)
{
	FImage Image(Size, Size, Channels);
	std::fill(Image.Pixels.begin(), Image.Pixels.end(), Value);
	return Image;
}

FImage AddNoise(FImage Image, float Sigma, uint32_t Seed)
{
	std::mt19937 Generator(Seed);
	std::normal_distribution<float> Normal(0.0f, Sigma);
	for (float& Value : Image.Pixels) { Value += Normal(Generator); }
	return Image;
}

FSignalReference MakeReference(const FImage& Truth, float Sigma, uint32_t Seed)
{
	FSignalReference Out;
	Out.A = AddNoise(Truth, Sigma, Seed);
	Out.B = AddNoise(Truth, Sigma, Seed + 1);
	Out.Mean = Out.A;
	for (size_t I = 0; I < Out.Mean.Pixels.size(); ++I) { Out.Mean.Pixels[I] = 0.5f * (Out.A.Pixels[I] + Out.B.Pixels[I]); }
	return Out;
}

FImage MakeRamp(bool bDown = false)
{
	FImage Image(Size, Size, 1);
	for (uint32_t Y = 0; Y < Size; ++Y)
	{
		for (uint32_t X = 0; X < Size; ++X) { Image.At(X, Y, 0) = float(bDown ? Size - 1 - X : X) / (Size - 1); }
	}
	return Image;
}

FImage Mix(const FImage& A, const FImage& B, float Part)
{
	FImage Out = A;
	for (size_t I = 0; I < Out.Pixels.size(); ++I) { Out.Pixels[I] += Part * (B.Pixels[I] - A.Pixels[I]); }
	return Out;
}

TEST(MeasureFigures, RelMseOfAnOffset)
{
	const FImage Truth = MakeConstant(1.0f, 3);
	const auto Error = ComputeUnbiasedRelMse(MakeConstant(1.1f, 3), MakeReference(Truth, 0.0f, 1));
	ASSERT_TRUE(Error);
	EXPECT_NEAR(*Error, 0.01 / 1.01, 1e-6);
}

TEST(MeasureFigures, RelMseIsWithoutTheReferencesNoise)
{
	const FImage Truth = MakeConstant(1.0f);
	const FSignalReference Noisy = MakeReference(Truth, 0.1f, 1);
	// A perfect frame: the plain figure would be 0.005.
	EXPECT_NEAR(*ComputeUnbiasedRelMse(Truth, Noisy), 0.0, 5e-4);
	// A noisy one: its own variance alone.
	EXPECT_NEAR(*ComputeUnbiasedRelMse(AddNoise(Truth, 0.2f, 9), Noisy), 0.04 / 1.01, 4e-3);
}

TEST(MeasureFigures, RelMseLeavesBrokenPixelsOut)
{
	FImage F = MakeConstant(1.1f);
	F.Pixels[5] = std::numeric_limits<float>::quiet_NaN();
	F.Pixels[6] = std::numeric_limits<float>::infinity();
	EXPECT_NEAR(*ComputeUnbiasedRelMse(F, MakeReference(MakeConstant(1.0f), 0.0f, 1)), 0.01 / 1.01, 1e-6);
	FImage Broken = MakeConstant(std::numeric_limits<float>::quiet_NaN());
	EXPECT_FALSE(ComputeUnbiasedRelMse(Broken, MakeReference(MakeConstant(1.0f), 0.0f, 1)));
}

TEST(MeasureFigures, FlipIsZeroForEqualsAndFiniteForBrokenPixels)
{
	FImage F = MakeRamp(), Map;
	EXPECT_EQ(*ComputeSignalFlip(ESignal::SunShadow, F, F, &Map), 0.0);
	EXPECT_EQ(Map.Width, Size);
	EXPECT_GT(*ComputeSignalFlip(ESignal::SunShadow, MakeRamp(true), F), 0.1);
	F.Pixels[7] = std::numeric_limits<float>::quiet_NaN();
	EXPECT_EQ(*ComputeSignalFlip(ESignal::SunShadow, F, MakeRamp()), 0.0);
	EXPECT_GT(*ComputeSignalFlip(ESignal::DiffuseGI, MakeConstant(2.0f, 3), MakeConstant(1.0f, 3)), 0.0);
}

TEST(MeasureFigures, SigmaOfNoise)
{
	FTemporalDeviation Deviation;
	EXPECT_FALSE(Deviation.GetSigma());
	for (uint32_t I = 0; I < 20; ++I) { Deviation.Add(AddNoise(MakeConstant(2.0f), 0.1f, I)); }
	EXPECT_NEAR(*Deviation.GetSigma(), 0.05, 1e-3);
	FTemporalDeviation Still;
	for (uint32_t I = 0; I < 3; ++I) { Still.Add(MakeRamp()); }
	EXPECT_NEAR(*Still.GetSigma(), 0.0, 1e-7);
	FTemporalDeviation Black;
	for (uint32_t I = 0; I < 3; ++I) { Black.Add(MakeConstant(0.0f)); }
	EXPECT_FALSE(Black.GetSigma());
}

TEST(MeasureFigures, SigmaOfOneFlickeringPixel)
{
	FTemporalDeviation Deviation;
	FImage F = MakeConstant(1.0f);
	for (uint32_t I = 0; I < 2; ++I)
	{
		F.Pixels[0] = I ? 2.0f : 0.0f; // variance 2 of two frames
		Deviation.Add(F);
	}
	EXPECT_NEAR(*Deviation.GetSigma(), std::sqrt(2.0 / (Size * Size)), 1e-6);
	EXPECT_NEAR(Deviation.GetMap().Pixels[0], std::sqrt(2.0), 1e-6);
}

TEST(MeasureFigures, ProjectionIsThePartOfTheOld)
{
	const FImage New = MakeRamp(), Old = MakeRamp(true);
	const FSignalReference NewReference = MakeReference(New, 0.1f, 1), OldReference = MakeReference(Old, 0.1f, 5);
	for (const float Part : {0.0f, 0.3f, 1.0f, -0.2f})
	{
		EXPECT_NEAR(*ComputeProjection(Mix(New, Old, Part), NewReference, OldReference), Part, 0.02) << Part;
	}
	EXPECT_NEAR(*ComputeProjection(AddNoise(New, 0.3f, 20), NewReference, OldReference), 0.0, 0.03);
}

TEST(MeasureFigures, ProjectionDoesNotMindReferencesOfTheSameRandomNumbers)
{
	const FImage New = MakeRamp(), Old = Mix(MakeRamp(), MakeRamp(true), 0.3f);
	EXPECT_NEAR(*ComputeProjection(New, MakeReference(New, 0.2f, 1), MakeReference(Old, 0.2f, 1)), 0.0, 0.1);
}

TEST(MeasureFigures, ProjectionNeedsADifference)
{
	const FImage Truth = MakeRamp();
	EXPECT_FALSE(ComputeProjection(Truth, MakeReference(Truth, 0.0f, 1), MakeReference(Truth, 0.0f, 3)));
	EXPECT_FALSE(ComputeProjection(Truth, MakeReference(Truth, 0.1f, 1), MakeReference(Truth, 0.1f, 3)));
}

TEST(MeasureFigures, FramesTo90OfAnExponential)
{
	// exp(−n / 5) ≤ 0.1 from n = 11.51 on.
	FFramesTo90 T90;
	for (int N = 1; N <= 20 && !T90.IsDone(); ++N) { T90.Add(std::exp(-N / 5.0)); }
	EXPECT_EQ(T90.Get(), 12u);
	EXPECT_EQ(T90.GetFrameCount(), 13u);
}

TEST(MeasureFigures, FramesTo90AreNotTakenInByOneFrame)
{
	FFramesTo90 T90;
	for (const double P : {0.8, 0.05, 0.5, 0.09, 0.08, 0.5}) { T90.Add(P); }
	EXPECT_EQ(T90.Get(), 4u);
	FFramesTo90 Never;
	for (int I = 0; I < 60; ++I) { Never.Add(0.5); }
	EXPECT_FALSE(Never.Get());
}

TEST(MeasureFigures, LeakIsLightWhereThereShouldBeNone)
{
	FImage R = MakeConstant(1.0f), F = MakeConstant(1.0f);
	for (uint32_t I = 0; I < Size * Size / 2; ++I)
	{
		R.Pixels[I] = 0.0f;
		F.Pixels[I] = 0.01f;
	}
	EXPECT_NEAR(*ComputeLeak(F, R), 0.02, 1e-6); // 0.01 over a mean of 0.5
	EXPECT_FALSE(ComputeLeak(MakeConstant(1.0f), MakeConstant(1.0f)));
	EXPECT_FALSE(ComputeLeak(MakeConstant(1.0f), MakeConstant(0.0f)));
}

TEST(MeasureFigures, Median)
{
	EXPECT_FALSE(ComputeMedian({}));
	EXPECT_EQ(*ComputeMedian({3, 1, 2}), 2);
	EXPECT_EQ(*ComputeMedian({4, 1, 3, 2}), 3);
}

} // namespace
} // namespace Lantern
