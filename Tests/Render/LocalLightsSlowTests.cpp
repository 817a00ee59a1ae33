// Bias of local lights from 1 to 640: the default, and the setting without any, against the reference.
#include <algorithm>
#include <cmath>

#include "LanternImage/ImageStatistics.h"
#include "LocalLightsFixture.h"

namespace Lantern
{

namespace
{
constexpr uint32_t Batches = 4, BlockSize = 16;

class FLocalLightsSlowTest : public FLocalLightsFixture
{
protected:
	/// Means of pictures with seeds of their own.
	struct FSide
	{
		FEstimate Mean;
		std::vector<double> Blocks;
	};
	template <class FMake>
	static FSide Measure(FMake Make)
	{
		std::vector<double> Means;
		FSide Side;
		for (uint32_t Batch = 0; Batch < Batches; ++Batch)
		{
			const FImage Picture = Make(Batch);
			const std::vector<double> Blocks = ComputeBlockMeans(Picture, BlockSize);
			Means.push_back(ComputeMeans(Picture).Luminance);
			Side.Blocks.resize(Blocks.size());
			for (size_t I = 0; I < Blocks.size(); ++I) { Side.Blocks[I] += Blocks[I] / Batches; }
		}
		Side.Mean = MakeEstimate(Means);
		return Side;
	}
	/// Relative errors of blocks, in order.
	static std::vector<double> CompareBlocks(const FSide& Ours, const FSide& Truth)
	{
		std::vector<double> Errors;
		for (size_t I = 0; I < Truth.Blocks.size(); ++I) { Errors.push_back(std::abs(Ours.Blocks[I] / Truth.Blocks[I] - 1.0)); }
		std::sort(Errors.begin(), Errors.end());
		return Errors;
	}
};

TEST_F(FLocalLightsSlowTest, BiasFromOneToManyLights)
{
	ASSERT_NO_FATAL_FAILURE(LoadPosts());
	SetVariable("r.RT.Lights.Denoise", "0");
	const FView View = LookAtPosts(96, 54);
	for (const uint32_t Count : {1u, 8u, 64u, 640u})
	{
		const std::vector<FLightId> Ids = AddLamps(Count);
		const uint32_t Samples = Count == 1 ? 16 : Count < 640 ? 512 : 1024; // of many, the reference chooses by power alone
		const FSide Truth = Measure([&](uint32_t Batch) { return TraceSignal(ESignal::LocalDiffuse, View, Samples, 1, 1 + Batch); });
		for (const char* const Unbiased : {"0", "1"})
		{
			SetVariable("r.RT.Lights.Unbiased", Unbiased);
			const FSide Ours = Measure([&](uint32_t Batch) {
				FView Seeded = View;
				Seeded.Seed = 101 + Batch;
				return RenderSignal(ESignal::LocalDiffuse, Seeded, Count == 1 ? 16 : 192);
			});
			const double Ratio = Ours.Mean.Mean / Truth.Mean.Mean;
			const double Sigma = std::hypot(Ours.Mean.StandardError, Truth.Mean.StandardError) / Truth.Mean.Mean;
			const std::vector<double> Errors = CompareBlocks(Ours, Truth);
			PrintFigure(
			    fmt::format("{} lights, unbiased {}: over the reference {:.5f} (statistical error {:.5f}); blocks off by {:.5f} at the "
			                "median, {:.5f} at worst",
			        Count, Unbiased, Ratio, Sigma, Errors[Errors.size() / 2], Errors.back()));
			// Rounding of G-buffer and half floats is 0.05 %.
			EXPECT_NEAR(Ratio, 1.0, 3.0 * Sigma + 0.0005) << Count;
			EXPECT_LT(Sigma, 0.003) << "too few samples to tell";
			EXPECT_LE(Errors[Errors.size() / 2], 0.005) << Count;
			EXPECT_LE(Errors.back(), 0.05) << Count;
		}
		for (const FLightId Id : Ids) { GetWorld().RemoveLight(Id); }
	}
	AddLamps(16);
	const FSide Right = Measure([&](uint32_t) { return RenderSignal(ESignal::LocalDiffuse, View, 8); });
	SetVariable("r.RT.Debug.Lights.CellTarget", "0");
	const FSide Wrong = Measure([&](uint32_t) { return RenderSignal(ESignal::LocalDiffuse, View, 8); });
	EXPECT_GT(CompareBlocks(Wrong, Right).back(), 0.05) << "the planted fault goes unnoticed";
}

} // namespace
} // namespace Lantern
