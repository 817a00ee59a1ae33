// Small pictures for pages: encoded in memory, without OpenImageIO.
#pragma once

#include <string>

#include "LanternImage/Image.h"

namespace Lantern
{

/// Encodes an image as baseline JPEG; Quality is 1 to 100. A linear image is first clamped to 0 to 1 and encoded as sRGB. Alpha is
/// dropped. Equal images give equal bytes. The result is empty for an empty image.
std::string EncodeJpeg(const FImage& Image, int Quality = 88);
/// Encodes an image as PNG, 8 bits a channel, under the rules of EncodeJpeg.
std::string EncodePng(const FImage& Image);

/// Base 64 of RFC 4648, with padding.
std::string EncodeBase64(std::string_view Bytes);
/// "data:image/jpeg;base64,…"
std::string MakeJpegUri(const FImage& Image);

/// Averages whole pixels until the image is no wider than MaxWidth. An image that is narrow enough stays as it is. Values that are not
/// finite count as 0.
FImage ShrinkImage(const FImage& Image, uint32_t MaxWidth);

} // namespace Lantern
