// The disk cache of SPIR-V, one file per key. Files are written aside and then renamed, so that readers never see a part. A file
// with a wrong checksum is deleted. Files that nobody has used for long go, and the oldest ones if there are too many bytes
// (r.RT.ShaderCache.Days, r.RT.ShaderCache.MB): at the first write, every PruneInterval writes, and at the end.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "Shaders/ShaderIncludes.h"

namespace Lantern
{

class FShaderDiskCache
{
public:
	/// Folder: empty for no cache; created at the first write.
	explicit FShaderDiskCache(std::string InFolder) : Folder(std::move(InFolder)) {}
	~FShaderDiskCache();
	FShaderDiskCache(const FShaderDiskCache&) = delete;
	FShaderDiskCache& operator=(const FShaderDiskCache&) = delete;
	bool Load(const FHash128& Key, std::vector<uint32_t>& OutWords);
	void Store(const FHash128& Key, const std::vector<uint32_t>& Words);
	static std::string ToHex(const FHash128& Key);

	static constexpr uint64_t PruneInterval = 256;

private:
	void Prune();
	std::filesystem::path PathOf(const FHash128& Key) const { return Folder / (ToHex(Key) + ".spv.cache"); }
	void WarnOnce(const std::string& Reason);

	std::filesystem::path Folder;
	std::atomic<uint64_t> Writes{0};
	std::atomic<bool> bWarned{false};
	std::atomic<bool> bUsed{false}; ///< something was read or written
	std::atomic_flag bPruning = ATOMIC_FLAG_INIT;
};

} // namespace Lantern
