// The repository as text, for the tests that check its own rules.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace Lantern::Repo
{

struct FTextFile
{
	std::string Path; ///< relative to the root, with forward slashes
	std::string Text;
	std::vector<std::string_view> Lines; ///< without their ends; into Text
};

std::filesystem::path GetRoot();

/// All text files that belong to the repository (build folders and git's own left out), sorted by path; read once.
const std::vector<FTextFile>& GetFiles();

bool IsUnder(const FTextFile& File, std::string_view Folder);                                 ///< Folder without a slash at its end
bool IsDocument(const FTextFile& File);                                                       ///< what users and developers read
bool HasExtension(const FTextFile& File, std::initializer_list<std::string_view> Extensions); ///< with their dots
bool IsCpp(const FTextFile& File);

/// What stands between the quotes or angle brackets of the line's #include; empty if it is none.
std::string_view GetInclude(std::string_view Line);

/// "Path:Line", lines counted from 1.
std::string At(const FTextFile& File, size_t LineIndex);

} // namespace Lantern::Repo
