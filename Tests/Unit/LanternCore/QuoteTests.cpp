// What is shown of text that may hold anything.
#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternCore/Text/Quote.h"
#include "LanternRHI/RTStatus.h"
#include "Support/TextCheck.h"

namespace Lantern
{
namespace
{

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

/// Also of what is no character: surrogates, and beyond U+10FFFF.
std::string Encode(uint32_t Code)
{
	const auto Byte = [](uint32_t Value) { return static_cast<char>(Value); };
	const auto Next = [&](int Shift) { return Byte(0x80 | (Code >> Shift & 0x3F)); };
	if (Code < 0x80) return {Byte(Code)};
	if (Code < 0x800) return {Byte(0xC0 | Code >> 6), Next(0)};
	if (Code < 0x10000) return {Byte(0xE0 | Code >> 12), Next(6), Next(0)};
	return {Byte(0xF0 | Code >> 18), Next(12), Next(6), Next(0)};
}

struct FShown
{
	std::string Text, Shown;
};

void ExpectShown(const std::vector<FShown>& Cases)
{
	for (const FShown& Case : Cases)
	{
		EXPECT_EQ(EscapeText(Case.Text), Case.Shown);
		EXPECT_EQ(EscapeText("<" + Case.Text + ">"), "<" + Case.Shown + ">");
		EXPECT_EQ(EscapeText(Case.Shown), Case.Shown) << "escaping twice changes nothing";
		EXPECT_TRUE(IsCleanText(Case.Shown));
	}
}

TEST(TextCheck, FindsWhatItIsFor)
{
	for (const char* Clean : {"", "plain ~", "\xC3\xA4", "\xE2\x80\xA6", "\xF0\x9F\x91\xA9\xE2\x80\x8D\xF0\x9F\x9A\x80"})
		EXPECT_TRUE(IsCleanText(Clean)) << Clean;
	for (const char* Unclean : {"\n", "\t", "\x1b[31m", "\x7f", "\xC2\x85", "\xE2\x80\xAE", "\xE2\x80\xA8", "\xE2\x81\xA6", "\xEF\xBB\xBF",
	         "\xff", "a\x80", "\xC3", "\xE2\x80", "\xC0\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80"})
		EXPECT_FALSE(IsCleanText(Unclean));
	EXPECT_FALSE(IsCleanText(std::string_view("\0", 1)));
	EXPECT_TRUE(AreCleanLines("a\n\tb"));
	EXPECT_FALSE(AreCleanLines("a\r\n"));
}

TEST(EscapeText, EveryByteAlone)
{
	constexpr const char* Digits = "0123456789abcdef";
	for (int Byte = 0; Byte < 256; ++Byte)
	{
		const std::string Text(1, static_cast<char>(Byte));
		std::string Expected = {'\\', 'x', Digits[Byte >> 4], Digits[Byte & 15]};
		if (Byte >= 0x20 && Byte < 0x7F) Expected = Text;
		else if (Byte == '\n' || Byte == '\r' || Byte == '\t') Expected = Byte == '\n' ? "\\n" : Byte == '\r' ? "\\r" : "\\t";
		ExpectShown({{Text, Expected}});
	}
}

TEST(EscapeText, WhatPeopleWriteStaysAsItIs)
{
	for (const char* Text : {"", "plain 'text' \"quoted\" 100 %", "C:\\new\\x41", "naïve Ωμέγα 日本語 العربية", "e\u0301 …",
	         "\U0001F469\u200D\U0001F680", "\u0915\u094D\u200C\u0937", "\uE000", "\U0010FFFD", "\U00020000"})
	{
		EXPECT_EQ(EscapeText(Text), Text);
		EXPECT_EQ(EscapeLines(Text), Text);
	}
}

TEST(EscapeText, CharactersThatSteerOrHide)
{
	ExpectShown({
	    {"\u0080", "\\u{0080}"},
	    {"\u0085", "\\u{0085}"},
	    {"\u009F", "\\u{009f}"},
	    {"\u061C", "\\u{061c}"},
	    {"\u200B", "\\u{200b}"},
	    {"\u200E\u200F", "\\u{200e}\\u{200f}"},
	    {"\u2028\u2029", "\\u{2028}\\u{2029}"},
	    {"\u202A\u202E", "\\u{202a}\\u{202e}"},
	    {"\u2066\u2069", "\\u{2066}\\u{2069}"},
	    {"\uFEFF", "\\u{feff}"},
	    {"\uFFFE\uFFFF", "\\u{fffe}\\u{ffff}"},
	    {"\U000E0041", "\\u{e0041}"},
	    {"\U0010FFFF", "\\u{10ffff}"},
	});
}

TEST(EscapeText, WhatIsNoUtf8IsShownByteByByte)
{
	ExpectShown({
	    {"\xBF\x80", "\\xbf\\x80"},                   // continuations of nothing
	    {"\xC0\x8A", "\\xc0\\x8a"},                   // overlong: a line break in two bytes,
	    {"\xE0\x80\x8A", "\\xe0\\x80\\x8a"},          // in three
	    {"\xF0\x80\x80\x8A", "\\xf0\\x80\\x80\\x8a"}, // and in four
	    {"\xE0\x9F\xBF", "\\xe0\\x9f\\xbf"},
	    {"\xED\xA0\x80", "\\xed\\xa0\\x80"}, // surrogates
	    {"\xED\xBF\xBF", "\\xed\\xbf\\xbf"},
	    {"\xF4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"}, // beyond the last character
	    {"\xF8\x88\x80\x80\x80", "\\xf8\\x88\\x80\\x80\\x80"},
	    {"\xFE\xFF", "\\xfe\\xff"},
	    {"\xC3", "\\xc3"}, // cut off
	    {"\xE2\x82", "\\xe2\\x82"},
	    {"\xF0\x9F\x98", "\\xf0\\x9f\\x98"},
	    {"\xE2\x82\xE2\x82\xAC", "\\xe2\\x82€"}, // and begun anew
	    {"\xC3\n", "\\xc3\\n"},
	});
	EXPECT_EQ(EscapeText(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(EscapeText, EveryCharacterThereIs)
{
	std::string All;
	for (uint32_t Code = 0; Code < 0x110100; ++Code) All += Encode(Code);
	const std::string Shown = EscapeText(All), Lines = EscapeLines(All);
	EXPECT_EQ(TextCheck::FindUnclean(Shown, ""), Shown.size());
	EXPECT_EQ(TextCheck::FindUnclean(Lines, "\n\t"), Lines.size());
	EXPECT_EQ(EscapeText(Shown), Shown);
	// Most are shown: the text has not become a heap of escapes. 2,048 surrogates and 256 beyond the end at up to 16
	// bytes each, and some hundred that steer or hide.
	EXPECT_LT(Shown.size(), All.size() + 40'000);
}

TEST(EscapeText, AnyBytes)
{
	std::mt19937 Random(1);
	for (int Round = 0; Round < 3000; ++Round)
	{
		std::string Text(Random() % 300, '\0');
		for (char& C : Text) C = static_cast<char>(Random() % 3 ? 0x80 | Random() : Random());
		const std::string Shown = EscapeText(Text);
		ASSERT_TRUE(IsCleanText(Shown)) << Shown;
		ASSERT_EQ(EscapeText(Shown), Shown);
		ASSERT_TRUE(AreCleanLines(EscapeLines(Text)));
		const size_t Max = 3 + Random() % 80;
		const std::string Cut = EscapeText(Text, Max);
		ASSERT_TRUE(IsCleanText(Cut)) << Cut;
		ASSERT_LE(Cut.size(), Max);
		ASSERT_TRUE(Cut == Shown || (Cut.ends_with("…") && Shown.starts_with(Cut.substr(0, Cut.size() - 3)))) << Cut;
		ASSERT_EQ(Cut == Shown, Shown.size() <= Max);
		ASSERT_TRUE(IsCleanText(EscapePath(Text)) && IsCleanText(Quote(Text)));
	}
}

TEST(EscapeLines, KeepsLineBreaksAndTabsAndNothingElse)
{
	EXPECT_EQ(
	    EscapeLines("A.glsl:3: 'x'\n\tB.glsl:4\r\n\x1b[31m\v\xff\u2028"), "A.glsl:3: 'x'\n\tB.glsl:4\\r\n\\x1b[31m\\x0b\\xff\\u{2028}");
}

TEST(Quote, ShowsWhatIsShortWholeAndOfTheRestItsLength)
{
	EXPECT_EQ(Quote(""), "''");
	EXPECT_EQ(Quote("a b"), "'a b'");
	EXPECT_EQ(Quote("a\nerror: b"), "'a\\nerror: b'");
	EXPECT_EQ(Quote(std::string(MaxQuotedBytes, 'x')), "'" + std::string(MaxQuotedBytes, 'x') + "'");
	EXPECT_EQ(Quote(std::string(MaxQuotedBytes + 1, 'x')),
	    "'" + std::string(MaxQuotedBytes - 3, 'x') + "…' (" + std::to_string(MaxQuotedBytes + 1) + " bytes)");
	EXPECT_THAT(Quote(std::string(MaxQuotedBytes, '\1')), EndsWith("\\x01…' (" + std::to_string(MaxQuotedBytes) + " bytes)"))
	    << "short, but not when it is escaped";
	for (const char* Piece : {"x", "\xff", "ä", "€", "😀", "\u202E"})
	{
		std::string Huge;
		while (Huge.size() < 10'000'000) Huge += Piece;
		const std::string Shown = Quote(Huge);
		EXPECT_LT(Shown.size(), MaxQuotedBytes + 30);
		EXPECT_TRUE(IsCleanText(Shown)) << Shown;
		EXPECT_THAT(Shown, HasSubstr("…' (" + std::to_string(Huge.size()) + " bytes)"));
	}
}

TEST(EscapePath, LosesItsMiddleWhenItIsLong)
{
	EXPECT_EQ(EscapePath("/a/b\xff\n.gltf"), "/a/b\\xff\\n.gltf");
	const std::string Long = EscapePath("/start/" + std::string(5000, 'x') + "/end.gltf");
	EXPECT_LE(Long.size(), MaxPathBytes);
	EXPECT_THAT(Long, testing::AllOf(StartsWith("/start/"), HasSubstr("…"), EndsWith("/end.gltf")));
	for (size_t Shift = 0; Shift < 4; ++Shift)
	{
		std::string Path(Shift, 'x');
		while (Path.size() < 1000) Path += "😀ä";
		const std::string Shown = EscapePath(Path);
		EXPECT_TRUE(IsCleanText(Shown)) << Shown;
		EXPECT_EQ(Shown.find('\\'), std::string::npos) << "a character was cut in two: " << Shown;
		EXPECT_LE(Shown.size(), MaxPathBytes);
	}
}

TEST(Status, IsCutBetweenCharacters)
{
	constexpr size_t Room = FRTStatus::MaxMessage - 1;
	for (size_t Length = Room - 8; Length <= Room + 8; ++Length)
	{
		for (const std::string Piece : {"a", "ä", "€", "😀"})
		{
			std::string Text(Length % Piece.size(), 'a');
			while (Text.size() < Length) Text += Piece;
			const std::string Message = FRTStatus::Error(ERTResult::IoError, "%s", Text.c_str()).Message;
			EXPECT_TRUE(IsCleanText(Message)) << Message;
			EXPECT_EQ(Message.find('\\'), std::string::npos) << "a character was cut in two: " << Message;
			if (Text.size() <= Room) EXPECT_EQ(Message, Text);
			else EXPECT_THAT(Message, EndsWith("..."));
			EXPECT_GE(Message.size(), std::min(Text.size(), Room - 6)) << "more was cut than had to be";
		}
	}
}

TEST(Status, HoldsNothingThatCannotBeShown)
{
	const auto Make = [](const std::string& Text) {
		return std::string(FRTStatus::Error(ERTResult::IoError, "a: %s", Text.c_str()).Message);
	};
	EXPECT_EQ(Make("two\n\tlines"), "a: two\n\tlines") << "as a shader's log is";
	EXPECT_EQ(Make("\x1b[31m\r\xff\u202E"), "a: \\x1b[31m\\r\\xff\\u{202e}");
	for (size_t Shift = 0; Shift < 12; ++Shift)
	{
		const std::string Message = Make(std::string(Shift, 'x') + std::string(5000, '\xff'));
		EXPECT_TRUE(IsCleanText(Message));
		EXPECT_THAT(Message, EndsWith("..."));
		EXPECT_LT(Message.size(), FRTStatus::MaxMessage);
	}
}

TEST(Status, NamesOfObjectsAreShortAndOneLine)
{
	EXPECT_STREQ(FRTShown(nullptr).Text, "");
	EXPECT_STREQ(FRTShown("Wall").Text, "Wall");
	EXPECT_STREQ(FRTShown("Wall\nerror: \xff").Text, "Wall\\nerror: \\xff");
	for (size_t Length = 0; Length < 300; ++Length)
	{
		for (const char* Piece : {"x", "\x01", "ä", "😀"})
		{
			std::string Name(Length % 7, 'n');
			while (Name.size() < Length) Name += Piece;
			const std::string Shown = FRTShown(Name.c_str()).Text;
			EXPECT_EQ(Shown, EscapeText(Name, FRTShown::MaxBytes));
			EXPECT_TRUE(IsCleanText(Shown));
		}
	}
}

} // namespace
} // namespace Lantern
