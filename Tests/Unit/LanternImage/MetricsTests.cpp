#include <cmath>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "Commands/CompareCommand.h"
#include "LanternImage/ImageIO.h"
#include "LanternImage/Metrics.h"
#include "Support/SharedFiles.h"

namespace Lantern
{

namespace
{

constexpr float NaN = std::numeric_limits<float>::quiet_NaN();
constexpr float Infinity = std::numeric_limits<float>::infinity();

FImage MakeConstant(uint32_t Width, uint32_t Height, float R, float G, float B, EImageSpace Space = EImageSpace::Linear)
{
	FImage Image(Width, Height, 3, Space);
	for (size_t Pixel = 0; Pixel < Image.GetPixelCount(); ++Pixel)
	{
		Image.Pixels[Pixel * 3 + 0] = R;
		Image.Pixels[Pixel * 3 + 1] = G;
		Image.Pixels[Pixel * 3 + 2] = B;
	}
	return Image;
}

FImageMetrics Compare(const FImage& A, const FImage& B)
{
	FImageMetrics Metrics;
	const FRTStatus Status = CompareImages(A, B, Metrics);
	EXPECT_TRUE(Status) << Status.Message;
	return Metrics;
}

TEST(Metrics, FollowTheirDefinitions)
{
	const FImageMetrics Metrics = Compare(MakeConstant(32, 32, 1.5f, 0.5f, 2.0f), MakeConstant(32, 32, 1.0f, 0.5f, 4.0f));
	EXPECT_NEAR(Metrics.Mse, (0.25 + 0.0 + 4.0) / 3.0, 1e-12);
	EXPECT_NEAR(Metrics.Rmse, std::sqrt(4.25 / 3.0), 1e-12);
	EXPECT_NEAR(Metrics.RelMse, (0.25 / 1.01 + 4.0 / 16.01) / 3.0, 1e-12);
	EXPECT_NEAR(Metrics.Psnr, 10.0 * std::log10(16.0 / (4.25 / 3.0)), 1e-9);
	EXPECT_NEAR(Metrics.MeanRatio[0], 1.5, 1e-12);
	EXPECT_NEAR(Metrics.MeanRatio[1], 1.0, 1e-12);
	EXPECT_NEAR(Metrics.MeanRatio[2], 0.5, 1e-12);
	const double A = 0.2126 * 1.5 + 0.7152 * 0.5 + 0.0722 * 2.0;
	const double B = 0.2126 * 1.0 + 0.7152 * 0.5 + 0.0722 * 4.0;
	EXPECT_NEAR(Metrics.Block16Median, std::abs(A - B) / (B + 0.01), 1e-6);
	EXPECT_NEAR(Metrics.Block16P95, std::abs(A - B) / (B + 0.01), 1e-6);
	EXPECT_GT(Metrics.Flip, 0.1);
	EXPECT_EQ(Metrics.NonFinite[0], 0u);
}

TEST(Metrics, EqualImages)
{
	const FImageMetrics Metrics = Compare(MakeConstant(20, 20, 0, 0.5f, 1), MakeConstant(20, 20, 0, 0.5f, 1));
	EXPECT_EQ(Metrics.Mse, 0.0);
	EXPECT_EQ(Metrics.RelMse, 0.0);
	EXPECT_TRUE(std::isinf(Metrics.Psnr));
	EXPECT_EQ(Metrics.Flip, 0.0);
	EXPECT_EQ(Metrics.MeanRatio[0], 1.0) << "black over black is equal";
}

TEST(Metrics, DisplayPicturesUseStoredValuesAndPeakOne)
{
	const FImageMetrics Metrics =
	    Compare(MakeConstant(8, 8, 0.5f, 0.5f, 0.5f, EImageSpace::Display), MakeConstant(8, 8, 0.25f, 0.25f, 0.25f, EImageSpace::Display));
	EXPECT_NEAR(Metrics.Mse, 0.0625, 1e-12);
	EXPECT_NEAR(Metrics.Psnr, 10.0 * std::log10(1.0 / 0.0625), 1e-9);
	EXPECT_EQ(Metrics.FlipResult.ExposureCount, 0u) << "display pictures take the display metric";
}

TEST(Metrics, BlocksSeeLocalErrorsThatCancelInTheMean)
{
	FImage A = MakeConstant(64, 16, 1.0f, 1.0f, 1.0f);
	const FImage B = A;
	for (uint32_t Y = 0; Y < 16; ++Y)
	{
		for (uint32_t Channel = 0; Channel < 3; ++Channel)
		{
			for (uint32_t X = 0; X < 16; ++X)
			{
				A.At(X, Y, Channel) = 1.2f;
				A.At(X + 16, Y, Channel) = 0.8f;
			}
		}
	}
	const FImageMetrics Metrics = Compare(A, B);
	EXPECT_NEAR(Metrics.MeanRatio[1], 1.0, 1e-6);
	// Block errors 0, 0, .2, .2 (over 1.01).
	EXPECT_NEAR(Metrics.Block16Median, 0.1 / 1.01, 1e-6);
	EXPECT_NEAR(Metrics.Block16P95, 0.2 / 1.01, 1e-6);
}

TEST(Metrics, BrokenPixelsAreCountedAndLeftOut)
{
	FImage A = MakeConstant(40, 40, 1.0f, 1.0f, 1.0f);
	FImage B = MakeConstant(40, 40, 2.0f, 2.0f, 2.0f);
	const FImageMetrics Clean = Compare(A, B);
	A.At(3, 3, 1) = NaN;
	A.At(4, 3, 0) = Infinity;
	B.At(30, 30, 2) = -Infinity;
	B.At(3, 3, 0) = NaN;
	const FImageMetrics Metrics = Compare(A, B);
	EXPECT_EQ(Metrics.NonFinite[0], 2u);
	EXPECT_EQ(Metrics.NonFinite[1], 2u);
	EXPECT_NEAR(Metrics.Mse, 1.0, 1e-12);
	EXPECT_NEAR(Metrics.RelMse, Clean.RelMse, 1e-12);
	EXPECT_NEAR(Metrics.MeanRatio[2], 0.5, 1e-12);
	EXPECT_NEAR(Metrics.Block16Median, Clean.Block16Median, 1e-9);
	EXPECT_NEAR(Metrics.Flip, Clean.Flip, 0.02);
	for (const float Error : Metrics.FlipResult.Map.Pixels) { EXPECT_TRUE(std::isfinite(Error)); }
}

TEST(Metrics, NothingLeftIsNotPerfect)
{
	const FImageMetrics Metrics = Compare(MakeConstant(16, 16, NaN, 0, 0), MakeConstant(16, 16, 1, 1, 1));
	EXPECT_EQ(Metrics.NonFinite[0], 256u);
	EXPECT_TRUE(std::isnan(Metrics.Mse));
	EXPECT_TRUE(std::isnan(Metrics.Psnr));
	EXPECT_TRUE(std::isnan(Metrics.Flip));
	EXPECT_TRUE(std::isnan(Metrics.MeanRatio[0]));
	EXPECT_TRUE(std::isnan(Metrics.Block16Median));
}

TEST(Metrics, AlphaIsIgnoredAndGreyIsExpanded)
{
	FImage Grey(8, 8, 2);
	FImage Color(8, 8, 4);
	for (size_t Pixel = 0; Pixel < 64; ++Pixel)
	{
		Grey.Pixels[Pixel * 2] = 0.5f;
		Grey.Pixels[Pixel * 2 + 1] = NaN;
		Color.Pixels[Pixel * 4] = Color.Pixels[Pixel * 4 + 1] = Color.Pixels[Pixel * 4 + 2] = 0.5f;
		Color.Pixels[Pixel * 4 + 3] = 7.0f;
	}
	const FImageMetrics Metrics = Compare(Grey, Color);
	EXPECT_EQ(Metrics.Mse, 0.0);
	EXPECT_EQ(Metrics.NonFinite[0], 0u);
}

TEST(Metrics, WhatCannotBeComparedIsRefused)
{
	FImageMetrics Metrics;
	const FRTStatus Size = CompareImages(FImage(4, 4, 3), FImage(4, 5, 3), Metrics);
	EXPECT_EQ(Size.Code, ERTResult::InvalidArgument);
	EXPECT_STREQ(Size.Message, "the images differ in size: 4 x 4 and 4 x 5");
	EXPECT_FALSE(CompareImages(FImage(4, 4, 3), FImage(4, 4, 3, EImageSpace::Display), Metrics));
	EXPECT_FALSE(CompareImages(FImage(), FImage(), Metrics));
}

class CompareCommand : public testing::Test
{
protected:
	std::string Save(const std::string& Name, const FImage& Image)
	{
		const FRTStatus Status = SaveImageFile(Folder / Name, Image);
		EXPECT_TRUE(Status) << Status.Message;
		return Folder / Name;
	}
	FTemporaryFolder Folder;
};

TEST_F(CompareCommand, WritesTheContractsJson)
{
	FCompareOptions Options;
	Options.A = Save("a.pfm", MakeConstant(20, 20, 1, 2, 3));
	Options.B = Save("b.pfm", MakeConstant(20, 20, 2, 2, 2));
	Options.Json = Folder / "out.json";
	testing::internal::CaptureStdout();
	EXPECT_EQ(RunCompare(Options), 0);
	const std::string Table = testing::internal::GetCapturedStdout();

	std::ifstream File(Options.Json);
	const nlohmann::json Json = nlohmann::json::parse(File);
	for (const char* Key : {"mse", "rmse", "relmse", "psnr", "flip", "block16_median", "block16_p95"})
	{
		EXPECT_TRUE(Json.at(Key).is_number()) << Key;
		EXPECT_NE(Table.find(Key), std::string::npos) << Key;
	}
	EXPECT_NEAR(Json.at("mse").get<double>(), 2.0 / 3.0, 1e-9);
	EXPECT_EQ(Json.at("mean_ratio"), (nlohmann::json{0.5, 1.0, 1.5}));
	EXPECT_EQ(Json.at("nonfinite"), (nlohmann::json{0, 0}));
}

TEST_F(CompareCommand, UndefinedFiguresAreNull)
{
	FCompareOptions Options;
	Options.A = Options.B = Save("a.pfm", MakeConstant(4, 4, 1, 2, 3));
	Options.Json = Folder / "out.json";
	testing::internal::CaptureStdout();
	EXPECT_EQ(RunCompare(Options), 0);
	testing::internal::GetCapturedStdout();
	std::ifstream File(Options.Json);
	const nlohmann::json Json = nlohmann::json::parse(File);
	EXPECT_TRUE(Json.at("psnr").is_null());
	EXPECT_EQ(Json.at("mse"), 0.0);
}

TEST_F(CompareCommand, HeatMapIsAPicture)
{
	if (CheckImageOutput(Folder / "heat.png").Code == ERTResult::Unsupported) { GTEST_SKIP() << "this build cannot write PNG"; }
	FCompareOptions Options;
	Options.A = Save("a.pfm", MakeConstant(20, 20, 0, 0, 0));
	Options.B = Save("b.pfm", MakeConstant(20, 20, 2, 2, 2));
	Options.Heatmap = Folder / "heat.png";
	testing::internal::CaptureStdout();
	EXPECT_EQ(RunCompare(Options), 0);
	testing::internal::GetCapturedStdout();
	FImage Heat;
	const FRTStatus Status = LoadImageFile(Options.Heatmap, Heat);
	ASSERT_TRUE(Status) << Status.Message;
	EXPECT_EQ(Heat.Width, 20u);
	EXPECT_GT(Heat.At(10, 10, 0), 0.9f) << "a large error is bright";
}

TEST_F(CompareCommand, BadInputIsExitFourAndWritesNothing)
{
	FCompareOptions Options;
	Options.A = Save("a.pfm", MakeConstant(4, 4, 1, 2, 3));
	Options.B = Save("b.pfm", MakeConstant(4, 5, 1, 2, 3));
	Options.Json = Folder / "out.json";
	testing::internal::CaptureStdout();
	EXPECT_EQ(RunCompare(Options), 4) << "sizes differ";
	Options.B = Folder / "missing.pfm";
	EXPECT_EQ(RunCompare(Options), 4);
	EXPECT_FALSE(std::filesystem::exists(Options.Json));
	Options.B = Options.A;
	Options.Json = Folder / "no/such/folder/out.json";
	EXPECT_EQ(RunCompare(Options), 4);
	EXPECT_EQ(testing::internal::GetCapturedStdout(), "") << "no result for what was not compared";
}

} // namespace

} // namespace Lantern
