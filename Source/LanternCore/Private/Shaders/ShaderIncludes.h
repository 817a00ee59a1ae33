// Reads shader files and follows their #include lines textually, without preprocessing, since the cache key must be known
// without a compiler. An include inside a dead #if only makes the key finer, never wrong.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "LanternCore/Shaders/ShaderCompiler.h"

namespace Lantern
{

struct FIncludeLine
{
	std::string Name; ///< between the quotes
	uint32_t Line = 0;
	bool bQuoted = false; ///< false: <angle brackets>, which only the search folders serve
};

/// Returns the #include lines of Text outside of comments, in order.
std::vector<FIncludeLine> FindIncludeLines(std::string_view Text);

struct FHash128
{
	uint64_t Low = 0, High = 0;
	bool operator==(const FHash128&) const = default;
};
FHash128 HashBytes(std::string_view Bytes);

/// The content of one file, with its hash and its #include lines. Immutable.
struct FShaderFile
{
	std::string Text;
	std::vector<FIncludeLine> Includes;
	FHash128 Hash;
};

std::shared_ptr<const FShaderFile> MakeShaderFile(std::string Text);

/// File contents, kept until the file changes. Thread-safe.
class FShaderFileCache
{
public:
	/// Returns null if the file cannot be read.
	std::shared_ptr<const FShaderFile> Read(const std::filesystem::path& Path);

private:
	struct FEntry
	{
		std::filesystem::file_time_type Modified;
		uintmax_t Size = 0;
		bool bSettled = false;
		std::shared_ptr<const FShaderFile> File;
	};
	std::mutex Mutex;
	std::unordered_map<std::string, FEntry> Entries;
};

/// A shader and all that it may include.
struct FIncludeTree
{
	struct FNode
	{
		std::string Name;               ///< as errors show it: relative to its search folder, the whole path if that is ambiguous
		std::filesystem::path Location; ///< empty for text given in memory
		std::shared_ptr<const FShaderFile> File;
		std::vector<int> Targets; ///< one per include line: index of a node, Missing
	};
	static constexpr int Missing = -1;

	std::vector<FNode> Nodes; ///< 0 is the shader itself
	bool bMissing = false;    ///< a quoted include was not found (an error only if its #if is alive)
	std::string Error;        ///< "Path:line: text", the tree is unusable; else empty
};

class FIncludeResolver
{
public:
	/// Headers serve all shaders, behind those of each source.
	FIncludeResolver(const std::vector<std::string>& InSearchFolders, std::vector<FShaderHeader> InHeaders, FShaderFileCache& InFiles);
	FIncludeTree Resolve(const FShaderSource& Source);
	const std::string& GetFoldersText() const { return FoldersText; }

private:
	struct FFound
	{
		std::filesystem::path Location;
		std::string Name;
		std::shared_ptr<const FShaderFile> File;
	};
	struct FWalk;

	bool FindInFolders(const std::filesystem::path& Relative, FFound& Out);
	bool FindInclude(const FWalk& Walk, const FIncludeTree::FNode& From, const FIncludeLine& Line, FFound& Out);
	std::string NameOf(const std::filesystem::path& Location) const;
	void Visit(FWalk& Walk, int Index);

	std::vector<std::filesystem::path> Folders;
	std::string FoldersText;
	std::vector<FShaderHeader> Headers;
	FShaderFileCache& Files;
};

} // namespace Lantern
