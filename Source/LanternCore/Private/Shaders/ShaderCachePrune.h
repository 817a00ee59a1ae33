// Keeps the folder of the shader disk cache small.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>

namespace Lantern
{

/// What a cache folder may hold. Zero: no limit.
struct FShaderCacheLimits
{
	uint64_t Bytes = 0;        ///< of all entries
	std::chrono::hours Age{0}; ///< since an entry was last written or read
};

/// Removes entries that nobody has used for Limits.Age, then those unused for longest until the rest fits. Also removes temporary
/// files of processes that have ended. Other files stay. Returns the number of removed files.
/// Threads: any, and any process at the same time: whoever finds its entry gone compiles again.
size_t PruneShaderCache(const std::filesystem::path& Folder, const FShaderCacheLimits& Limits, std::filesystem::file_time_type Now);

} // namespace Lantern
