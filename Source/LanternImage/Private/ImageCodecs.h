// The codecs that ImageIO.h dispatches to. A path that is read exists and is a regular file. A path that is written is a temporary file;
// errors name Path, the file that it will become. Exceptions may leave these functions; ImageIO.cpp catches them.
#pragma once

#include <string>

#include "LanternImage/Image.h"
#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// PFM ("portable float map"): "PF" or "Pf", width, height, scale, then rows from the bottom. A negative scale means little-endian bytes.
/// The magnitude of the scale has no agreed meaning and is ignored.
FRTStatus ReadPfm(const std::string& Path, FImage& OutImage);
FRTStatus WritePfm(const std::string& Path, const std::string& Temporary, const FImage& Image);

/// Every other format. Without OpenImageIO these functions only say so.
bool IsImageLibraryPresent();
FRTStatus ReadWithLibrary(const std::string& Path, FImage& OutImage);

enum class EImageFile : uint8_t
{
	Exr,
	Png
};
FRTStatus WriteWithLibrary(const std::string& Path, const std::string& Temporary, EImageFile Format, const FImage& Image);

/// "32 x 0 is not a valid image size …"
FRTStatus MakeSizeError(const std::string& Path, const std::string& Width, const std::string& Height);

} // namespace Lantern
