// SPIR-V on disk, one file per key. A reader sees a whole file or none (written aside, then renamed), and a file
// that does not check is thrown away.
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
	/// Folder empty: no cache. It is created when first written to.
	explicit FShaderDiskCache(std::string InFolder) : Folder(std::move(InFolder)) {}
	bool Load(const FHash128& Key, std::vector<uint32_t>& OutWords);
	void Store(const FHash128& Key, const std::vector<uint32_t>& Words);
	static std::string ToHex(const FHash128& Key);

private:
	std::filesystem::path PathOf(const FHash128& Key) const { return Folder / (ToHex(Key) + ".spv.cache"); }
	void WarnOnce(const std::string& Reason);

	std::filesystem::path Folder;
	std::atomic<uint64_t> Counter{0};
	std::atomic<bool> bWarned{false};
};

} // namespace Lantern
