// Files that tests read but the project does not hold. Where they are missing, the test is skipped.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace Lantern
{

/// LANTERN_SHARED, or the folder `shared` beside the project.
inline std::filesystem::path GetSharedFolder()
{
	const char* Folder = std::getenv("LANTERN_SHARED");
	return Folder ? std::filesystem::path(Folder) : std::filesystem::path(LANTERN_SOURCE_DIR).parent_path() / "shared";
}

/// A folder of its own for one test, removed with all it holds.
class FTemporaryFolder
{
public:
	FTemporaryFolder()
	{
		std::string Name = (std::filesystem::temp_directory_path() / "lantern-test-XXXXXX").string();
		const char* Made = mkdtemp(Name.data());
		EXPECT_NE(Made, nullptr);
		Path = Name;
	}
	~FTemporaryFolder()
	{
		std::error_code Ignored;
		std::filesystem::remove_all(Path, Ignored);
	}
	FTemporaryFolder(const FTemporaryFolder&) = delete;
	FTemporaryFolder& operator=(const FTemporaryFolder&) = delete;

	std::string operator/(const std::string& Name) const { return (Path / Name).string(); }
	const std::filesystem::path& Get() const { return Path; }

private:
	std::filesystem::path Path;
};

} // namespace Lantern
