// Signals of frames and of the reference, their means, and the comparison of the two.
#include "SignalFixture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace Lantern
{

namespace
{

/// What the tests without the slow ones leave of Count frames or samples. Few are not worth to be fewer.
uint32_t Reduce(uint32_t Count, uint32_t AllUpTo)
{
	return std::getenv("LANTERN_TEST_DEEP") != nullptr ? Count : std::max(std::min(Count, AllUpTo), Count / FSignalTest::ShallowDivisor);
}

} // namespace

bool FSignalTest::HasSignal(ESignal Signal, const FView& View)
{
	FFrameCapture Capture;
	Capture.Signals.Add(Signal);
	FCapturedFrame Frame;
	EXPECT_OK(GetEngine().RenderFrame(View, 0.0, Capture, &Frame));
	return !Frame.Get(Signal).IsEmpty();
}

FImage FSignalTest::TraceSignal(ESignal Signal, FView View, uint32_t Samples, uint32_t Bounces, uint32_t Seed)
{
	FReferenceSettings Settings;
	Settings.View = View;
	Settings.View.Seed = Seed;
	Settings.Samples = Samples;
	Settings.Bounces = Bounces;
	Settings.Signal = Signal;
	Settings.bPixelCenters = true;
	return TraceReference(Settings);
}

FEstimate FSignalTest::EstimateSignal(ESignal Signal, const FView& View, uint32_t Samples, uint32_t Bounces, uint32_t Batches)
{
	std::vector<double> Means;
	for (uint32_t Batch = 0; Batch < Batches; ++Batch)
	{
		Means.push_back(MeanGreen(TraceSignal(Signal, View, Samples, Bounces, 1 + Batch)));
	}
	return MakeEstimate(Means);
}

FEstimate FSignalTest::EstimateFrames(ESignal Signal, const FView& View, uint32_t Count, uint32_t Batches)
{
	std::vector<double> Means;
	for (uint32_t Batch = 0; Batch < Batches; ++Batch)
	{
		FView Seeded = View;
		Seeded.Seed = 101 + Batch;
		Means.push_back(MeanGreen(RenderSignal(Signal, Seeded, Count)));
	}
	return MakeEstimate(Means);
}

void FSignalTest::ExpectUnbiased(
    const char* What, ESignal Signal, const FView& View, uint32_t Frames, uint32_t Samples, uint32_t Bounces, double Tolerance)
{
	constexpr uint32_t Batches = 6, BlockSize = 8, FewFrames = 8, FewSamples = 32;
	const uint32_t LessFrames = Reduce(Frames, FewFrames), LessSamples = Reduce(Samples, FewSamples);
	// Noise grows as the root of what is left out.
	const double Coarser = std::sqrt(std::max(double(Frames) / LessFrames, double(Samples) / LessSamples));
	std::vector<double> Means[2], Blocks[2];
	std::vector<std::vector<double>> Scatter[2];
	for (uint32_t Batch = 0; Batch < Batches; ++Batch)
	{
		FView Seeded = View;
		Seeded.Seed = 101 + Batch;
		const FImage Pictures[2] = {RenderSignal(Signal, Seeded, LessFrames), TraceSignal(Signal, View, LessSamples, Bounces, 1 + Batch)};
		for (int Side = 0; Side < 2; ++Side)
		{
			EXPECT_EQ(CountNonFinitePixels(Pictures[Side]), 0u) << What;
			Means[Side].push_back(ComputeMeans(Pictures[Side]).Luminance);
			Scatter[Side].push_back(ComputeBlockMeans(Pictures[Side], BlockSize));
		}
	}
	const FEstimate Pass = MakeEstimate(Means[0]), Reference = MakeEstimate(Means[1]);
	ASSERT_GT(Reference.Mean, 0.0);
	const double Ratio = Pass.Mean / Reference.Mean, Sigma = std::hypot(Pass.StandardError, Reference.StandardError) / Reference.Mean;
	std::vector<double> Errors, Noise;
	for (size_t Block = 0; Block < Scatter[0][0].size(); ++Block)
	{
		FEstimate Sides[2];
		for (int Side = 0; Side < 2; ++Side)
		{
			std::vector<double> Values;
			for (const auto& Batch : Scatter[Side]) { Values.push_back(Batch[Block]); }
			Sides[Side] = MakeEstimate(Values);
		}
		const double Floor = Sides[1].Mean + 0.01 * Reference.Mean;
		Errors.push_back(std::abs(Sides[0].Mean - Sides[1].Mean) / Floor);
		Noise.push_back(std::hypot(Sides[0].StandardError, Sides[1].StandardError) / Floor);
	}
	// Of a normal distribution the median of |x| is 0.6745 σ.
	const double Median = ComputePercentile(Errors, 0.5), Expected = 0.6745 * ComputePercentile(Noise, 0.5);
	PrintFigure(fmt::format("{}: pass / reference {:.5f} (statistical error {:.5f}); block median {:.5f}, of noise alone {:.5f}", What,
	    Ratio, Sigma, Median, Expected));
	EXPECT_NEAR(Ratio, 1.0, Tolerance + 3.0 * Sigma) << What;
	EXPECT_LT(Sigma, Tolerance * Coarser) << What << ": too few samples to tell";
	EXPECT_LT(Median, Tolerance + 1.5 * Expected) << What;
}

void FSignalTest::SetIndirect(int32_t Samples, int32_t Bounces)
{
	SetVariable("r.RT.GI.Denoise", "0");
	SetVariable("r.RT.GI", "1");
	SetVariable("r.RT.Reflections", "2");
	for (const char* Pass : {"r.RT.GI", "r.RT.Reflections"})
	{
		SetVariable((std::string(Pass) + ".Samples").c_str(), std::to_string(Samples));
		SetVariable((std::string(Pass) + ".Bounces").c_str(), std::to_string(Bounces));
	}
}

} // namespace Lantern
