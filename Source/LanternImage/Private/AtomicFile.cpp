// Writes a temporary file and renames it over its target.
#include "LanternImage/AtomicFile.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <random>
#include <system_error>

#include <unistd.h>

#include "LanternCore/Text/Quote.h"

namespace Lantern
{

namespace fs = std::filesystem;

namespace
{

std::string DescribeErrno(int Error) { return std::generic_category().message(Error); }

/// What is to be renamed over: through symbolic links, so that they survive, even to a file that is not there yet.
fs::path ResolveTarget(const std::string& Path)
{
	constexpr int MostLinks = 32;
	fs::path Target = Path;
	std::error_code Error;
	for (int Link = 0; Link < MostLinks && fs::is_symlink(Target, Error); ++Link)
	{
		// An absolute link replaces the folder.
		const fs::path Next = fs::read_symlink(Target, Error);
		Target = Target.parent_path() / Next;
	}
	return Target;
}

fs::path GetFolder(const fs::path& File)
{
	const fs::path Folder = File.parent_path();
	return Folder.empty() ? fs::path(".") : Folder;
}

/// The temporary file is in the folder of Target, since a rename works within one file system only. Its name is short, since Target may
/// have the longest name that there is. It has a random part, since processes of several machines share folders and process ids.
fs::path MakeTemporaryPath(const fs::path& Target)
{
	static std::atomic<unsigned> Counter{0};
	static const unsigned Process = std::random_device()();
	return GetFolder(Target) /
	       (".lantern-" + std::to_string(getpid()) + "-" + std::to_string(Process) + "-" + std::to_string(Counter.fetch_add(1)) + ".tmp");
}

FRTStatus CallGuarded(const std::string& Path, const std::function<FRTStatus(const std::string&)>& Write, const std::string& Temporary)
{
	try
	{
		return Write(Temporary);
	}
	catch (const std::exception& Exception)
	{
		return MakeFileError(ERTResult::IoError, Path, Exception.what());
	}
}

FRTStatus WriteBytes(const std::string& Path, const std::string& Temporary, std::string_view Bytes)
{
	std::FILE* File = std::fopen(Temporary.c_str(), "wb");
	if (!File) { return MakeFileError(ERTResult::IoError, Path, "cannot be written: " + DescribeErrno(errno)); }
	bool bWritten = std::fwrite(Bytes.data(), 1, Bytes.size(), File) == Bytes.size();
	int Error = errno;
	if (std::fclose(File) != 0 && bWritten)
	{
		bWritten = false;
		Error = errno;
	}
	return bWritten ? FRTStatus::Success() : MakeFileError(ERTResult::IoError, Path, "cannot be written: " + DescribeErrno(Error));
}

} // namespace

FRTStatus MakeFileError(ERTResult Code, const std::string& Path, const std::string& Reason)
{
	return FRTStatus::Error(Code, "%s: %s", EscapePath(Path).c_str(), EscapeText(Reason).c_str());
}

FRTStatus CheckOutputPath(const std::string& Path)
{
	std::error_code Error;
	const fs::path Target = ResolveTarget(Path);
	const fs::path Folder = GetFolder(Target);
	if (!fs::is_directory(Folder, Error))
	{
		return MakeFileError(ERTResult::IoError, Path, "cannot be written: its folder does not exist");
	}
	const fs::file_status Status = fs::status(Target, Error);
	if (fs::is_directory(Status)) { return MakeFileError(ERTResult::IoError, Path, "cannot be written: it is a folder"); }
	if (fs::exists(Status) && !fs::is_regular_file(Status))
	{
		return MakeFileError(ERTResult::IoError, Path, "cannot be written: it is not a regular file");
	}
	// Renaming over a file asks its folder alone; a file that is protected stays as it is all the same.
	if (fs::exists(Status) && access(Target.c_str(), W_OK) != 0)
	{
		return MakeFileError(ERTResult::IoError, Path, "cannot be written: " + DescribeErrno(errno));
	}
	if (access(Folder.c_str(), W_OK | X_OK) != 0)
	{
		return MakeFileError(ERTResult::IoError, Path, "cannot be written: " + DescribeErrno(errno));
	}
	return FRTStatus::Success();
}

FRTStatus WriteFileAtomically(const std::string& Path, const std::function<FRTStatus(const std::string& TemporaryPath)>& Write)
{
	if (FRTStatus Status = CheckOutputPath(Path); !Status) { return Status; }
	const fs::path Target = ResolveTarget(Path);
	const fs::path Temporary = MakeTemporaryPath(Target);
	std::error_code Ignored;
	FRTStatus Status = CallGuarded(Path, Write, Temporary.string());
	if (Status)
	{
		std::error_code Error;
		fs::rename(Temporary, Target, Error);
		if (!Error) { return FRTStatus::Success(); }
		Status = MakeFileError(ERTResult::IoError, Path, "cannot be written: " + Error.message());
	}
	fs::remove(Temporary, Ignored);
	return Status;
}

FRTStatus WriteFileAtomically(const std::string& Path, std::string_view Bytes)
{
	return WriteFileAtomically(Path, [&](const std::string& Temporary) { return WriteBytes(Path, Temporary, Bytes); });
}

} // namespace Lantern
