#include "Gltf/StbDecode.h"

#include <algorithm>
#include <climits>
#include <memory>

// Static, so that another copy of stb in the program does not clash. Only the formats of glTF: the other decoders
// would only be more to attack.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace Lantern
{

namespace
{

/// stb fills what a cut-off JPEG lacks with grey and reports success; the end marker tells.
bool IsTruncatedJpeg(std::span<const uint8_t> Data)
{
	if (Data.size() < 4 || Data[0] != 0xff || Data[1] != 0xd8)
	{
		return false;
	}
	constexpr uint8_t EndMarker[] = {0xff, 0xd9};
	const auto Tail = Data.last(std::min<size_t>(Data.size(), 65536));
	return std::search(Tail.begin(), Tail.end(), std::begin(EndMarker), std::end(EndMarker)) == Tail.end();
}

} // namespace

bool GetImageSize(std::span<const uint8_t> Data, uint32_t& OutWidth, uint32_t& OutHeight)
{
	int Width = 0, Height = 0, Channels = 0;
	if (Data.size() > INT_MAX ||
	    stbi_info_from_memory(Data.data(), int(Data.size()), &Width, &Height, &Channels) == 0 || Width <= 0 ||
	    Height <= 0)
	{
		return false;
	}
	OutWidth = uint32_t(Width);
	OutHeight = uint32_t(Height);
	return true;
}

std::string DecodeImage(std::span<const uint8_t> Data, std::vector<uint8_t>& OutRgba, bool& bOutHasAlpha)
{
	if (IsTruncatedJpeg(Data))
	{
		return "the JPEG ends early";
	}
	int Width = 0, Height = 0, Channels = 0;
	const std::unique_ptr<stbi_uc, void (*)(void*)> Pixels(
	    stbi_load_from_memory(Data.data(), int(Data.size()), &Width, &Height, &Channels, 4), stbi_image_free);
	if (Pixels == nullptr)
	{
		return stbi_failure_reason() != nullptr ? stbi_failure_reason() : "unknown format";
	}
	const size_t Bytes = size_t(Width) * size_t(Height) * 4;
	OutRgba.assign(Pixels.get(), Pixels.get() + Bytes);
	bOutHasAlpha = false;
	for (size_t I = 3; I < Bytes && !bOutHasAlpha; I += 4)
	{
		bOutHasAlpha = OutRgba[I] != 255;
	}
	return {};
}

} // namespace Lantern
