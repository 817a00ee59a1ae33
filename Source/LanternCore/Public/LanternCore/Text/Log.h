// The log: one sink for the whole plugin. The log goes to standard error, or to the engine's sink. Results do not belong in the
// log; their owners write them to standard output. Thread-safe.
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

/// Redirects the log to Sink (an engine's log); an empty function restores standard error. The sink gets valid UTF-8 without
/// control characters except line breaks and tabs, which messages of several lines contain.
void SetLogSink(std::function<void(ERTLogLevel, std::string_view)> Sink);
void SetLogLevel(ERTLogLevel Minimum);
/// Logs one message. The caller must escape text from outside that it quotes (Quote.h), else that text may contain line breaks.
void LogLine(ERTLogLevel Level, std::string_view Text);
/// Logs a message unless the process has logged the same text before.
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
