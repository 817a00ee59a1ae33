// Which files of a shader cache's folder go.
#include "Shaders/ShaderCachePrune.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "Process/ProcessId.h"

namespace Lantern
{

namespace
{
namespace fs = std::filesystem;
using FTime = fs::file_time_type;

constexpr size_t KeyDigits = 32;
constexpr std::string_view Suffix = ".spv.cache";
// A write takes milliseconds. The ids of processes on another machine that shares the folder mean nothing here.
constexpr std::chrono::minutes LongestWrite{10};
// A process with the id of the one that has ended would keep a file for as long as it lives.
constexpr std::chrono::hours LongestTemporary{24};

struct FCacheFile
{
	fs::path Path;
	FTime Used;
	uint64_t Bytes = 0;
};

bool IsEntryName(std::string_view Name)
{
	const auto IsDigit = [](char C) { return (C >= '0' && C <= '9') || (C >= 'a' && C <= 'f'); };
	return Name.size() == KeyDigits + Suffix.size() && Name.substr(KeyDigits) == Suffix &&
	       std::all_of(Name.begin(), Name.begin() + KeyDigits, IsDigit);
}

/// Returns the process that writes a temporary file; nothing: the name is not that of one. "<entry>.<process>.<number>.tmp"
std::optional<int> FindWriter(std::string_view Name)
{
	constexpr size_t EntryLength = KeyDigits + Suffix.size();
	if (Name.size() <= EntryLength || !IsEntryName(Name.substr(0, EntryLength)) || !Name.ends_with(".tmp")) { return std::nullopt; }
	const char* const Begin = Name.data() + EntryLength + 1;
	int Process = 0;
	const auto [End, Error] = std::from_chars(Begin, Name.data() + Name.size(), Process);
	if (Name[EntryLength] != '.' || Error != std::errc() || *End != '.') { return std::nullopt; }
	return Process;
}

bool IsLeftOver(int Process, FTime Written, FTime Now)
{
	return Now - Written > LongestTemporary || (Now - Written > LongestWrite && !IsProcessAlive(Process));
}

size_t Remove(const fs::path& Path)
{
	std::error_code Ignored; // another process was first
	return fs::remove(Path, Ignored) ? 1 : 0;
}
} // namespace

size_t PruneShaderCache(const fs::path& Folder, const FShaderCacheLimits& Limits, FTime Now)
{
	size_t Removed = 0;
	uint64_t Bytes = 0;
	std::vector<FCacheFile> Entries;
	std::error_code Code;
	for (fs::directory_iterator It(Folder, Code), End; !Code && It != End; It.increment(Code))
	{
		std::error_code Gone;
		FCacheFile File{It->path(), It->last_write_time(Gone), 0};
		File.Bytes = Gone ? 0 : It->file_size(Gone);
		if (Gone) { continue; } // another process has removed it
		const std::string Name = File.Path.filename().string();
		if (const std::optional<int> Writer = FindWriter(Name)) { Removed += IsLeftOver(*Writer, File.Used, Now) ? Remove(File.Path) : 0; }
		if (!IsEntryName(Name)) { continue; }
		if (Limits.Age.count() > 0 && Now - File.Used > Limits.Age)
		{
			Removed += Remove(File.Path);
			continue;
		}
		Bytes += File.Bytes;
		Entries.push_back(std::move(File));
	}
	if (Limits.Bytes == 0 || Bytes <= Limits.Bytes) { return Removed; }
	// Some room is left, so that the next write does not have it all looked through again.
	const uint64_t Wanted = Limits.Bytes - Limits.Bytes / 8;
	std::sort(Entries.begin(), Entries.end(), [](const FCacheFile& A, const FCacheFile& B) { return A.Used < B.Used; });
	for (size_t I = 0; I < Entries.size() && Bytes > Wanted; ++I)
	{
		Bytes -= Entries[I].Bytes;
		Removed += Remove(Entries[I].Path);
	}
	return Removed;
}

} // namespace Lantern
