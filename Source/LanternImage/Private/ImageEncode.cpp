// JPEG, PNG and base64 in memory.
#include "LanternImage/ImageEncode.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "LanternImage/ToneMap.h"

// The library's own warnings are not ours.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace Lantern
{

namespace
{
std::vector<uint8_t> MakeBytes(const FImage& Image)
{
	const FImage Display = ConvertImage(MakeColorImage(Image), EImageSpace::Display);
	std::vector<uint8_t> Bytes(Display.Pixels.size());
	for (size_t I = 0; I < Bytes.size(); ++I)
	{
		const float Value = Display.Pixels[I];
		Bytes[I] = Value > 0.0f ? static_cast<uint8_t>(std::lround(std::min(Value, 1.0f) * 255.0f)) : 0;
	}
	return Bytes;
}

void Append(void* User, void* Data, int Size)
{
	static_cast<std::string*>(User)->append(static_cast<const char*>(Data), static_cast<size_t>(Size));
}
} // namespace

std::string EncodeJpeg(const FImage& Image, int Quality)
{
	std::string Out;
	if (Image.IsEmpty()) { return Out; }
	const std::vector<uint8_t> Bytes = MakeBytes(Image);
	stbi_write_jpg_to_func(Append, &Out, static_cast<int>(Image.Width), static_cast<int>(Image.Height), 3, Bytes.data(), Quality);
	return Out;
}

std::string EncodePng(const FImage& Image)
{
	std::string Out;
	if (Image.IsEmpty()) { return Out; }
	const std::vector<uint8_t> Bytes = MakeBytes(Image);
	stbi_write_png_to_func(
	    Append, &Out, static_cast<int>(Image.Width), static_cast<int>(Image.Height), 3, Bytes.data(), static_cast<int>(Image.Width) * 3);
	return Out;
}

std::string EncodeBase64(std::string_view Bytes)
{
	constexpr const char* Digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	std::string Out;
	Out.reserve((Bytes.size() + 2) / 3 * 4);
	for (size_t I = 0; I < Bytes.size(); I += 3)
	{
		uint32_t Group = 0;
		for (size_t J = 0; J < 3; ++J) { Group = Group << 8 | (I + J < Bytes.size() ? static_cast<uint8_t>(Bytes[I + J]) : 0u); }
		for (size_t J = 0; J < 4; ++J) { Out += I + J <= Bytes.size() ? Digits[Group >> (18 - 6 * J) & 63] : '='; }
	}
	return Out;
}

std::string MakeJpegUri(const FImage& Image) { return "data:image/jpeg;base64," + EncodeBase64(EncodeJpeg(Image)); }

FImage ShrinkImage(const FImage& Image, uint32_t MaxWidth)
{
	const uint32_t Factor = (Image.Width + MaxWidth - 1) / MaxWidth;
	if (Factor <= 1) { return Image; }
	FImage Out(Image.Width / Factor, std::max(1u, Image.Height / Factor), Image.Channels, Image.Space);
	for (uint32_t Y = 0; Y < Out.Height; ++Y)
	{
		for (uint32_t X = 0; X < Out.Width; ++X)
		{
			for (uint32_t C = 0; C < Out.Channels; ++C)
			{
				float Sum = 0.0f;
				for (uint32_t I = 0; I < Factor * Factor; ++I)
				{
					const float Value = Image.At(X * Factor + I % Factor, std::min(Y * Factor + I / Factor, Image.Height - 1), C);
					Sum += std::isfinite(Value) ? Value : 0.0f;
				}
				Out.At(X, Y, C) = Sum / float(Factor * Factor);
			}
		}
	}
	return Out;
}

} // namespace Lantern
