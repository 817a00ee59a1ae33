// The log: its sink, its level, and the lines that are logged once.
#include "LanternCore/Text/Log.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <unordered_set>

#include <spdlog/logger.h>
#include <spdlog/sinks/ansicolor_sink.h>

#include "LanternCore/Text/Quote.h"

namespace Lantern
{
namespace
{

using FSink = std::function<void(ERTLogLevel, std::string_view)>;

const char* GetPrefix(ERTLogLevel Level)
{
	switch (Level)
	{
	case ERTLogLevel::Debug: return "debug: ";
	case ERTLogLevel::Info: return "";
	case ERTLogLevel::Warning: return "warning: ";
	case ERTLogLevel::Error: return "error: ";
	}
	return "";
}

spdlog::level::level_enum ToSpdlog(ERTLogLevel Level)
{
	switch (Level)
	{
	case ERTLogLevel::Debug: return spdlog::level::debug;
	case ERTLogLevel::Info: return spdlog::level::info;
	case ERTLogLevel::Warning: return spdlog::level::warn;
	case ERTLogLevel::Error: return spdlog::level::err;
	}
	return spdlog::level::info;
}

/// A logger of our own, outside spdlog's registry: an engine that uses spdlog itself keeps its loggers and levels.
std::unique_ptr<spdlog::logger> MakeStandardErrorLogger()
{
	auto Sink = std::make_shared<spdlog::sinks::ansicolor_stderr_sink_mt>(spdlog::color_mode::automatic);
	Sink->set_color(spdlog::level::debug, "");
	Sink->set_color(spdlog::level::info, "");
	auto Logger = std::make_unique<spdlog::logger>("lantern", std::move(Sink));
	Logger->set_level(spdlog::level::trace);
	Logger->set_pattern("%^%v%$");
	return Logger;
}

/// Never destroyed: threads and static objects may still log while the program ends.
struct FLog
{
	std::unique_ptr<spdlog::logger> StandardError = MakeStandardErrorLogger();
	std::atomic<ERTLogLevel> Minimum{ERTLogLevel::Info};
	/// Recursive, so that a sink may replace itself or log.
	std::recursive_mutex SinkMutex;
	std::shared_ptr<const FSink> Sink;
	std::mutex OnceMutex;
	std::unordered_set<std::string> Once;

	static FLog& Get()
	{
		static FLog* Instance = new FLog;
		return *Instance;
	}

	void WriteToStandardError(ERTLogLevel Level, std::string_view Text)
	{
		StandardError->log(ToSpdlog(Level), "{}{}", GetPrefix(Level), Text);
	}
};

/// Messages that a sink itself logs go to standard error, since they would reach the sink again without end.
thread_local bool bInsideSink = false;

} // namespace

void SetLogSink(std::function<void(ERTLogLevel, std::string_view)> Sink)
{
	FLog& Log = FLog::Get();
	std::lock_guard Lock(Log.SinkMutex);
	Log.Sink = Sink ? std::make_shared<const FSink>(std::move(Sink)) : nullptr;
}

void SetLogLevel(ERTLogLevel Minimum) { FLog::Get().Minimum = Minimum; }

void LogLine(ERTLogLevel Level, std::string_view RawText)
{
	FLog& Log = FLog::Get();
	if (Level < Log.Minimum) return;
	// Text that a caller forgot to escape must not reach a terminal or an engine's log.
	const std::string Text = EscapeLines(RawText);
	if (bInsideSink)
	{
		Log.WriteToStandardError(Level, Text);
		return;
	}
	std::lock_guard Lock(Log.SinkMutex);
	// Kept alive here: the sink may call SetLogSink.
	const std::shared_ptr<const FSink> Sink = Log.Sink;
	if (!Sink)
	{
		Log.WriteToStandardError(Level, Text);
		return;
	}
	bInsideSink = true;
	try
	{
		(*Sink)(Level, Text);
	}
	catch (...)
	{
		Log.WriteToStandardError(Level, Text);
	}
	bInsideSink = false;
}

void LogOnce(ERTLogLevel Level, std::string_view Text)
{
	FLog& Log = FLog::Get();
	// A text that the level hides has not been logged: it may still appear when the level drops.
	if (Level < Log.Minimum) return;
	{
		std::lock_guard Lock(Log.OnceMutex);
		if (!Log.Once.emplace(Text).second) return;
	}
	LogLine(Level, Text);
}

} // namespace Lantern
