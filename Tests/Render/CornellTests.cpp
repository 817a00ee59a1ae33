// The Cornell box against the picture that an independent path tracer made of it with 1,024 samples per pixel.
#include <cmath>

#include "LanternImage/ImageIO.h"
#include "LanternImage/ImageStatistics.h"
#include "LanternImage/Metrics.h"
#include "Support/RenderFixture.h"

namespace Lantern
{

namespace
{

class FCornellTest : public FRenderTest
{
protected:
	static constexpr const char* ScenePath = "cornell/cornell.gltf";
	static constexpr const char* ReferencePath = "cornell/reference_cycles_256x256_1024spp.exr";
};
using FCornellSlowTest = FCornellTest;

double MeanOf(const FImage& Image, uint32_t Channel) { return ComputeMeans(Image).Channel[Channel]; }

// Eight pictures of 64 × 64 pixels and 128 samples. Their scatter gives the statistical error of each figure:
// - of a channel's mean, s. The tolerance is the 0.3 % plus 3 s.
// - of a block (4 × 4 pixels here, 16 × 16 of the reference), s_b. Were there no difference but noise, the median of
//   |a − b|/b would be 0.6745 times the median of s_b/b; the tolerance is that plus the 0.5 % of the full picture.
// The reference's own noise is a quarter of ours: it has 16 times our samples in each block's area.
TEST_F(FCornellTest, FewSamplesWithinTheirNoise)
{
	REQUIRE_SCENE(Scene, ScenePath);
	REQUIRE_SCENE(ReferenceFile, ReferencePath);
	FImage Reference;
	ASSERT_OK(LoadImageFile(ReferenceFile, Reference));
	ASSERT_TRUE(Load(Scene));
	FView View = MakeView(64, 64);
	std::vector<FImage> Batches;
	for (uint32_t Batch = 0; Batch < 8; ++Batch)
	{
		View.Seed = 1 + Batch;
		Batches.push_back(TraceReference(View, 128));
	}
	for (uint32_t Channel = 0; Channel < 3; ++Channel)
	{
		std::vector<double> Ratios;
		for (const FImage& Batch : Batches) { Ratios.push_back(MeanOf(Batch, Channel) / MeanOf(Reference, Channel)); }
		const FEstimate Ratio = MakeEstimate(Ratios);
		PrintFigure(
		    fmt::format("cornell, channel {}: mean ratio {:.5f} (statistical error {:.5f})", Channel, Ratio.Mean, Ratio.StandardError));
		EXPECT_NEAR(Ratio.Mean, 1.0, 0.003 + 3.0 * Ratio.StandardError);
		EXPECT_LT(Ratio.StandardError, 0.0015);
	}
	const std::vector<double> Blocks = ComputeBlockMeans(Reference, 16);
	std::vector<std::vector<double>> BatchBlocks;
	for (const FImage& Batch : Batches)
	{
		BatchBlocks.push_back(ComputeBlockMeans(Batch, 4));
		ASSERT_EQ(BatchBlocks.back().size(), Blocks.size());
	}
	std::vector<double> Errors, Sigmas;
	for (size_t Block = 0; Block < Blocks.size(); ++Block)
	{
		std::vector<double> Values;
		for (const auto& Batch : BatchBlocks) { Values.push_back(Batch[Block]); }
		const FEstimate Estimate = MakeEstimate(Values);
		Errors.push_back(std::abs(Estimate.Mean - Blocks[Block]) / (Blocks[Block] + 0.01));
		Sigmas.push_back(Estimate.StandardError / (Blocks[Block] + 0.01));
	}
	const double Median = ComputePercentile(Errors, 0.5), Noise = 0.6745 * ComputePercentile(Sigmas, 0.5);
	PrintFigure(fmt::format("cornell, 1,024 samples at a quarter: block median {:.5f}, of noise alone {:.5f}", Median, Noise));
	EXPECT_LT(Median, 0.005 + Noise);
	EXPECT_LT(Noise, 0.005);
}

// The figures.
TEST_F(FCornellSlowTest, FullSamples)
{
	REQUIRE_SCENE(Scene, ScenePath);
	REQUIRE_SCENE(ReferenceFile, ReferencePath);
	FImage Reference;
	ASSERT_OK(LoadImageFile(ReferenceFile, Reference));
	ASSERT_TRUE(Load(Scene));
	FImageMetrics Metrics;
	ASSERT_OK(CompareImages(TraceReference(MakeView(256, 256), 1024), Reference, Metrics));
	PrintFigure(fmt::format("cornell, 1,024 samples: mean ratio {:.5f} {:.5f} {:.5f}, block16 median {:.5f}, p95 {:.5f}",
	    Metrics.MeanRatio[0], Metrics.MeanRatio[1], Metrics.MeanRatio[2], Metrics.Block16Median, Metrics.Block16P95));
	for (const double Ratio : Metrics.MeanRatio) { EXPECT_NEAR(Ratio, 1.0, 0.003); }
	EXPECT_LE(Metrics.Block16Median, 0.005);
	EXPECT_EQ(Metrics.NonFinite[0], 0u);
}

} // namespace
} // namespace Lantern
