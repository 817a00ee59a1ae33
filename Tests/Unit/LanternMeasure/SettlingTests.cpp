// When frames count as settled: once their change is invisible, or falls no more.
#include "LanternMeasure/Settling.h"

#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

/// Number of frames until they have settled, at most 200. Error: standard deviation of frame N about a grey picture, N from 1.
uint32_t CountFrames(const std::function<double(uint32_t)>& Error, float Gray = 0.4f)
{
	std::mt19937 Random(7);
	FSettling Settling;
	for (uint32_t Frame = 1; Frame <= 200; ++Frame)
	{
		FImage Image(64, 32, 3);
		std::normal_distribution<double> Noise(Gray, Gray * Error(Frame));
		for (float& Value : Image.Pixels) { Value = float(Noise(Random)); }
		if (Settling.Add(Image)) { return Frame; }
	}
	return 200;
}

TEST(Settling, TwoFramesThatAreEqualHaveSettled)
{
	EXPECT_EQ(CountFrames([](uint32_t) { return 0.0; }), 2u);
	EXPECT_EQ(CountFrames([](uint32_t) { return 0.0; }, 0.0f), 2u) << "black";
}

TEST(Settling, WaitsAsLongAsTheChangeFalls)
{
	// A mean of N frames until the filter has all that it keeps, and an exponential mean from then on.
	for (const uint32_t Kept : {8u, 12u, 16u})
	{
		const uint32_t Frames = CountFrames([&](uint32_t Frame) { return 0.5 / std::min(Frame, Kept); });
		EXPECT_GE(Frames, Kept) << "the change fell until then";
		EXPECT_LE(Frames, Kept + 2 * FSettling::Window + 1);
	}
}

TEST(Settling, NoiseThatNeverFallsIsNotWaitedFor)
{
	EXPECT_EQ(CountFrames([](uint32_t) { return 0.5; }), 2 * FSettling::Window + 1);
}

TEST(Settling, WhatNobodySeesEndsIt)
{
	const uint32_t Frames = CountFrames([](uint32_t Frame) { return 0.05 / Frame; });
	EXPECT_GT(Frames, 5u);
	EXPECT_LT(Frames, 30u);
}

TEST(Settling, ChangeIsRelativeToTheLightOfThePicture)
{
	const auto Noise = [](uint32_t Frame) { return 0.5 / std::min(Frame, 12u); };
	EXPECT_EQ(CountFrames(Noise, 0.001f), CountFrames(Noise, 1000.0f));
}

TEST(Settling, NotANumberIsNoChange)
{
	FImage Image(2, 1, 3);
	Image.Pixels.assign(6, 1.0f);
	Image.Pixels[0] = std::numeric_limits<float>::quiet_NaN();
	FSettling Settling;
	EXPECT_FALSE(Settling.Add(Image));
	EXPECT_TRUE(Settling.Add(Image));
}

} // namespace
} // namespace Lantern
