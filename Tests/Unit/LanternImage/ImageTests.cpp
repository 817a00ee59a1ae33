#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternImage/AtomicFile.h"
#include "LanternImage/ColorMap.h"
#include "LanternImage/ImageIO.h"
#include "LanternImage/ImageStatistics.h"
#include "LanternImage/ToneMap.h"
#include "Support/SharedFiles.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#endif

namespace Lantern
{

namespace
{

/// libpng leaves OpenImageIO's reader by longjmp where a file is damaged, past the destructors of a few strings.
/// That leak is not ours to mend.
class FIgnoreLeaks
{
#if defined(__SANITIZE_ADDRESS__)
	__lsan::ScopedDisabler Disabler;
#endif
};

using testing::HasSubstr;

constexpr float NaN = std::numeric_limits<float>::quiet_NaN();
constexpr float Infinity = std::numeric_limits<float>::infinity();

FImage MakePattern(uint32_t Width, uint32_t Height, uint32_t Channels, EImageSpace Space = EImageSpace::Linear)
{
	FImage Image(Width, Height, Channels, Space);
	for (size_t Index = 0; Index < Image.Pixels.size(); ++Index) { Image.Pixels[Index] = static_cast<float>(Index % 256) / 255.0f; }
	return Image;
}

std::string ReadBytes(const std::string& Path)
{
	std::ifstream File(Path, std::ios::binary);
	return {std::istreambuf_iterator<char>(File), std::istreambuf_iterator<char>()};
}

void WriteBytes(const std::string& Path, const std::string& Bytes) { std::ofstream(Path, std::ios::binary) << Bytes; }

size_t CountFiles(const std::filesystem::path& Folder)
{
	return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(Folder), std::filesystem::directory_iterator()));
}

bool CanWrite(const std::string& Ending) { return CheckImageOutput("name" + Ending).Code != ERTResult::Unsupported; }

// ---------------------------------------------------------------------------------------------------- files

class RoundTrip : public testing::TestWithParam<std::tuple<const char*, uint32_t>>
{};

TEST_P(RoundTrip, KeepsRadianceAndPictures)
{
	const auto& [Ending, Channels] = GetParam();
	if (!CanWrite(Ending)) { GTEST_SKIP() << "this build cannot write " << Ending; }
	const bool bPicture = std::strcmp(Ending, ".png") == 0;
	FImage Saved = MakePattern(13, 7, Channels, bPicture ? EImageSpace::Display : EImageSpace::Linear);
	if (!bPicture)
	{
		Saved.At(2, 1, 0) = 1.0e20f;
		Saved.At(3, 1, 0) = -0.123456789f;
	}
	const FTemporaryFolder Folder;
	const std::string Path = Folder / (std::string("image") + Ending);
	const FRTStatus SaveStatus = SaveImageFile(Path, Saved);
	ASSERT_TRUE(SaveStatus) << SaveStatus.Message;
	FImage Loaded;
	const FRTStatus LoadStatus = LoadImageFile(Path, Loaded);
	ASSERT_TRUE(LoadStatus) << LoadStatus.Message;
	EXPECT_EQ(Loaded.Width, 13u);
	EXPECT_EQ(Loaded.Height, 7u);
	EXPECT_EQ(Loaded.Channels, Channels);
	EXPECT_EQ(Loaded.Space, Saved.Space);
	// A code over 255 may be rounded either way; all else is exact.
	EXPECT_THAT(Loaded.Pixels, testing::Pointwise(testing::FloatNear(bPicture ? 1e-6f : 0.0f), Saved.Pixels));
	EXPECT_EQ(CountFiles(Folder.Get()), 1u) << "a temporary file is left";
}

INSTANTIATE_TEST_SUITE_P(, RoundTrip,
    testing::Values(std::tuple(".pfm", 1u), std::tuple(".pfm", 3u), std::tuple(".exr", 1u), std::tuple(".exr", 2u), std::tuple(".exr", 3u),
        std::tuple(".exr", 4u), std::tuple(".png", 1u), std::tuple(".png", 2u), std::tuple(".png", 3u), std::tuple(".png", 4u)),
    [](const auto& Info) { return (std::get<0>(Info.param) + 1) + std::to_string(std::get<1>(Info.param)); });

TEST(ImageFiles, PfmIsLittleEndianFromTheBottom)
{
	FImage Image(1, 2, 1);
	Image.Pixels = {1.0f, 2.0f};
	const FTemporaryFolder Folder;
	ASSERT_TRUE(SaveImageFile(Folder / "a.pfm", Image));
	EXPECT_EQ(ReadBytes(Folder / "a.pfm"), std::string("Pf\n1 2\n-1.0\n\0\0\0\x40\0\0\x80\x3f", 20));
}

TEST(ImageFiles, PfmReadsBigEndianAndCarriageReturns)
{
	const FTemporaryFolder Folder;
	WriteBytes(Folder / "a.pfm", std::string("Pf\r\n2 1\r\n1.0\r\n\x3f\x80\0\0\x40\0\0\0", 22));
	FImage Image;
	const FRTStatus Status = LoadImageFile(Folder / "a.pfm", Image);
	ASSERT_TRUE(Status) << Status.Message;
	EXPECT_EQ(Image.Pixels, (std::vector<float>{1.0f, 2.0f}));
}

TEST(ImageFiles, PfmDropsAlpha)
{
	const FTemporaryFolder Folder;
	FImage Image(1, 1, 4);
	Image.Pixels = {1.0f, 2.0f, 3.0f, 0.5f};
	ASSERT_TRUE(SaveImageFile(Folder / "a.pfm", Image));
	FImage Loaded;
	ASSERT_TRUE(LoadImageFile(Folder / "a.pfm", Loaded));
	EXPECT_EQ(Loaded.Pixels, (std::vector<float>{1.0f, 2.0f, 3.0f}));
}

TEST(ImageFiles, EndingDecidesTheSpace)
{
	if (!CanWrite(".png")) { GTEST_SKIP() << "this build cannot write PNG"; }
	const FTemporaryFolder Folder;
	FImage Linear(4, 1, 3);
	Linear.Pixels = {0.5f, 0.0f, 1.0f, 9.0f, -1.0f, NaN, Infinity, 0.2f, 0.7f, 0.001f, 0.002f, 0.003f};
	ASSERT_TRUE(SaveImageFile(Folder / "a.png", Linear));
	FImage Loaded;
	ASSERT_TRUE(LoadImageFile(Folder / "a.png", Loaded));
	EXPECT_EQ(Loaded.Space, EImageSpace::Display);
	EXPECT_NEAR(Loaded.At(0, 0, 0) * 255.0f, 188.0f, 0.01f) << "0.5 linear is 188 in sRGB";
	EXPECT_EQ(Loaded.At(1, 0, 0), 1.0f);
	EXPECT_EQ(Loaded.At(1, 0, 1), 0.0f);
	EXPECT_EQ(Loaded.At(1, 0, 2), 0.0f) << "NaN";
	EXPECT_EQ(Loaded.At(2, 0, 0), 1.0f) << "infinity";

	FImage Display(1, 1, 3, EImageSpace::Display);
	Display.Pixels = {0.5f, 0.0f, 1.0f};
	ASSERT_TRUE(SaveImageFile(Folder / "a.exr", Display));
	ASSERT_TRUE(LoadImageFile(Folder / "a.exr", Loaded));
	EXPECT_NEAR(Loaded.At(0, 0, 0), 0.2140f, 1e-4f);
}

struct FHostile
{
	const char* Name;
	std::string Bytes;
	const char* Reason;
};

class HostilePfm : public testing::TestWithParam<FHostile>
{};

TEST_P(HostilePfm, IsOneClearError)
{
	const FTemporaryFolder Folder;
	const std::string Path = Folder / "hostile.pfm";
	WriteBytes(Path, GetParam().Bytes);
	FImage Image(1, 1, 1);
	const FRTStatus Status = LoadImageFile(Path, Image);
	EXPECT_EQ(Status.Code, ERTResult::IoError);
	EXPECT_THAT(Status.Message, HasSubstr("hostile.pfm: "));
	EXPECT_THAT(Status.Message, HasSubstr(GetParam().Reason));
	EXPECT_EQ(Image.Width, 1u) << "the image passed in must be untouched";
}

INSTANTIATE_TEST_SUITE_P(, HostilePfm,
    testing::Values(FHostile{"Empty", "", "not a PFM"}, FHostile{"OtherFormat", "\x89PNG\r\n\x1a\n", "not a PFM"},
        FHostile{"NoSize", "PF\n", "lacks a width"}, FHostile{"HalfASize", "PF\n12", "lacks a width"},
        FHostile{"WordAsSize", "PF\nten 10\n-1\n", "lacks a width"},
        FHostile{"Overflow", "PF\n99999999999999999999 1\n-1\n", "lacks a width"},
        FHostile{"EndlessToken", "PF\n" + std::string(100'000, '1'), "lacks a width"},
        FHostile{"NegativeSize", "PF\n-4 4\n-1\n", "out of range"}, FHostile{"ZeroSize", "PF\n0 4\n-1\n", "out of range"},
        FHostile{"HugeSize", "PF\n100000 100000\n-1\n", "out of range"}, FHostile{"ManyPixels", "PF\n65535 65535\n-1\n", "out of range"},
        FHostile{"BigAndTruncated", "PF\n10000 10000\n-1\n1234", "ends early"}, FHostile{"OneByteShort", "Pf\n1 1\n-1\n123", "ends early"},
        FHostile{"NanScale", "Pf\n1 1\nnan\n1234", "scale"}, FHostile{"InfiniteScale", "Pf\n1 1\n-inf\n1234", "scale"},
        FHostile{"ZeroScale", "Pf\n1 1\n0\n1234", "scale"}, FHostile{"NoScale", "Pf\n1 1\n", "scale"}),
    [](const auto& Info) { return std::string(Info.param.Name); });

TEST(ImageFiles, UnreadablePathsSayWhy)
{
	const FTemporaryFolder Folder;
	FImage Image;
	EXPECT_THAT(LoadImageFile(Folder / "none.exr", Image).Message, HasSubstr("none.exr: no such file"));
	EXPECT_THAT(LoadImageFile(Folder.Get(), Image).Message, HasSubstr("is a folder"));
	EXPECT_THAT(LoadImageFile("", Image).Message, HasSubstr("no such file"));
	EXPECT_THAT(LoadImageFile("/dev/zero", Image).Message, HasSubstr("not a regular file"));
}

TEST(ImageFiles, DamagedFilesSayWhy)
{
	if (!CanWrite(".exr")) { GTEST_SKIP() << "this build cannot write EXR"; }
	const FTemporaryFolder Folder;
	FImage Image(1, 1, 1);
	for (const char* Name : {"damaged.exr", "damaged.png"})
	{
		ASSERT_TRUE(SaveImageFile(Folder / Name, MakePattern(64, 64, 3)));
		const std::string Whole = ReadBytes(Folder / Name);
		for (const size_t Length : {size_t(0), size_t(7), Whole.size() / 4, Whole.size() * 3 / 4})
		{
			WriteBytes(Folder / Name, Whole.substr(0, Length));
			[[maybe_unused]] const FIgnoreLeaks IgnoreLeaks;
			const FRTStatus Status = LoadImageFile(Folder / Name, Image);
			EXPECT_EQ(Status.Code, ERTResult::IoError) << Name << " cut to " << Length;
			EXPECT_THAT(Status.Message, HasSubstr(Name));
			EXPECT_EQ(std::strchr(Status.Message, '\n'), nullptr) << "one line";
			EXPECT_EQ(Image.Width, 1u);
		}
	}
}

TEST(ImageFiles, FailedWritesLeaveEverythingAsItWas)
{
	const FTemporaryFolder Folder;
	const FImage Image = MakePattern(4, 4, 3);
	EXPECT_THAT(SaveImageFile(Folder / "none/a.pfm", Image).Message, HasSubstr("its folder does not exist"));
	EXPECT_THAT(SaveImageFile(Folder / "a.bmp", Image).Message, HasSubstr("must be .exr, .png or .pfm"));
	EXPECT_THAT(SaveImageFile(Folder / "a", Image).Message, HasSubstr("must be .exr, .png or .pfm"));
	EXPECT_THAT(SaveImageFile(Folder / "a.pfm", FImage()).Message, HasSubstr("out of range"));
	std::filesystem::create_directory(Folder / "folder.pfm");
	EXPECT_THAT(SaveImageFile(Folder / "folder.pfm", Image).Message, HasSubstr("it is a folder"));
	EXPECT_EQ(CountFiles(Folder.Get()), 1u);
}

TEST(ImageFiles, WithoutTheLibraryTheOptionIsNamed)
{
	if (CanWrite(".exr")) { GTEST_SKIP() << "this build has OpenImageIO"; }
	const FTemporaryFolder Folder;
	EXPECT_THAT(SaveImageFile(Folder / "a.exr", MakePattern(4, 4, 3)).Message, HasSubstr("LANTERN_WITH_OIIO=OFF"));
	WriteBytes(Folder / "a.png", "x");
	FImage Image;
	EXPECT_THAT(LoadImageFile(Folder / "a.png", Image).Message, HasSubstr("LANTERN_WITH_OIIO=OFF"));
}

TEST(AtomicFile, KeepsTheOldFileWhereTheNewOneFails)
{
	const FTemporaryFolder Folder;
	const std::string Path = Folder / "file.txt";
	ASSERT_TRUE(WriteFileAtomically(Path, "old"));
	const FRTStatus Failed = WriteFileAtomically(Path, [&](const std::string& Temporary) {
		WriteBytes(Temporary, "half of the n");
		EXPECT_EQ(ReadBytes(Path), "old") << "visible before it is whole";
		return FRTStatus::Error(ERTResult::IoError, "disk full");
	});
	EXPECT_STREQ(Failed.Message, "disk full");
	EXPECT_EQ(ReadBytes(Path), "old");
	EXPECT_FALSE(WriteFileAtomically(Path, [](const std::string&) -> FRTStatus { throw std::runtime_error("thrown"); }));
	EXPECT_EQ(CountFiles(Folder.Get()), 1u);
	ASSERT_TRUE(WriteFileAtomically(Path, "new"));
	EXPECT_EQ(ReadBytes(Path), "new");
}

TEST(AtomicFile, FollowsSymbolicLinks)
{
	const FTemporaryFolder Folder;
	std::filesystem::create_symlink("target.txt", Folder / "link.txt");
	ASSERT_TRUE(WriteFileAtomically(Folder / "link.txt", "text"));
	EXPECT_TRUE(std::filesystem::is_symlink(Folder / "link.txt"));
	EXPECT_EQ(ReadBytes(Folder / "target.txt"), "text");
}

TEST(AtomicFile, LongPathsDoNotCutTheReason)
{
	const FRTStatus Status = MakeFileError(ERTResult::IoError, std::string(4000, 'p'), "the reason");
	EXPECT_THAT(Status.Message, HasSubstr(": the reason"));
}

// ---------------------------------------------------------------------------------------------------- colour

TEST(ToneMap, SrgbKnownValuesAndInverse)
{
	EXPECT_NEAR(LinearToSrgb(0.18f), 0.46135f, 1e-5f);
	EXPECT_NEAR(LinearToSrgb(0.001f), 0.01292f, 1e-6f);
	EXPECT_FLOAT_EQ(LinearToSrgb(1.0f), 1.0f);
	EXPECT_EQ(LinearToSrgb(-1.0f), 0.0f);
	EXPECT_EQ(LinearToSrgb(NaN), 0.0f);
	for (int Code = 0; Code <= 255; ++Code)
	{
		const float Encoded = static_cast<float>(Code) / 255.0f;
		EXPECT_NEAR(LinearToSrgb(SrgbToLinear(Encoded)), Encoded, 2e-6f);
	}
}

TEST(ToneMap, CurveRisesFromBlackToWhite)
{
	EXPECT_EQ(ToneMapAces(0.0f), 0.0f);
	EXPECT_EQ(ToneMapAces(-3.0f), 0.0f);
	EXPECT_EQ(ToneMapAces(NaN), 0.0f);
	EXPECT_EQ(ToneMapAces(Infinity), 1.0f);
	EXPECT_NEAR(ToneMapAces(1.0f), 2.54 / 3.16, 1e-6);
	float Previous = 0.0f;
	for (float Value = 1e-4f; Value < 10.0f; Value *= 1.1f)
	{
		EXPECT_GE(ToneMapAces(Value), Previous);
		EXPECT_LE(ToneMapAces(Value), 1.0f);
		Previous = ToneMapAces(Value);
	}
}

TEST(ToneMap, ExposureIsInStopsAndAlphaIsKept)
{
	FImage Image(1, 1, 4);
	Image.Pixels = {0.1f, 0.2f, 0.4f, 0.3f};
	const FImage Mapped = ToneMapImage(Image, 2.0f);
	EXPECT_EQ(Mapped.Space, EImageSpace::Display);
	EXPECT_FLOAT_EQ(Mapped.At(0, 0, 0), LinearToSrgb(ToneMapAces(0.4f)));
	EXPECT_FLOAT_EQ(Mapped.At(0, 0, 3), 0.3f);
	EXPECT_EQ(ToneMapImage(Mapped, 5.0f).Pixels, Mapped.Pixels) << "a picture is not mapped twice";
}

TEST(ColorMap, MeetsTheTableBetweenItsAnchors)
{
	// Entries of the full table that are not among the anchors.
	const struct
	{
		int Index;
		float Rgb[3];
	} Entries[] = {{0, {0.001462f, 0.000466f, 0.013866f}}, {8, {0.013708f, 0.011771f, 0.068667f}}, {64, {0.316654f, 0.071690f, 0.485380f}},
	    {128, {0.716387f, 0.214982f, 0.475290f}}, {192, {0.986700f, 0.535582f, 0.382210f}}, {255, {0.987053f, 0.991438f, 0.749504f}}};
	for (const auto& Entry : Entries)
	{
		float Rgb[3] = {};
		GetMagmaColor(static_cast<float>(Entry.Index) / 255.0f, Rgb);
		for (int Channel = 0; Channel < 3; ++Channel) { EXPECT_NEAR(Rgb[Channel], Entry.Rgb[Channel], 0.01f) << Entry.Index; }
	}
	float Broken[3] = {};
	GetMagmaColor(NaN, Broken);
	EXPECT_EQ(Broken[1], 1.0f);
}

// ---------------------------------------------------------------------------------------------------- statistics

TEST(ImageStatistics, MeansSkipBrokenPixelsAndStayInTheRectangle)
{
	FImage Image(4, 2, 3);
	for (size_t Index = 0; Index < Image.Pixels.size(); ++Index) { Image.Pixels[Index] = static_cast<float>(Index % 3 + 1); }
	Image.At(3, 0, 0) = NaN;
	Image.At(3, 1, 0) = 100.0f;
	const FImageMeans All = ComputeMeans(Image);
	EXPECT_EQ(All.PixelCount, 7u);
	EXPECT_NEAR(All.Channel[0], 106.0 / 7.0, 1e-9);
	EXPECT_NEAR(All.Channel[2], 3.0, 1e-9);
	const FImageMeans Left = ComputeMeans(Image, 0, 0, 3, 99);
	EXPECT_EQ(Left.PixelCount, 6u);
	EXPECT_NEAR(Left.Luminance, 0.2126 + 0.7152 * 2 + 0.0722 * 3, 1e-6);
	EXPECT_TRUE(std::isnan(ComputeMeans(Image, 2, 0, 2, 2).Luminance));
	EXPECT_EQ(CountNonFinitePixels(Image), 1u);
}

TEST(ImageStatistics, BlocksCoverTheEdges)
{
	FImage Image(20, 17, 1);
	Image.At(19, 16, 0) = 8.0f;
	const std::vector<double> Means = ComputeBlockMeans(Image, 16);
	ASSERT_EQ(Means.size(), 4u);
	EXPECT_EQ(Means[0], 0.0);
	EXPECT_NEAR(Means[3], 8.0 / 4.0, 1e-9) << "the last block has 4 x 1 pixels";
}

TEST(ImageStatistics, PercentilesInterpolate)
{
	EXPECT_EQ(ComputePercentile({3.0, 1.0, 2.0}, 0.5), 2.0);
	EXPECT_NEAR(ComputePercentile({4.0, 1.0, 2.0, 3.0}, 0.5), 2.5, 1e-12);
	EXPECT_NEAR(ComputePercentile({0.0, 10.0}, 0.95), 9.5, 1e-12);
	EXPECT_TRUE(std::isnan(ComputePercentile({}, 0.5)));
}

TEST(ImageStatistics, MasksOverlap)
{
	FImage Image(4, 1, 1);
	Image.Pixels = {0.0f, 1.0f, 2.0f, NaN};
	EXPECT_EQ(MakeLuminanceMask(Image, 0.5f), (std::vector<uint8_t>{0, 1, 1, 0}));
	EXPECT_EQ(MakeLuminanceMask(Image, 0.5f, true), (std::vector<uint8_t>{1, 0, 0, 0}));
	EXPECT_NEAR(ComputeMaskOverlap({1, 1, 0, 0}, {0, 1, 1, 0}), 1.0 / 3.0, 1e-12);
	EXPECT_EQ(ComputeMaskOverlap({0, 0}, {0, 0}), 1.0);
}

TEST(Image, SizeLimits)
{
	EXPECT_TRUE(IsImageSizeValid(1, 1));
	EXPECT_TRUE(IsImageSizeValid(7680, 4320));
	EXPECT_FALSE(IsImageSizeValid(0, 1));
	EXPECT_FALSE(IsImageSizeValid(100'000, 1));
	EXPECT_FALSE(IsImageSizeValid(60'000, 60'000));
	EXPECT_FALSE(IsImageSizeValid(~uint64_t(0), ~uint64_t(0)));
}

} // namespace

} // namespace Lantern
