// Quotes text from outside in messages. Text of files, command lines, environment, engines and drivers may contain anything.
// It is escaped where it is quoted, by the rules of LanternRHI/RTText.h; the log's sink escapes what was forgotten. Thread-safe.
#pragma once

#include <string>
#include <string_view>

#include "LanternRHI/RTText.h"

namespace Lantern
{

/// Quote shows at most so many bytes between its quotation marks.
inline constexpr size_t MaxQuotedBytes = FRTShown::MaxBytes;
/// EscapePath shows at most so many bytes.
inline constexpr size_t MaxPathBytes = 256;

/// Returns one line of valid UTF-8 without control characters, of any length. Escaping twice changes nothing.
std::string EscapeText(std::string_view Text);
/// Returns at most MaxBytes (≥ 3) of the escaped text; it ends in "…" if it was cut.
std::string EscapeText(std::string_view Text, size_t MaxBytes);
/// Escapes as EscapeText does, but keeps line breaks and tabs. For messages of several lines, and for sinks.
std::string EscapeLines(std::string_view Text);

/// Returns Text escaped and in single quotes, at most MaxQuotedBytes of it. If it was cut, its full length follows.
std::string Quote(std::string_view Text);
/// Escapes a path. Longer ones than MaxPathBytes lose their middle, since both ends are informative.
std::string EscapePath(std::string_view Path);

} // namespace Lantern
