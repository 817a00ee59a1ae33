// Encoding and filtering of texels on the CPU.
#include "MockTexels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

namespace Lantern
{
namespace
{

float SrgbToLinear(float V) { return V <= 0.04045f ? V / 12.92f : std::pow((V + 0.055f) / 1.055f, 2.4f); }
float LinearToSrgb(float V) { return V <= 0.0031308f ? V * 12.92f : 1.055f * std::pow(V, 1.0f / 2.4f) - 0.055f; }

enum class EChannel : uint8_t
{
	Unorm8,
	Snorm8,
	Unorm24,
	Srgb8,
	Unorm16,
	Snorm16,
	Half,
	Float,
	UInt16,
	UInt32,
	Packed
};

struct FLayout
{
	EChannel Channel;
	uint32_t Count;
};

FLayout GetLayout(ERTFormat Format)
{
	switch (Format)
	{
	case ERTFormat::R8_UNORM: return {EChannel::Unorm8, 1};
	case ERTFormat::RG8_UNORM: return {EChannel::Unorm8, 2};
	case ERTFormat::RGBA8_UNORM: return {EChannel::Unorm8, 4};
	case ERTFormat::BGRA8_UNORM: return {EChannel::Unorm8, 4};
	case ERTFormat::RGBA8_SNORM: return {EChannel::Snorm8, 4};
	case ERTFormat::BGRA8_SRGB:
	case ERTFormat::RGBA8_SRGB: return {EChannel::Srgb8, 4};
	case ERTFormat::D16_UNORM: return {EChannel::Unorm16, 1};
	case ERTFormat::R16_FLOAT: return {EChannel::Half, 1};
	case ERTFormat::RG16_FLOAT: return {EChannel::Half, 2};
	case ERTFormat::RGBA16_FLOAT: return {EChannel::Half, 4};
	case ERTFormat::RG16_UNORM: return {EChannel::Unorm16, 2};
	case ERTFormat::RGBA16_UNORM: return {EChannel::Unorm16, 4};
	case ERTFormat::RG16_SNORM: return {EChannel::Snorm16, 2};
	case ERTFormat::RGBA16_SNORM: return {EChannel::Snorm16, 4};
	case ERTFormat::R16_UINT: return {EChannel::UInt16, 1};
	case ERTFormat::R32_UINT: return {EChannel::UInt32, 1};
	case ERTFormat::RG32_UINT: return {EChannel::UInt32, 2};
	case ERTFormat::RGBA32_UINT: return {EChannel::UInt32, 4};
	case ERTFormat::R32_FLOAT:
	case ERTFormat::D32_FLOAT_S8_UINT:
	case ERTFormat::D32_FLOAT: return {EChannel::Float, 1};
	case ERTFormat::RG32_FLOAT: return {EChannel::Float, 2};
	case ERTFormat::RGBA32_FLOAT: return {EChannel::Float, 4};
	case ERTFormat::RGB10A2_UNORM:
	case ERTFormat::R11G11B10_FLOAT: return {EChannel::Packed, 4};
	case ERTFormat::D24_UNORM_S8_UINT: return {EChannel::Unorm24, 1};
	default: break; // no texels of their own: blocks
	}
	return {EChannel::Packed, 0};
}

template <class T>
T Load(const uint8_t* From, uint32_t Index)
{
	T Value;
	std::memcpy(&Value, From + Index * sizeof(T), sizeof(T));
	return Value;
}

template <class T>
void Store(uint8_t* To, uint32_t Index, T Value)
{
	std::memcpy(To + Index * sizeof(T), &Value, sizeof(T));
}

float Quantise(float Value, float Most) { return std::floor(std::clamp(Value, 0.0f, 1.0f) * Most + 0.5f); }

void DecodePacked(ERTFormat Format, const uint8_t* Texel, float Out[4])
{
	const uint32_t Word = Load<uint32_t>(Texel, 0);
	glm::vec4 Value(0, 0, 0, 1);
	if (Format == ERTFormat::RGB10A2_UNORM) { Value = glm::unpackUnorm3x10_1x2(Word); }
	else if (Format == ERTFormat::R11G11B10_FLOAT) { Value = glm::vec4(glm::unpackF2x11_1x10(Word), 1.0f); }
	for (int i = 0; i < 4; ++i) { Out[i] = Value[i]; }
}

void EncodePacked(ERTFormat Format, const float V[4], uint8_t* Texel)
{
	if (Format == ERTFormat::RGB10A2_UNORM) { Store(Texel, 0, glm::packUnorm3x10_1x2({V[0], V[1], V[2], V[3]})); }
	else if (Format == ERTFormat::R11G11B10_FLOAT) { Store(Texel, 0, glm::packF2x11_1x10({V[0], V[1], V[2]})); }
}

float DecodeChannel(EChannel Channel, const uint8_t* Texel, uint32_t i)
{
	switch (Channel)
	{
	case EChannel::Unorm8: return Texel[i] / 255.0f;
	case EChannel::Srgb8: return i < 3 ? SrgbToLinear(Texel[i] / 255.0f) : Texel[i] / 255.0f;
	case EChannel::Snorm8: return std::max(-1.0f, static_cast<int8_t>(Texel[i]) / 127.0f);
	case EChannel::Unorm24: return static_cast<float>((Load<uint32_t>(Texel, i) & 0xffffffu) / 16777215.0);
	case EChannel::Unorm16: return Load<uint16_t>(Texel, i) / 65535.0f;
	case EChannel::Snorm16: return std::max(-1.0f, Load<int16_t>(Texel, i) / 32767.0f);
	case EChannel::Half: return glm::unpackHalf1x16(Load<uint16_t>(Texel, i));
	case EChannel::Float: return Load<float>(Texel, i);
	case EChannel::UInt16: return static_cast<float>(Load<uint16_t>(Texel, i));
	case EChannel::UInt32: return static_cast<float>(Load<uint32_t>(Texel, i));
	case EChannel::Packed: break;
	}
	return 0.0f;
}

void EncodeChannel(EChannel Channel, float Value, uint8_t* Texel, uint32_t i)
{
	switch (Channel)
	{
	case EChannel::Unorm8: Texel[i] = static_cast<uint8_t>(Quantise(Value, 255.0f)); break;
	case EChannel::Srgb8: Texel[i] = static_cast<uint8_t>(Quantise(i < 3 ? LinearToSrgb(std::max(Value, 0.0f)) : Value, 255.0f)); break;
	case EChannel::Snorm8: Texel[i] = static_cast<uint8_t>(std::lround(std::clamp(Value, -1.0f, 1.0f) * 127.0f)); break;
	case EChannel::Unorm24: Store(Texel, i, static_cast<uint32_t>(std::clamp(double(Value), 0.0, 1.0) * 16777215.0 + 0.5)); break;
	case EChannel::Unorm16: Store(Texel, i, static_cast<uint16_t>(Quantise(Value, 65535.0f))); break;
	case EChannel::Snorm16: Store(Texel, i, static_cast<int16_t>(std::lround(std::clamp(Value, -1.0f, 1.0f) * 32767.0f))); break;
	case EChannel::Half: Store(Texel, i, glm::packHalf1x16(Value)); break;
	case EChannel::Float: Store(Texel, i, Value); break;
	case EChannel::UInt16: Store(Texel, i, static_cast<uint16_t>(std::clamp(Value, 0.0f, 65535.0f))); break;
	case EChannel::UInt32: Store(Texel, i, static_cast<uint32_t>(std::clamp(static_cast<double>(Value), 0.0, 4294967295.0))); break;
	case EChannel::Packed: break;
	}
}

} // namespace

void DecodeTexel(ERTFormat Format, const uint8_t* Texel, float OutValue[4])
{
	const FLayout Layout = GetLayout(Format);
	if (Layout.Channel == EChannel::Packed) { return DecodePacked(Format, Texel, OutValue); }
	for (uint32_t i = 0; i < 4; ++i) { OutValue[i] = i < Layout.Count ? DecodeChannel(Layout.Channel, Texel, i) : (i == 3 ? 1.0f : 0.0f); }
}

void EncodeTexel(ERTFormat Format, const float Value[4], uint8_t* OutTexel)
{
	const FLayout Layout = GetLayout(Format);
	if (Layout.Channel == EChannel::Packed) { return EncodePacked(Format, Value, OutTexel); }
	for (uint32_t i = 0; i < Layout.Count; ++i) { EncodeChannel(Layout.Channel, Value[i], OutTexel, i); }
}

void FilterBox(ERTFormat Format, const FTexelPlane& Source, const FTexelPlane& Dest)
{
	const uint32_t Step = BytesPerTexel(Format);
	const double ScaleX = static_cast<double>(Source.Width) / Dest.Width;
	const double ScaleY = static_cast<double>(Source.Height) / Dest.Height;
	const auto Overlap = [](double From, double To, uint32_t Cell) {
		return std::max(0.0, std::min(To, Cell + 1.0) - std::max(From, static_cast<double>(Cell)));
	};
	for (uint32_t Y = 0; Y < Dest.Height; ++Y)
	{
		for (uint32_t X = 0; X < Dest.Width; ++X)
		{
			double Sum[4] = {};
			const double Left = X * ScaleX, Right = Left + ScaleX, Top = Y * ScaleY, Bottom = Top + ScaleY;
			for (uint32_t V = static_cast<uint32_t>(Top); V < Source.Height && V < Bottom; ++V)
			{
				for (uint32_t U = static_cast<uint32_t>(Left); U < Source.Width && U < Right; ++U)
				{
					float Value[4];
					DecodeTexel(Format, Source.Texels + (static_cast<size_t>(V) * Source.Width + U) * Step, Value);
					const double Weight = Overlap(Left, Right, U) * Overlap(Top, Bottom, V) / (ScaleX * ScaleY);
					for (int i = 0; i < 4; ++i) { Sum[i] += Weight * Value[i]; }
				}
			}
			const float Mean[4] = {
			    static_cast<float>(Sum[0]), static_cast<float>(Sum[1]), static_cast<float>(Sum[2]), static_cast<float>(Sum[3])};
			EncodeTexel(Format, Mean, Dest.Texels + (static_cast<size_t>(Y) * Dest.Width + X) * Step);
		}
	}
}

} // namespace Lantern
