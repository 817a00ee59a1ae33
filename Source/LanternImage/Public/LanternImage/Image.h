// An image in host memory: what the program loads, compares and saves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Lantern
{

/// What the numbers of an image mean.
enum class EImageSpace : uint8_t
{
	Linear,  ///< linear Rec.709, unbounded: radiance
	Display, ///< sRGB-encoded, 0 to 1: a picture
};

/// Float32, interleaved, rows from the top. One or three channels are colour; two or four end in alpha. Alpha is kept as it is stored and
/// is never encoded. An empty image has no pixel. Changes are not thread-safe.
struct FImage
{
	uint32_t Width = 0;
	uint32_t Height = 0;
	uint32_t Channels = 0; ///< 1 to 4
	EImageSpace Space = EImageSpace::Linear;
	std::vector<float> Pixels; ///< Width · Height · Channels

	FImage() = default;
	/// All zero.
	FImage(uint32_t InWidth, uint32_t InHeight, uint32_t InChannels, EImageSpace InSpace = EImageSpace::Linear);

	bool IsEmpty() const { return Pixels.empty(); }
	size_t GetPixelCount() const { return static_cast<size_t>(Width) * Height; }
	/// Channels that are not alpha: 1 or 3.
	uint32_t GetColorChannels() const { return Channels <= 2 ? 1 : 3; }

	float& At(uint32_t X, uint32_t Y, uint32_t Channel) { return Pixels[GetOffset(X, Y) + Channel]; }
	float At(uint32_t X, uint32_t Y, uint32_t Channel) const { return Pixels[GetOffset(X, Y) + Channel]; }

private:
	size_t GetOffset(uint32_t X, uint32_t Y) const { return (static_cast<size_t>(Y) * Width + X) * Channels; }
};

/// Largest sizes that are read or made. A larger size is taken for a mistake or an attack.
inline constexpr uint32_t MaxImageDimension = 65'535;
inline constexpr uint64_t MaxImagePixels = uint64_t(1) << 27;

/// True if a file or a command line may ask for this size: it is not zero and within the limits above.
bool IsImageSizeValid(uint64_t Width, uint64_t Height);

/// Three colour channels without alpha: grey is repeated.
FImage MakeColorImage(const FImage& Image);

} // namespace Lantern
