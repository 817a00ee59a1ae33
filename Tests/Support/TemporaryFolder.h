// A folder of its own for one test.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include <gtest/gtest.h>

namespace Lantern
{

/// A folder of its own for one test, removed with all it holds.
class FTemporaryFolder
{
public:
	FTemporaryFolder()
	{
		std::string Name = (std::filesystem::temp_directory_path() / "lantern-test-XXXXXX").string();
		EXPECT_NE(mkdtemp(Name.data()), nullptr);
		Path = Name;
	}
	~FTemporaryFolder()
	{
		std::error_code Ignored;
		std::filesystem::remove_all(Path, Ignored);
	}
	FTemporaryFolder(const FTemporaryFolder&) = delete;
	FTemporaryFolder& operator=(const FTemporaryFolder&) = delete;

	const std::filesystem::path& Get() const { return Path; }
	const std::string& GetPath() const { return Path.native(); }
	std::string operator/(const std::string& Name) const { return (Path / Name).string(); }
	/// Returns the file's path.
	std::string Write(const std::string& Name, std::string_view Content) const
	{
		const std::string File = *this / Name;
		std::ofstream(File, std::ios::binary) << Content;
		return File;
	}

private:
	std::filesystem::path Path;
};

} // namespace Lantern
