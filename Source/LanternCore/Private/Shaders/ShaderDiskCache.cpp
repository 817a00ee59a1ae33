// The disk cache of compiled shaders: one checked file for each key.
#include "Shaders/ShaderDiskCache.h"

#include <cstring>
#include <fstream>

#include <xxhash.h>

#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "Process/ProcessId.h"

namespace Lantern
{

namespace fs = std::filesystem;

namespace
{

constexpr uint32_t CacheMagic = 0x3156534c; // "LSV1"
constexpr uint32_t SpirvMagic = 0x07230203;
constexpr uint64_t MaxWords = 64u << 20;

struct FCacheHeader
{
	uint32_t Magic = CacheMagic;
	uint32_t HeaderBytes = 0;
	uint64_t WordCount = 0;
	uint64_t Checksum = 0;
	FHash128 Key;
};
static_assert(sizeof(FCacheHeader) == 40, "written as it lies in memory: no padding");

uint64_t Checksum(const std::vector<uint32_t>& Words) { return XXH3_64bits(Words.data(), Words.size() * sizeof(uint32_t)); }

/// Returns null if the file is as Store wrote it, else what is wrong with it.
const char* Parse(std::ifstream& File, uint64_t FileBytes, const FHash128& Key, std::vector<uint32_t>& OutWords)
{
	FCacheHeader Header;
	if (!File.read(reinterpret_cast<char*>(&Header), sizeof(Header))) { return "too short for a header"; }
	if (Header.Magic != CacheMagic || Header.HeaderBytes != sizeof(Header) || !(Header.Key == Key)) { return "not the header expected"; }
	if (Header.WordCount == 0 || Header.WordCount > MaxWords || FileBytes != sizeof(Header) + Header.WordCount * sizeof(uint32_t))
	{
		return "wrong length";
	}
	OutWords.resize(Header.WordCount);
	if (!File.read(reinterpret_cast<char*>(OutWords.data()), static_cast<std::streamsize>(OutWords.size() * sizeof(uint32_t))))
	{
		return "unreadable";
	}
	if (Checksum(OutWords) != Header.Checksum) { return "wrong checksum"; }
	return OutWords[0] == SpirvMagic ? nullptr : "not SPIR-V";
}

} // namespace

std::string FShaderDiskCache::ToHex(const FHash128& Key) { return fmt::format("{:016x}{:016x}", Key.High, Key.Low); }

bool FShaderDiskCache::Load(const FHash128& Key, std::vector<uint32_t>& OutWords)
{
	OutWords.clear();
	if (Folder.empty()) { return false; }
	const fs::path Path = PathOf(Key);
	std::error_code Code;
	const uint64_t Bytes = fs::file_size(Path, Code);
	std::ifstream File;
	if (!Code) { File.open(Path, std::ios::binary); }
	if (Code || !File) { return false; }
	const char* Wrong = Parse(File, Bytes, Key, OutWords);
	if (!Wrong) { return true; }
	File.close();
	OutWords.clear();
	LogWarning("Shader cache: {} is corrupt ({}) and is made anew", EscapePath(Path.string()), Wrong);
	fs::remove(Path, Code);
	return false;
}

void FShaderDiskCache::WarnOnce(const std::string& Reason)
{
	if (!bWarned.exchange(true))
	{
		LogWarning("Shader cache: cannot write to {} ({}); shaders are compiled on every start", EscapePath(Folder.string()), Reason);
	}
}

void FShaderDiskCache::Store(const FHash128& Key, const std::vector<uint32_t>& Words)
{
	if (Folder.empty()) { return; }
	std::error_code Code;
	fs::create_directories(Folder, Code);
	if (Code)
	{
		WarnOnce(Code.message());
		return;
	}
	const fs::path Path = PathOf(Key);
	const fs::path Temporary = fmt::format("{}.{}.{}.tmp", Path.string(), GetProcessId(), Counter.fetch_add(1));
	FCacheHeader Header;
	Header.HeaderBytes = sizeof(Header);
	Header.WordCount = Words.size();
	Header.Checksum = Checksum(Words);
	Header.Key = Key;
	std::ofstream File(Temporary, std::ios::binary);
	if (!File)
	{
		WarnOnce(std::strerror(errno));
		return;
	}
	File.write(reinterpret_cast<const char*>(&Header), sizeof(Header));
	File.write(reinterpret_cast<const char*>(Words.data()), static_cast<std::streamsize>(Words.size() * sizeof(uint32_t)));
	File.close();
	if (File) { fs::rename(Temporary, Path, Code); }
	if (!File || Code)
	{
		WarnOnce(Code ? Code.message() : std::string("write failed: disk full?"));
		fs::remove(Temporary, Code);
	}
}

} // namespace Lantern
