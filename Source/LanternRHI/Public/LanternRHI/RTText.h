// Text from outside in messages: names of an engine, files, drivers. It may hold anything. Whatever would steer a terminal,
// hide something or is no UTF-8 is shown as an escape. C++17, no standard containers; LanternCore/Text/Quote.h has this for
// strings. Everything here is thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>

namespace Lantern
{

enum class ERTTextKind : uint8_t
{
	OneLine, ///< escapes '\n' and '\t', so that a name cannot forge a line
	Lines,   ///< keeps them: for whole messages
};

/// What stands in a message for the first character of a text.
struct FRTShownCharacter
{
	char Text[12] = {}; ///< ends with a zero byte; at most 10 before it
	uint32_t Size = 0;  ///< bytes of Text
	uint32_t Taken = 0; ///< bytes of the text that it stands for, 1 to 4
};

/// Returns the bytes of the UTF-8 character at the start of Text, 1 to 4, and its code point. Returns 0 if there is no valid
/// one: strays, overlong forms, surrogates, code points beyond U+10FFFF, and what is cut off.
inline uint32_t DecodeCharacter(const char* Text, size_t Size, uint32_t& OutCode)
{
	constexpr uint32_t Least[] = {0, 0, 0x80, 0x800, 0x10000};
	const uint32_t First = Size > 0 ? static_cast<uint8_t>(Text[0]) : 0xFF;
	if (First < 0x80)
	{
		OutCode = First;
		return 1;
	}
	const uint32_t Length = First >= 0xF0 ? 4 : First >= 0xE0 ? 3 : 2;
	if (First < 0xC0 || First >= 0xF8 || Size < Length) { return 0; }
	uint32_t Code = First & (0x7Fu >> Length);
	for (uint32_t I = 1; I < Length; ++I)
	{
		const uint32_t Next = static_cast<uint8_t>(Text[I]);
		if ((Next & 0xC0) != 0x80) { return 0; }
		Code = Code << 6 | (Next & 0x3F);
	}
	const bool bSurrogate = Code >= 0xD800 && Code <= 0xDFFF;
	OutCode = Code;
	return Code >= Least[Length] && Code <= 0x10FFFF && !bSurrogate ? Length : 0;
}

/// Says whether a message may hold the character. Refused are controls, other line breaks, what turns the direction of writing,
/// and the usual invisible ones. The joiners U+200C and U+200D may stay, since scripts and emoji are written with them.
inline bool IsShowable(uint32_t Code)
{
	struct FRange
	{
		uint32_t First, Last;
	};
	constexpr FRange Hidden[] = {
	    {0x7F, 0x9F},       // delete and the C1 controls
	    {0xAD, 0xAD},       // soft hyphen
	    {0x61C, 0x61C},     // Arabic letter mark
	    {0x180E, 0x180E},   // Mongolian vowel separator
	    {0x200B, 0x200B},   // zero-width space
	    {0x200E, 0x200F},   // direction marks
	    {0x2028, 0x202E},   // line and paragraph separators, embeddings, overrides
	    {0x2060, 0x206F},   // invisible operators, isolates
	    {0xD800, 0xDFFF},   // surrogates
	    {0xFDD0, 0xFDEF},   // no characters
	    {0xFEFF, 0xFEFF},   // byte order mark
	    {0xFFF9, 0xFFFB},   // annotations
	    {0xE0000, 0xE007F}, // tags
	};
	if (Code < 0x7F) { return Code >= 0x20; }
	for (const FRange& Range : Hidden)
	{
		if (Code >= Range.First && Code <= Range.Last) { return false; }
	}
	return (Code & 0xFFFE) != 0xFFFE && Code <= 0x10FFFF;
}

/// Shows the first character of Text as it is, or as \n, \r, \t, \xNN (a byte) or \u{NNNN} (a code point). Size > 0.
/// A backslash stays one, or no path would be readable. An escape is for people: it looks like such text in the original.
/// In return, what has been escaped does not change when it is escaped again.
inline FRTShownCharacter ShowCharacter(const char* Text, size_t Size, ERTTextKind Kind)
{
	constexpr const char* Digits = "0123456789abcdef";
	FRTShownCharacter Out;
	const auto Put = [&Out](char C) { Out.Text[Out.Size++] = C; };
	uint32_t Code = 0;
	const uint32_t Length = DecodeCharacter(Text, Size, Code);
	Out.Taken = Length > 0 ? Length : 1;
	const bool bKept = Kind == ERTTextKind::Lines && (Code == '\n' || Code == '\t');
	if (Length > 0 && (bKept || IsShowable(Code)))
	{
		for (uint32_t I = 0; I < Length; ++I) { Put(Text[I]); }
		return Out;
	}
	Put('\\');
	if (Length == 1 && (Code == '\n' || Code == '\r' || Code == '\t'))
	{
		Put(Code == '\n' ? 'n' : Code == '\r' ? 'r' : 't');
		return Out;
	}
	if (Length < 2)
	{
		const uint32_t Byte = static_cast<uint8_t>(Text[0]);
		Put('x');
		Put(Digits[Byte >> 4]);
		Put(Digits[Byte & 15]);
		return Out;
	}
	Put('u');
	Put('{');
	for (uint32_t Shift = 24; Shift > 0;)
	{
		Shift -= 4;
		if (Shift < 16 || Code >> Shift != 0) { Put(Digits[Code >> Shift & 15]); }
	}
	Put('}');
	return Out;
}

/// Calls Take(const char* Bytes, size_t Count) with what is shown of each character.
template <class F>
void ShowText(const char* Text, size_t Size, ERTTextKind Kind, F&& Take)
{
	while (Size > 0)
	{
		const FRTShownCharacter Shown = ShowCharacter(Text, Size, Kind);
		Take(Shown.Text, static_cast<size_t>(Shown.Size));
		Text += Shown.Taken;
		Size -= Shown.Taken;
	}
}

/// Writes to Out at most Capacity - 1 bytes and a zero byte. A text that does not fit is cut between two characters and ends
/// in Mark. Capacity is greater than the size of Mark. Returns the bytes before the zero byte.
inline size_t ShowText(char* Out, size_t Capacity, const char* Text, size_t Size, ERTTextKind Kind, const char* Mark)
{
	size_t MarkSize = 0, Used = 0, Fit = 0;
	while (Mark[MarkSize] != 0) { ++MarkSize; }
	const auto Append = [&](const char* From, size_t Count) {
		for (size_t I = 0; I < Count; ++I) { Out[Used++] = From[I]; }
	};
	while (Size > 0)
	{
		const FRTShownCharacter Shown = ShowCharacter(Text, Size, Kind);
		if (Used + Shown.Size > Capacity - 1)
		{
			Used = Fit;
			Append(Mark, MarkSize);
			break;
		}
		Append(Shown.Text, Shown.Size);
		Fit = Used + MarkSize <= Capacity - 1 ? Used : Fit;
		Text += Shown.Taken;
		Size -= Shown.Taken;
	}
	Out[Used] = 0;
	return Used;
}

/// Returns how many of the first Max bytes of Text can be kept without cutting a UTF-8 character in two.
inline size_t FitCharacters(const char* Text, size_t Size, size_t Max)
{
	if (Size <= Max) { return Size; }
	const auto IsInside = [Text](size_t I) { return (static_cast<uint8_t>(Text[I]) & 0xC0) == 0x80; };
	for (size_t End = Max; End > 0 && Max - End < 4; --End)
	{
		if (!IsInside(End)) { return End; }
	}
	return Max; // no UTF-8
}

/// A name as it may stand in a message, one line of at most MaxBytes: for printf's %s, FRTShown(Name).Text.
struct FRTShown
{
	static constexpr size_t MaxBytes = 120;

	/// Ends with a zero byte; null counts as empty.
	explicit FRTShown(const char* InText)
	{
		// No more is looked at than can be shown.
		size_t Size = 0;
		while (InText != nullptr && Size < sizeof(Text) + 4 && InText[Size] != 0) { ++Size; }
		ShowText(Text, sizeof(Text), InText, Size, ERTTextKind::OneLine, "…");
	}

	char Text[MaxBytes + 1];
};

} // namespace Lantern
