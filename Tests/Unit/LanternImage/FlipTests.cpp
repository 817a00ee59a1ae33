#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "LanternImage/Flip.h"
#include "LanternImage/ImageIO.h"
#include "LanternImage/ImageStatistics.h"
#include "Support/SharedFiles.h"

namespace Lantern
{

namespace
{

/// Pairs with the values that the metric's own tool gives for them.
class FlipPairs : public testing::TestWithParam<const char*>
{
protected:
	void SetUp() override
	{
		const std::filesystem::path Folder = GetSharedFolder() / "metrics";
		std::ifstream File(Folder / "flip.json");
		if (!File) { GTEST_SKIP() << "no " << (Folder / "flip.json") << "; set LANTERN_SHARED to the folder that holds metrics/"; }
		const nlohmann::json Pairs = nlohmann::json::parse(File).at("pairs");
		for (const nlohmann::json& Candidate : Pairs)
		{
			if (Candidate.at("test") == GetParam()) { Pair = Candidate; }
		}
		ASSERT_FALSE(Pair.is_null()) << "flip.json lacks " << GetParam();
		const FRTStatus Loaded[2] = {
		    LoadImageFile(Folder / Pair.at("test"), Test), LoadImageFile(Folder / Pair.at("reference"), Reference)};
		for (const FRTStatus& Status : Loaded)
		{
			if (Status.Code == ERTResult::Unsupported) { GTEST_SKIP() << Status.Message; }
			ASSERT_TRUE(Status) << Status.Message;
		}
	}

	nlohmann::json Pair;
	FImage Test;
	FImage Reference;
};

TEST_P(FlipPairs, AgreesWithTheReferenceTool)
{
	const bool bRadiance = Reference.Space == EImageSpace::Linear;
	const FFlipResult Result = bRadiance ? ComputeHdrFlip(Test, Reference) : ComputeFlip(Test, Reference);
	const FFlipPooled Pooled = PoolFlip(Result.Map);
	EXPECT_NEAR(Pooled.Mean, Pair.at("mean").get<double>(), 1e-4);
	EXPECT_NEAR(Pooled.WeightedMedian, Pair.at("weighted_median").get<double>(), 1e-3);
	if (bRadiance)
	{
		EXPECT_NEAR(Result.StartExposure, Pair.at("start_exposure").get<float>(), 1e-4f);
		EXPECT_NEAR(Result.StopExposure, Pair.at("stop_exposure").get<float>(), 1e-4f);
		EXPECT_EQ(Result.ExposureCount, Pair.at("exposures").get<uint32_t>());
	}
}

INSTANTIATE_TEST_SUITE_P(, FlipPairs,
    testing::Values("sponza_16spp.png", "forest_4spp.png", "sponza_blur5.png", "sponza_bright.png", "sponza_shift1.png", "white.png",
        "checker4.png", "ramp_flip.png", "sponza_16spp.exr", "forest_4spp.exr"),
    [](const auto& Info) {
	std::string Name = Info.param;
	Name[Name.size() - 4] = '_';
	return Name;
});

FImage MakeRamp(uint32_t Width, uint32_t Height, EImageSpace Space)
{
	FImage Image(Width, Height, 3, Space);
	for (size_t Index = 0; Index < Image.Pixels.size(); ++Index) { Image.Pixels[Index] = static_cast<float>(Index % 97) / 96.0f; }
	return Image;
}

TEST(Flip, EqualImagesDoNotDiffer)
{
	const FImage Display = MakeRamp(40, 23, EImageSpace::Display);
	EXPECT_EQ(PoolFlip(ComputeFlip(Display, Display).Map).Mean, 0.0);
	const FImage Radiance = MakeRamp(40, 23, EImageSpace::Linear);
	EXPECT_EQ(PoolFlip(ComputeHdrFlip(Radiance, Radiance).Map).Mean, 0.0);
}

TEST(Flip, DisplayErrorIsSymmetric)
{
	const FImage A = MakeRamp(30, 20, EImageSpace::Display);
	FImage B = A;
	for (float& Value : B.Pixels) { Value *= Value; }
	const FFlipResult Forward = ComputeFlip(A, B);
	EXPECT_GT(PoolFlip(Forward.Map).Mean, 0.01);
	EXPECT_EQ(Forward.Map.Pixels, ComputeFlip(B, A).Map.Pixels);
}

TEST(Flip, TinyAndThinImagesStayInRange)
{
	for (const auto& [Width, Height] : {std::pair(1u, 1u), std::pair(1u, 50u), std::pair(50u, 1u), std::pair(3u, 2u)})
	{
		const FImage Black(Width, Height, 1, EImageSpace::Display);
		FImage White = Black;
		White.Pixels.assign(White.Pixels.size(), 1.0f);
		for (const float Error : ComputeFlip(White, Black).Map.Pixels)
		{
			EXPECT_GT(Error, 0.9f);
			EXPECT_LE(Error, 1.0f);
		}
	}
}

TEST(Flip, AnErrorStaysWhereItIs)
{
	const FImage Reference(64, 64, 3, EImageSpace::Display);
	FImage Changed = Reference;
	Changed.At(20, 40, 1) = 1.0f;
	const FFlipResult Result = ComputeFlip(Changed, Reference);
	EXPECT_GT(Result.Map.At(20, 40, 0), 0.1f);
	// The widest filter reaches ten pixels.
	EXPECT_EQ(Result.Map.At(31, 40, 0), 0.0f);
	EXPECT_EQ(Result.Map.At(20, 29, 0), 0.0f);
}

TEST(Flip, SmallerOnScreenIsLessVisible)
{
	FImage Reference(64, 64, 3, EImageSpace::Display);
	FImage Changed = Reference;
	for (uint32_t Y = 0; Y < 64; ++Y)
	{
		for (uint32_t X = 0; X < 64; ++X)
		{
			for (uint32_t Channel = 0; Channel < 3; ++Channel)
			{
				Reference.At(X, Y, Channel) = (X + Y) % 2 == 0 ? 0.2f : 0.8f;
				Changed.At(X, Y, Channel) = (X + Y) % 2 == 0 ? 0.8f : 0.2f;
			}
		}
	}
	const double Near = PoolFlip(ComputeFlip(Changed, Reference, 15.0f).Map).Mean;
	const double Far = PoolFlip(ComputeFlip(Changed, Reference, 120.0f).Map).Mean;
	EXPECT_GT(Near, 5.0 * Far);
}

TEST(Flip, BlackReferenceAndHugeRangesEnd)
{
	const FImage Black(16, 16, 3);
	FImage Lit = Black;
	Lit.At(3, 3, 0) = 1e30f;
	EXPECT_EQ(ComputeHdrFlip(Lit, Black).ExposureCount, 2u);
	const FFlipResult Range = ComputeHdrFlip(Black, Lit);
	EXPECT_LE(Range.ExposureCount, 24u);
	EXPECT_EQ(CountNonFinitePixels(Range.Map), 0u);
	EXPECT_GT(Range.Map.At(3, 3, 0), 0.1f);
}

TEST(Flip, PoolingFollowsItsDefinition)
{
	FImage Map(4, 1, 1);
	Map.Pixels = {0.1f, 0.4f, 0.2f, 0.3f};
	const FFlipPooled All = PoolFlip(Map);
	EXPECT_NEAR(All.Mean, 0.25, 1e-7);
	// Sum 1.0: 0.1 + 0.2 = 0.3 is below a half, with 0.3 it is 0.6.
	EXPECT_NEAR(All.WeightedMedian, 0.3, 1e-7);
	EXPECT_NEAR(PoolFlip(Map, {1, 0, 1, 0}).Mean, 0.15, 1e-7);
	EXPECT_TRUE(std::isnan(PoolFlip(Map, {0, 0, 0, 0}).Mean));
}

} // namespace

} // namespace Lantern
