// Escapes and shortens text from outside for messages.
#include "LanternCore/Text/Quote.h"

#include <fmt/format.h>

namespace Lantern
{
namespace
{

constexpr std::string_view Ellipsis = "…";

std::string Escape(std::string_view Text, ERTTextKind Kind)
{
	std::string Result;
	Result.reserve(Text.size());
	ShowText(Text.data(), Text.size(), Kind, [&](const char* Bytes, size_t Count) { Result.append(Bytes, Count); });
	return Result;
}

} // namespace

std::string EscapeText(std::string_view Text) { return Escape(Text, ERTTextKind::OneLine); }

std::string EscapeText(std::string_view Text, size_t MaxBytes)
{
	// Escapes are never shorter than the text they replace, so that no more of a huge text need be read.
	constexpr size_t LongestCharacter = 4;
	std::string Result(MaxBytes + 1, '\0');
	const std::string_view Start = Text.substr(0, MaxBytes + LongestCharacter);
	Result.resize(ShowText(Result.data(), Result.size(), Start.data(), Start.size(), ERTTextKind::OneLine, Ellipsis.data()));
	return Result;
}

std::string EscapeLines(std::string_view Text) { return Escape(Text, ERTTextKind::Lines); }

std::string Quote(std::string_view Text)
{
	const std::string Shown = EscapeText(Text, MaxQuotedBytes);
	const bool bCut = Text.size() > MaxQuotedBytes || Shown != EscapeText(Text);
	return bCut ? fmt::format("'{}' ({} bytes)", Shown, Text.size()) : fmt::format("'{}'", Shown);
}

std::string EscapePath(std::string_view Path)
{
	std::string Shown = EscapeText(Path);
	if (Shown.size() <= MaxPathBytes) { return Shown; }
	constexpr size_t Half = (MaxPathBytes - Ellipsis.size()) / 2;
	size_t Tail = Shown.size() - Half;
	while ((static_cast<unsigned char>(Shown[Tail]) & 0xC0) == 0x80) { ++Tail; }
	return Shown.substr(0, FitCharacters(Shown.data(), Shown.size(), Half)) + std::string(Ellipsis) + Shown.substr(Tail);
}

} // namespace Lantern
