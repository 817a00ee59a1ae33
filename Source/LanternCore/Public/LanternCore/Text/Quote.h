// Text from outside in messages: files, command lines, environment, engines and drivers may hold anything. It is
// escaped where it is quoted, by what LanternRHI/RTText.h says; the log's sink escapes what was forgotten. Thread-safe.
#pragma once

#include <string>
#include <string_view>

#include "LanternRHI/RTText.h"

namespace Lantern
{

/// Most bytes of what Quote shows between its quotation marks.
inline constexpr size_t MaxQuotedBytes = FRTShown::MaxBytes;
/// Most bytes of what EscapePath shows.
inline constexpr size_t MaxPathBytes = 256;

/// One line of valid UTF-8 without control characters, of any length. Escaping twice changes nothing.
std::string EscapeText(std::string_view Text);
/// At most MaxBytes, at least 3, of the escaped text; it then ends in "…".
std::string EscapeText(std::string_view Text, size_t MaxBytes);
/// As EscapeText, but line breaks and tabs stay: for messages of several lines, and for sinks.
std::string EscapeLines(std::string_view Text);

/// In single quotes, escaped, at most MaxQuotedBytes; behind what was cut stands how long it is.
std::string Quote(std::string_view Text);
/// Escaped; beyond MaxPathBytes without its middle, since both ends tell something.
std::string EscapePath(std::string_view Path);

} // namespace Lantern
