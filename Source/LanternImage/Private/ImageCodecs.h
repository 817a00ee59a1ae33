// What ImageIO.h dispatches to. Paths exist and are regular files when read; when written, they are temporary
// files, and errors name Path, the file they will become. Exceptions may leave these; ImageIO.cpp catches them.
#pragma once

#include <string>

#include "LanternImage/Image.h"
#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// PFM ("portable float map"): "PF" or "Pf", width, height, scale, then rows from the bottom. The sign of the scale
/// gives the byte order (negative: little-endian); its magnitude has no agreed meaning and is ignored.
FRTStatus ReadPfm(const std::string& Path, FImage& OutImage);
FRTStatus WritePfm(const std::string& Path, const std::string& Temporary, const FImage& Image);

/// Every other format. Without OpenImageIO these only say so.
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
