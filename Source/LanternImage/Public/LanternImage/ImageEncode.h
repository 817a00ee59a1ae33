// Small pictures for pages: encoded in memory, without OpenImageIO.
#pragma once

#include <string>

#include "LanternImage/Image.h"

namespace Lantern
{

/// A display picture (linear ones are encoded first, clamped to 0 to 1; alpha is dropped) as JPEG, baseline, Quality 1 to
/// 100. Empty for an empty image. The same image gives the same bytes.
std::string EncodeJpeg(const FImage& Image, int Quality = 88);
/// The same as PNG, 8 bits a channel.
std::string EncodePng(const FImage& Image);

/// RFC 4648, with padding.
std::string EncodeBase64(std::string_view Bytes);
/// "data:image/jpeg;base64,…"
std::string MakeJpegUri(const FImage& Image);

/// Means of whole pixels so that it is no wider than MaxWidth; itself where it is that already. Not finite counts as 0.
FImage ShrinkImage(const FImage& Image, uint32_t MaxWidth);

} // namespace Lantern
