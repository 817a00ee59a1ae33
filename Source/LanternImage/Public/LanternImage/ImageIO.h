// Image files: .exr and .pfm hold linear radiance, .png a display picture. Other formats (.jpg, .hdr, …) can be read. All but PFM need
// OpenImageIO (CMake option LANTERN_WITH_OIIO); without it they fail with a message.
#pragma once

#include <string>

#include "LanternImage/Image.h"
#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// Reads an image. Display pictures come back as stored, in 0 to 1. EXR channels are found by name (R, G, B, A or Y); the image is the data
/// window, and alpha is as stored. OutImage is untouched on failure. Every failure names the path and the reason. IoError: the file cannot
/// be opened, is damaged, or is larger than MaxImagePixels. Unsupported: the format is not known.
FRTStatus LoadImageFile(const std::string& Path, FImage& OutImage);

/// Writes an image in the format that the ending of Path names. Linear values go into .exr (float32) and .pfm (float32, 1 or 3 channels:
/// alpha is dropped); 8-bit sRGB goes into .png. An image of the other space is converted; nothing is tone-mapped. The write is atomic:
/// afterwards Path holds either its old contents or the whole image. Failures are those of LoadImageFile.
FRTStatus SaveImageFile(const std::string& Path, const FImage& Image);

/// Checks whether SaveImageFile could write Path now: this build knows its ending, and its folder can be written to. A long render can
/// fail before it starts.
FRTStatus CheckImageOutput(const std::string& Path);

} // namespace Lantern
