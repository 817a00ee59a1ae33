// Whether a text may go to a terminal and into a log as it is. Written apart from what escapes, so that it can find
// faults in that: from the table of well-formed UTF-8 in the Unicode standard. No GoogleTest: fuzzers use it too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace Lantern
{

namespace TextCheck
{

/// A row of table 3-7: leading bytes, and which second bytes they allow. Third and fourth ones are always 80 to BF.
struct FForm
{
	uint8_t FirstMin, FirstMax, SecondMin, SecondMax;
	size_t Length;
};

inline constexpr FForm Forms[] = {
    {0x00, 0x7F, 0x00, 0x00, 1},
    {0xC2, 0xDF, 0x80, 0xBF, 2},
    {0xE0, 0xE0, 0xA0, 0xBF, 3},
    {0xE1, 0xEC, 0x80, 0xBF, 3},
    {0xED, 0xED, 0x80, 0x9F, 3},
    {0xEE, 0xEF, 0x80, 0xBF, 3},
    {0xF0, 0xF0, 0x90, 0xBF, 4},
    {0xF1, 0xF3, 0x80, 0xBF, 4},
    {0xF4, 0xF4, 0x80, 0x8F, 4},
};

inline bool IsBetween(char C, uint8_t Min, uint8_t Max)
{
	const auto Byte = static_cast<uint8_t>(C);
	return Byte >= Min && Byte <= Max;
}

/// Bytes of the well-formed character that Text begins with; 0: none.
inline size_t GetLength(std::string_view Text)
{
	for (const FForm& Form : Forms)
	{
		if (!IsBetween(Text[0], Form.FirstMin, Form.FirstMax)) { continue; }
		bool bWhole = Text.size() >= Form.Length;
		for (size_t I = 1; bWhole && I < Form.Length; ++I)
		{
			bWhole = IsBetween(Text[I], I == 1 ? Form.SecondMin : 0x80, I == 1 ? Form.SecondMax : 0xBF);
		}
		return bWhole ? Form.Length : 0;
	}
	return 0;
}

/// What is well-formed and must still not be shown.
inline bool IsControl(std::string_view Character)
{
	if (Character.size() == 1) { return IsBetween(Character[0], 0x00, 0x1F) || Character[0] == 0x7F; }
	if (Character.size() == 2)
	{
		return Character[0] == '\xC2' && IsBetween(Character[1], 0x80, 0x9F); // C1
	}
	const std::string_view Start = Character.substr(0, 2);
	if (Start == "\xE2\x80") // U+200E, U+200F, U+2028 to U+202E
	{
		return IsBetween(Character[2], 0x8E, 0x8F) || IsBetween(Character[2], 0xA8, 0xAE);
	}
	return (Start == "\xE2\x81" && IsBetween(Character[2], 0xA6, 0xA9)) || Character == "\xEF\xBB\xBF";
}

/// Where the first byte lies that must not be shown; Text.size(): nowhere.
inline size_t FindUnclean(std::string_view Text, std::string_view Allowed)
{
	size_t Place = 0;
	while (Place < Text.size())
	{
		const size_t Length = GetLength(Text.substr(Place));
		const bool bAllowed = Allowed.find(Text[Place]) != std::string_view::npos;
		if (Length == 0 || (!bAllowed && IsControl(Text.substr(Place, Length)))) { return Place; }
		Place += Length;
	}
	return Place;
}

} // namespace TextCheck

/// Valid UTF-8 on one line, without controls.
inline bool IsCleanText(std::string_view Text) { return TextCheck::FindUnclean(Text, "") == Text.size(); }

/// The same with line breaks and tabs.
inline bool AreCleanLines(std::string_view Text) { return TextCheck::FindUnclean(Text, "\n\t") == Text.size(); }

} // namespace Lantern
