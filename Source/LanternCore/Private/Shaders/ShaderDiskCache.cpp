// The disk cache of compiled shaders: one checked file for each key.
#include "Shaders/ShaderDiskCache.h"

#include <chrono>
#include <cstring>
#include <fstream>

#include <xxhash.h>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "Process/ProcessId.h"
#include "Shaders/ShaderCachePrune.h"

namespace Lantern
{

namespace fs = std::filesystem;

namespace
{

TRTConsoleVariable<int32_t> CVarMegabytes("r.RT.ShaderCache.MB", 256,
    "Largest size of the disk cache of compiled shaders, in MiB. Those that were not used for longest go first. 0: no limit.",
    {0, 1'000'000});
TRTConsoleVariable<int32_t> CVarDays("r.RT.ShaderCache.Days", 60,
    "Number of days for which the disk cache keeps a compiled shader after its last use. 0: for ever.", {0, 36'500});

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

/// The age of a file tells when it was last used. A day's precision spares most writes.
void MarkUsed(const fs::path& Path)
{
	std::error_code Ignored; // a folder that may only be read has no need for it
	const auto Now = fs::file_time_type::clock::now();
	const auto Written = fs::last_write_time(Path, Ignored);
	if (!Ignored && Now - Written > std::chrono::hours(24)) { fs::last_write_time(Path, Now, Ignored); }
}

} // namespace

std::string FShaderDiskCache::ToHex(const FHash128& Key) { return fmt::format("{:016x}{:016x}", Key.High, Key.Low); }

FShaderDiskCache::~FShaderDiskCache()
{
	if (bUsed) { Prune(); }
}

void FShaderDiskCache::Prune()
{
	if (bPruning.test_and_set()) { return; } // another thread is at it
	FShaderCacheLimits Limits;
	Limits.Bytes = static_cast<uint64_t>(CVarMegabytes.Get()) << 20;
	Limits.Age = std::chrono::hours(24) * CVarDays.Get();
	PruneShaderCache(Folder, Limits, fs::file_time_type::clock::now());
	bPruning.clear();
}

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
	if (!Wrong)
	{
		bUsed = true;
		MarkUsed(Path);
		return true;
	}
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
	static std::atomic<uint64_t> NextNumber{0}; // of the process: several caches may share a folder
	const uint64_t Number = NextNumber.fetch_add(1);
	bUsed = true;
	if (Writes.fetch_add(1) % PruneInterval == 0) { Prune(); }
	const fs::path Temporary = fmt::format("{}.{}.{}.tmp", Path.string(), GetProcessId(), Number);
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
