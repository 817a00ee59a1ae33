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

class FTemporaryFolder
{
public:
	FTemporaryFolder()
	{
		std::string Pattern = (std::filesystem::temp_directory_path() / "lantern-test-XXXXXX").string();
		Path = ::mkdtemp(Pattern.data());
	}
	~FTemporaryFolder()
	{
		std::error_code Ignored;
		std::filesystem::remove_all(Path, Ignored);
	}
	FTemporaryFolder(const FTemporaryFolder&) = delete;
	FTemporaryFolder& operator=(const FTemporaryFolder&) = delete;

	const std::string& GetPath() const { return Path; }
	std::string Write(const std::string& Name, std::string_view Text) const
	{
		const std::string File = Path + "/" + Name;
		std::ofstream(File, std::ios::binary) << Text;
		return File;
	}

private:
	std::string Path;
};

} // namespace Lantern
