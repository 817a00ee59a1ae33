// For the tests of LanternCore: the log as a list, and files that vanish after the test.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "LanternCore/Text/Log.h"
#include "Support/TemporaryFolder.h"

namespace Lantern
{

/// While it lives, log lines come here and nowhere else.
class FLogCapture
{
public:
	FLogCapture()
	{
		SetLogSink([this](ERTLogLevel Level, std::string_view Text) {
			std::lock_guard Lock(Mutex);
			Lines.emplace_back(Level, Text);
		});
	}
	~FLogCapture() { SetLogSink({}); }

	size_t Count(ERTLogLevel Level) const
	{
		std::lock_guard Lock(Mutex);
		return std::count_if(Lines.begin(), Lines.end(), [&](const auto& Line) { return Line.first == Level; });
	}
	std::vector<std::string> GetTexts() const
	{
		std::lock_guard Lock(Mutex);
		std::vector<std::string> Result;
		for (const auto& [Level, Text] : Lines) Result.push_back(Text);
		return Result;
	}

private:
	mutable std::mutex Mutex;
	std::vector<std::pair<ERTLogLevel, std::string>> Lines;
};

} // namespace Lantern
