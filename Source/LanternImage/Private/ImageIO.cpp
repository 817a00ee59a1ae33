// Chooses the codec for an image file and turns exceptions into errors.
#include "LanternImage/ImageIO.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>

#include "ImageCodecs.h"
#include "LanternImage/AtomicFile.h"
#include "LanternImage/ToneMap.h"

namespace Lantern
{

namespace fs = std::filesystem;

namespace
{

std::string GetLowerEnding(const std::string& Path)
{
	std::string Ending = fs::path(Path).extension().string();
	std::transform(
	    Ending.begin(), Ending.end(), Ending.begin(), [](unsigned char Character) { return static_cast<char>(std::tolower(Character)); });
	return Ending;
}

FRTStatus MakeNoLibraryError(const std::string& Path)
{
	return MakeFileError(ERTResult::Unsupported, Path,
	    "this build reads and writes only .pfm images (it was configured with "
	    "LANTERN_WITH_OIIO=OFF)");
}

FRTStatus CheckEnding(const std::string& Path)
{
	const std::string Ending = GetLowerEnding(Path);
	if (Ending == ".pfm") { return FRTStatus::Success(); }
	if (Ending != ".exr" && Ending != ".png")
	{
		return MakeFileError(ERTResult::Unsupported, Path, "the ending must be .exr, .png or .pfm");
	}
	return IsImageLibraryPresent() ? FRTStatus::Success() : MakeNoLibraryError(Path);
}

FRTStatus CheckReadable(const std::string& Path)
{
	std::error_code Error;
	const fs::file_status Status = fs::status(Path, Error);
	if (Status.type() == fs::file_type::not_found) { return MakeFileError(ERTResult::IoError, Path, "no such file"); }
	if (!fs::status_known(Status)) { return MakeFileError(ERTResult::IoError, Path, "cannot be read: " + Error.message()); }
	// A pipe or a device could block for ever.
	if (!fs::is_regular_file(Status))
	{
		return MakeFileError(ERTResult::IoError, Path, fs::is_directory(Status) ? "is a folder, not an image" : "is not a regular file");
	}
	return FRTStatus::Success();
}

FRTStatus Read(const std::string& Path, FImage& OutImage)
{
	if (GetLowerEnding(Path) == ".pfm") { return ReadPfm(Path, OutImage); }
	return IsImageLibraryPresent() ? ReadWithLibrary(Path, OutImage) : MakeNoLibraryError(Path);
}

} // namespace

FRTStatus MakeSizeError(const std::string& Path, const std::string& Width, const std::string& Height)
{
	return MakeFileError(ERTResult::IoError, Path,
	    "image size " + Width + " x " + Height + " is out of range (1 to " + std::to_string(MaxImageDimension) + " a side, " +
	        std::to_string(MaxImagePixels) + " pixels)");
}

FRTStatus LoadImageFile(const std::string& Path, FImage& OutImage)
{
	if (FRTStatus Status = CheckReadable(Path); !Status) { return Status; }
	try
	{
		FImage Image;
		FRTStatus Status = Read(Path, Image);
		if (Status) { OutImage = std::move(Image); }
		return Status;
	}
	catch (const std::bad_alloc&)
	{
		return MakeFileError(ERTResult::OutOfHostMemory, Path, "not enough memory for this image");
	}
	catch (const std::exception& Exception)
	{
		return MakeFileError(ERTResult::IoError, Path, Exception.what());
	}
}

FRTStatus CheckImageOutput(const std::string& Path)
{
	FRTStatus Status = CheckEnding(Path);
	return Status ? CheckOutputPath(Path) : Status;
}

FRTStatus SaveImageFile(const std::string& Path, const FImage& Image)
{
	if (FRTStatus Status = CheckEnding(Path); !Status) { return Status; }
	if (!IsImageSizeValid(Image.Width, Image.Height))
	{
		return MakeSizeError(Path, std::to_string(Image.Width), std::to_string(Image.Height));
	}
	const std::string Ending = GetLowerEnding(Path);
	return WriteFileAtomically(Path, [&](const std::string& Temporary) {
		if (Ending == ".png") { return WriteWithLibrary(Path, Temporary, EImageFile::Png, ConvertImage(Image, EImageSpace::Display)); }
		const FImage Linear = ConvertImage(Image, EImageSpace::Linear);
		return Ending == ".pfm" ? WritePfm(Path, Temporary, Linear) : WriteWithLibrary(Path, Temporary, EImageFile::Exr, Linear);
	});
}

} // namespace Lantern
