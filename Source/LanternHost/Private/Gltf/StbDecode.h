// PNG and JPEG to RGBA, by stb_image.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace Lantern
{

/// Reads the size without decoding. False if the bytes are neither a PNG nor a JPEG.
bool GetImageSize(std::span<const uint8_t> Data, uint32_t& OutWidth, uint32_t& OutHeight);

/// Decodes to 8 bits per channel, top row first. Returns an empty string, or what is wrong. Thread-safe.
std::string DecodeImage(std::span<const uint8_t> Data, std::vector<uint8_t>& OutRgba, bool& bOutHasAlpha);

} // namespace Lantern
