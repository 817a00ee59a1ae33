// PNG and JPEG to RGBA, by stb_image.
#include "Gltf/StbDecode.h"

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <memory>

namespace
{

// What one allocation may ask for while an image is decoded. Compressed data can unfold to a thousand times its size,
// whatever the header says of the image; stb takes a failed allocation well.
thread_local size_t AllocationLimit = 0;

void* LimitedAllocate(size_t Bytes) { return Bytes <= AllocationLimit ? std::malloc(Bytes) : nullptr; }

void* LimitedReallocate(void* Old, size_t Bytes) { return Bytes <= AllocationLimit ? std::realloc(Old, Bytes) : nullptr; }

} // namespace

#define STBI_MALLOC(Bytes) LimitedAllocate(Bytes)
#define STBI_REALLOC(Old, Bytes) LimitedReallocate(Old, Bytes)
#define STBI_FREE(Old) std::free(Old)
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

// Beside the image itself: tables, and chunks that are as long as the file.
constexpr size_t SmallAllocations = 1 << 20;

/// stb fills what a cut-off JPEG lacks with grey and reports success; the end marker tells.
bool IsTruncatedJpeg(std::span<const uint8_t> Data)
{
	if (Data.size() < 4 || Data[0] != 0xff || Data[1] != 0xd8) { return false; }
	constexpr uint8_t EndMarker[] = {0xff, 0xd9};
	const auto Tail = Data.last(std::min<size_t>(Data.size(), 65536));
	return std::search(Tail.begin(), Tail.end(), std::begin(EndMarker), std::end(EndMarker)) == Tail.end();
}

} // namespace

bool GetImageSize(std::span<const uint8_t> Data, uint32_t& OutWidth, uint32_t& OutHeight)
{
	int Width = 0, Height = 0, Channels = 0;
	AllocationLimit = SmallAllocations;
	if (Data.size() > INT_MAX || stbi_info_from_memory(Data.data(), int(Data.size()), &Width, &Height, &Channels) == 0 || Width <= 0 ||
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
	if (IsTruncatedJpeg(Data)) { return "the JPEG ends early"; }
	uint32_t KnownWidth = 0, KnownHeight = 0;
	if (!GetImageSize(Data, KnownWidth, KnownHeight)) { return "not a PNG or JPEG image"; }
	// 8 bytes a texel before conversion (16-bit RGBA, or the coefficients of a JPEG), twice that as buffers double.
	AllocationLimit = SmallAllocations + 2 * Data.size() + size_t(KnownWidth) * KnownHeight * 16;
	int Width = 0, Height = 0, Channels = 0;
	const std::unique_ptr<stbi_uc, void (*)(void*)> Pixels(
	    stbi_load_from_memory(Data.data(), int(Data.size()), &Width, &Height, &Channels, 4), stbi_image_free);
	if (Pixels == nullptr) { return stbi_failure_reason() != nullptr ? stbi_failure_reason() : "unknown format"; }
	const size_t Bytes = size_t(Width) * size_t(Height) * 4;
	OutRgba.assign(Pixels.get(), Pixels.get() + Bytes);
	bOutHasAlpha = false;
	for (size_t I = 3; I < Bytes && !bOutHasAlpha; I += 4) { bOutHasAlpha = OutRgba[I] != 255; }
	return {};
}

} // namespace Lantern
