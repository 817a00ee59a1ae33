// Log: one sink for the whole plugin. Results go to standard output by their owners; the log goes to standard
// error, or to where the engine points it. Thread-safe.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace Lantern
{

enum class ERTLogLevel : uint8_t
{
	Debug,
	Info,
	Warning,
	Error
};

/// Replaces where lines go (an engine's log); an empty function restores standard error. A sink gets valid UTF-8
/// without control characters; line breaks and tabs stay, for messages of several lines.
void SetLogSink(std::function<void(ERTLogLevel, std::string_view)> Sink);
void SetLogLevel(ERTLogLevel Minimum);
/// What Text quotes from outside is to be escaped by the caller (Quote.h): only that keeps line breaks out of it.
void LogLine(ERTLogLevel Level, std::string_view Text);
/// Logs a given text once per process.
void LogOnce(ERTLogLevel Level, std::string_view Text);

template <class... T>
void LogDebug(fmt::format_string<T...> Format, T&&... Args)
{
	LogLine(ERTLogLevel::Debug, fmt::format(Format, std::forward<T>(Args)...));
}
template <class... T>
void LogInfo(fmt::format_string<T...> Format, T&&... Args)
{
	LogLine(ERTLogLevel::Info, fmt::format(Format, std::forward<T>(Args)...));
}
template <class... T>
void LogWarning(fmt::format_string<T...> Format, T&&... Args)
{
	LogLine(ERTLogLevel::Warning, fmt::format(Format, std::forward<T>(Args)...));
}
template <class... T>
void LogError(fmt::format_string<T...> Format, T&&... Args)
{
	LogLine(ERTLogLevel::Error, fmt::format(Format, std::forward<T>(Args)...));
}

} // namespace Lantern
