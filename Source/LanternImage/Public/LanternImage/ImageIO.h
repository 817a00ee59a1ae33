// Image files: .exr and .pfm hold linear radiance, .png a display picture. Other formats (.jpg, .hdr, …) can be
// read. All but PFM need OpenImageIO (CMake option LANTERN_WITH_OIIO); without it they fail with a message.
#pragma once

#include <string>

#include "LanternImage/Image.h"
#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// Reads an image. Display pictures come back as stored, in 0 to 1; EXR channels by name (R, G, B, A or Y), the
/// data window, alpha as
/// stored. OutImage is untouched on failure. Every failure names the path and the reason: IoError where the
/// file cannot be opened, is damaged or larger than MaxImagePixels; Unsupported where the format is not known.
FRTStatus LoadImageFile(const std::string& Path, FImage& OutImage);

/// Writes by the ending of Path: .exr (float32) and .pfm (float32, 1 or 3 channels: alpha is dropped) hold linear
/// values, .png 8-bit sRGB; an image of the other space is converted, nothing is tone-mapped. Atomic: Path holds
/// either what it held before or the whole image. Failures as for LoadImageFile.
FRTStatus SaveImageFile(const std::string& Path, const FImage& Image);

/// Whether SaveImageFile could write Path now: an ending that this build knows, a folder that can be written to.
/// Lets a long render fail before it starts.
FRTStatus CheckImageOutput(const std::string& Path);

} // namespace Lantern
