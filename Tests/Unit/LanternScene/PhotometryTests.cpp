// Files of IES LM-63: good ones of each year, what is wrong with bad ones, and grids against a reading of its own.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "LanternScene/Lights/LightProfiles.h"
#include "LanternScene/Lights/Photometry.h"
#include "Support/IesText.h"
#include "Support/StatusChecks.h"

namespace Lantern
{
namespace
{

constexpr const char* Small = "TILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n100 50 0\n";

FPhotometry Parse(const std::string& Text)
{
	FPhotometry Out;
	EXPECT_OK(ParseIes(Text, "lamp.ies", Out));
	return Out;
}

FRTStatus TryParse(const std::string& Text)
{
	FPhotometry Out{{1.0f}, {2.0f}, {3.0f}};
	const FRTStatus Status = ParseIes(Text, "lamp.ies", Out);
	EXPECT_FALSE(Status) << Text;
	EXPECT_EQ(Out.Candela, std::vector<float>{3.0f}) << "nothing changes on an error";
	return Status;
}

std::string Replace(std::string Text, const std::string& From, const std::string& To)
{
	const size_t At = Text.find(From);
	EXPECT_NE(At, std::string::npos);
	return Text.replace(At, From.size(), To);
}

/// Intensity over the peak, straight from a table that goes all around, by the definition alone.
double Interpolate(const FPhotometry& Table, double Horizontal, double Vertical)
{
	size_t H = 0, V = 0;
	while (H + 2 < Table.Horizontal.size() && double(Table.Horizontal[H + 1]) <= Horizontal) { ++H; }
	while (V + 2 < Table.Vertical.size() && double(Table.Vertical[V + 1]) <= Vertical) { ++V; }
	const auto At = [&](size_t I, size_t K) { return double(Table.Candela[I * Table.Vertical.size() + K]); };
	const double X = (Horizontal - double(Table.Horizontal[H])) / double(Table.Horizontal[H + 1] - Table.Horizontal[H]);
	const double Y = (Vertical - double(Table.Vertical[V])) / double(Table.Vertical[V + 1] - Table.Vertical[V]);
	return (1 - X) * ((1 - Y) * At(H, V) + Y * At(H, V + 1)) + X * ((1 - Y) * At(H + 1, V) + Y * At(H + 1, V + 1));
}

double ReadTexel(const FProfileGrid& Grid, uint32_t Column, uint32_t Row) { return Grid.Texels[Column * Grid.Rows + Row] / 65535.0; }

TEST(Photometry, FilesOfEachYear)
{
	const std::string Body = std::string(Small).substr(10);
	for (const std::string& Head : {std::string("a lamp of 1986\nTILT=NONE\n"), std::string("IESNA91\n[TEST] x\nTILT=NONE\n"),
	         std::string("IESNA:LM-63-1995\r\n[MORE] 1 2 3\r\nTILT=NONE\r\n"), std::string("IESNA:LM-63-2002\nTILT= NONE \n"),
	         std::string("IESNA91\nTILT=INCLUDE\n1\n3\n0 90 180\n1 .95 .9\n")})
	{
		const FPhotometry Table = Parse(Head + Body);
		EXPECT_EQ(Table.Vertical, (std::vector<float>{0, 45, 90}));
		EXPECT_EQ(Table.Horizontal, std::vector<float>{0});
		EXPECT_EQ(Table.Candela, (std::vector<float>{100, 50, 0}));
	}
	// The multiplier and both ballast factors count; commas part numbers as blanks do.
	const std::string Scaled = Replace(Replace(Small, "1000 1 3", "1000 2 3"), "1 1 10", "0.5 3 10");
	EXPECT_EQ(Parse(Scaled).Candela, (std::vector<float>{300, 150, 0}));
	EXPECT_EQ(Parse(Replace(Small, "0 45 90", "0, 45,\n\n90")).Vertical, (std::vector<float>{0, 45, 90}));
	EXPECT_EQ(Parse(Replace(Small, "100 50 0", "+1e2 5.0E1 0")).Candela, (std::vector<float>{100, 50, 0}));
}

TEST(Photometry, BadFilesAreRefusedWithTheirPlace)
{
	struct FBad
	{
		std::string Text, Says;
	};
	const FBad Bad[] = {{"", "TILT="}, {"IESNA91\n[TEST]\n", "lamp.ies:2: no line begins with TILT="},
	    {Replace(Small, "3 1 1 2", "3 1 2 2"), "lamp.ies:2: photometry of type B is not supported"},
	    {Replace(Small, "3 1 1 2", "3 1 3 2"), "lamp.ies:2: photometry of type A is not supported"},
	    {Replace(Small, "3 1 1 2", "3 1 4 2"), "the photometric type is not a whole number from 1 to 3"},
	    {Replace(Small, "TILT=NONE", "TILT=other.tlt"), "lamp.ies:1: a tilt in another file"},
	    {Replace(Small, "100 50 0", "100 nan 0"), "lamp.ies:6: an intensity is no number: 'nan'"},
	    {Replace(Small, "100 50 0", "100 inf 0"), "lamp.ies:6: an intensity is no number"},
	    {Replace(Small, "100 50 0", "100 1e39 0"), "beyond what a float holds"},
	    {Replace(Small, "100 50 0", "100 1e999 0"), "is no number"}, {Replace(Small, "100 50 0", "100 -5 0"), "intensity 2 is negative"},
	    {Replace(Small, "100 50 0", "0 0 0"), "all intensities are 0"},
	    {Replace(Small, "100 50 0", "100 50"), "lamp.ies:7: the file ends before an intensity"},
	    {Replace(Small, " 3 1 1", " 1000000000 1 1"), "lamp.ies:2: the number of vertical angles"},
	    {Replace(Small, " 3 1 1", " 3 1000000000 1"), "lamp.ies:2: the number of horizontal angles"},
	    {Replace(Small, " 3 1 1", " 12 12 1"), "the file ends before"}, {Replace(Small, " 3 1 1", " -3 1 1"), "vertical angles"},
	    {Replace(Small, " 3 1 1", " 3.5 1 1"), "whole number"}, {Replace(Small, " 3 1 1", " 1 1 1"), "from 2 to"},
	    {Replace(Small, "0 45 90", "0 95 90"), "vertical angle 3 is not above the one before"},
	    {Replace(Small, "0 45 90", "0 0 90"), "vertical angle 2 is not above the one before"},
	    {Replace(Small, "0 45 90", "0 45 89"), "do not run from 0 or 90"}, {Replace(Small, "0 45 90", "5 45 90"), "do not run"},
	    {Replace(Small, "0 45 90\n0\n", "0 45 90\n7\n"), "horizontal angles run neither"},
	    {std::string("TILT=INCLUDE\n1 1000000000 0 1\n") + Small, "the number of tilt angles"}, {std::string(1000, '\0'), "TILT="},
	    {Replace(Small, "1 1 10", "1 1"), "ends before"}};
	for (const FBad& Each : Bad)
	{
		const FRTStatus Status = TryParse(Each.Text);
		EXPECT_NE(std::string(Status.Message).find(Each.Says), std::string::npos) << Status.Message << "\n" << Each.Says;
		EXPECT_EQ(std::string(Status.Message).find("lamp.ies"), 0u) << Status.Message;
	}
	EXPECT_EQ(TryParse(Bad[2].Text).Code, ERTResult::Unsupported);
	// A file that is cut anywhere is no file, or one of fewer digits.
	const std::string Whole = MakeIesText(MakeAngles(0, 90, 15), MakeAngles(0, 180, 45), [](double, double V) { return 90.0 - V + 0.5; });
	for (size_t Length = 0; Length + 10 < Whole.size(); Length += 3)
	{
		FPhotometry Out;
		EXPECT_FALSE(ParseIes(std::string_view(Whole).substr(0, Length), "cut", Out)) << Length;
	}
}

TEST(Photometry, GridsAreTheTableBetweenItsAngles)
{
	const auto Intensity = [](double H, double V) { return 10.0 + V * (200.0 - V) / 100.0 + 7.0 * std::sin(H / 57.3) * (V < 150 ? 1 : 0); };
	const FPhotometry Table = Parse(MakeIesText({0, 7.5, 10, 22.5, 40, 90, 92.5, 120, 180}, MakeAngles(0, 360, 22.5), Intensity));
	const FProfileGrid Grid = MakeProfileGrid(Table);
	EXPECT_EQ(Grid.Rows, 73u) << "2.5°";
	EXPECT_EQ(Grid.Columns, 16u);
	EXPECT_EQ(*std::max_element(Grid.Texels.begin(), Grid.Texels.end()), 65535);
	for (uint32_t Column = 0; Column < Grid.Columns; ++Column)
	{
		for (uint32_t Row = 0; Row < Grid.Rows; ++Row)
		{
			ASSERT_NEAR(ReadTexel(Grid, Column, Row) * double(Grid.Peak), Interpolate(Table, Column * 22.5, Row * 2.5),
			    0.51 / 65535.0 * double(Grid.Peak));
		}
	}
}

// Quarters, halves and halves about the other plane give what the whole gives.
TEST(Photometry, SymmetriesAreResolved)
{
	const auto Quarters = [](double H, double V) { return 5.0 + std::abs(std::cos(H * 0.0174532925)) * (90.0 - V); };
	const auto Halves = [](double H, double V) { return 100.0 + std::cos(H * 0.0174532925) * (90.0 - V); };
	const auto Others = [](double H, double V) { return 100.0 + std::sin(H * 0.0174532925) * (90.0 - V); };
	const auto Make = [](double First, double Last, auto&& Intensity) {
		return MakeProfileGrid(Parse(MakeIesText(MakeAngles(0, 90, 10), MakeAngles(First, Last, 15), Intensity)));
	};
	const auto ExpectEqual = [](const FProfileGrid& Part, const FProfileGrid& Whole) {
		ASSERT_EQ(Part.Columns, Whole.Columns);
		ASSERT_EQ(Part.Texels.size(), Whole.Texels.size());
		for (size_t I = 0; I < Part.Texels.size(); ++I) { ASSERT_NEAR(int(Part.Texels[I]), int(Whole.Texels[I]), 1) << I; }
	};
	ExpectEqual(Make(0, 90, Quarters), Make(0, 360, Quarters));
	ExpectEqual(Make(0, 180, Halves), Make(0, 360, Halves));
	ExpectEqual(Make(90, 270, Others), Make(0, 360, Others));
	const FProfileGrid Around = MakeProfileGrid(Parse(Small));
	EXPECT_EQ(Around.Columns, 1u);
	ASSERT_EQ(Around.Texels.size(), 19u) << "5°";
	EXPECT_EQ(Around.Texels[0], 65535);
	EXPECT_EQ(Around.Texels[9], 32768) << "45°";
	EXPECT_EQ(Around.Texels[18], 0);
	EXPECT_EQ(Around.Peak, 100.0f);
}

TEST(Photometry, TablesAreChecked)
{
	const FPhotometry Good = Parse(Small);
	EXPECT_OK(CheckPhotometry(Good, "table"));
	const auto IsRefused = [&](auto&& Change) {
		FPhotometry Bad = Good;
		Change(Bad);
		return !CheckPhotometry(Bad, "table").IsOk();
	};
	EXPECT_TRUE(IsRefused([](FPhotometry& T) { T.Candela.pop_back(); }));
	EXPECT_TRUE(IsRefused([](FPhotometry& T) { T.Candela[1] = std::numeric_limits<float>::quiet_NaN(); }));
	EXPECT_TRUE(IsRefused([](FPhotometry& T) { T.Vertical[1] = std::numeric_limits<float>::quiet_NaN(); }));
	EXPECT_TRUE(IsRefused([](FPhotometry& T) { T.Vertical.clear(); }));
	EXPECT_TRUE(IsRefused([](FPhotometry& T) { T.Horizontal.clear(); }));
}

TEST(LightProfiles, NumbersAndTexelsAreUsedAgain)
{
	FLightProfiles Profiles;
	EXPECT_EQ(Profiles.GetHeaders().Num() + Profiles.GetTexels().Num(), 0u) << "nothing costs nothing";
	const FProfileGrid Grid = MakeProfileGrid(Parse(Small));
	const FProfileGrid Large = MakeProfileGrid(Parse(MakeIesText(MakeAngles(0, 90, 1), {0}, [](double, double V) { return 90 - V; })));
	EXPECT_EQ(Profiles.Add(Grid), 1u);
	EXPECT_EQ(Profiles.Add(Large), 2u);
	const FLightProfile Header = Profiles.GetHeaders()[1];
	EXPECT_EQ(Header.Rows, 91u);
	EXPECT_EQ(Header.First % 2, 0u);
	for (uint32_t Row = 0; Row < Header.Rows; ++Row)
	{
		const uint32_t Texel = Header.First + Row, Word = Profiles.GetTexels()[Texel / 2];
		ASSERT_EQ((Word >> (16 * (Texel % 2))) & 0xffffu, Large.Texels[Row]);
	}
	const uint32_t Words = Profiles.GetTexels().Num();
	for (int I = 0; I < 10; ++I)
	{
		Profiles.Remove(2);
		for (uint32_t Frame = 0; Frame < FLightProfiles::KeptFrames; ++Frame) { Profiles.EndFrame(true); }
		EXPECT_EQ(Profiles.GetHeaders()[1].Rows, 0u) << "what is gone is dark";
		EXPECT_EQ(Profiles.Add(Large), 2u);
	}
	EXPECT_EQ(Profiles.GetTexels().Num(), Words);
}

// Views compare lamps with what they were in the view's last frame, which may be some frames ago.
TEST(LightProfiles, RemovedOnesShineForTheFramesThatLookBack)
{
	FProfileGrid Grid;
	Grid.Rows = Grid.Columns = 1;
	Grid.Texels = {65535};
	FLightProfiles Profiles;
	const uint32_t Number = Profiles.Add(Grid);
	Profiles.Remove(Number);
	EXPECT_TRUE(Profiles.HasRetired());
	EXPECT_EQ(Profiles.GetHeaders()[Number - 1].Rows, 1u);
	EXPECT_NE(Profiles.Add(Grid), Number) << "another one's light would be taken for it";
	for (uint32_t Frame = 0; Frame + 1 < FLightProfiles::KeptFrames; ++Frame) { Profiles.EndFrame(true); }
	Profiles.EndFrame(false);
	EXPECT_EQ(Profiles.GetHeaders()[Number - 1].Rows, 1u);
	Profiles.EndFrame(true);
	EXPECT_EQ(Profiles.GetHeaders()[Number - 1].Rows, 0u);
	EXPECT_FALSE(Profiles.HasRetired());
	EXPECT_EQ(Profiles.Add(Grid), Number);
}

} // namespace
} // namespace Lantern
