// Formats of texels, and what follows from them.
#pragma once

#include <cstdint>

namespace Lantern
{

enum class ERTFormat : uint8_t
{
	Unknown,
	R8_UNORM,
	RG8_UNORM,
	RGBA8_UNORM,
	RGBA8_SRGB,
	RGB10A2_UNORM,
	R11G11B10_FLOAT,
	R16_FLOAT,
	RG16_FLOAT,
	RGBA16_FLOAT,
	RG16_UNORM,
	RGBA16_UNORM,
	RG16_SNORM,
	RGBA16_SNORM,
	R16_UINT,
	R32_UINT,
	RG32_UINT,
	RGBA32_UINT,
	R32_FLOAT,
	RG32_FLOAT,
	RGBA32_FLOAT,
	D32_FLOAT,
	RGBA8_SNORM,
	BGRA8_UNORM,
	BGRA8_SRGB,
	D16_UNORM,
	D24_UNORM_S8_UINT, ///< shaders read the depth alone
	D32_FLOAT_S8_UINT, ///< shaders read the depth alone
	// Blocks of 4 × 4 texels: for sampled textures that an engine made, where its device has them.
	BC1_UNORM,
	BC1_SRGB,
	BC3_UNORM,
	BC3_SRGB,
	BC4_UNORM,
	BC5_UNORM,
	BC6H_FLOAT,
	BC7_UNORM,
	BC7_SRGB,
	ASTC4x4_UNORM,
	ASTC4x4_SRGB,
};

constexpr bool IsDepth(ERTFormat Format)
{
	return Format == ERTFormat::D32_FLOAT || (Format >= ERTFormat::D16_UNORM && Format <= ERTFormat::D32_FLOAT_S8_UINT);
}
constexpr bool HasStencil(ERTFormat Format) { return Format == ERTFormat::D24_UNORM_S8_UINT || Format == ERTFormat::D32_FLOAT_S8_UINT; }
constexpr bool IsSrgb(ERTFormat Format)
{
	return Format == ERTFormat::RGBA8_SRGB || Format == ERTFormat::BGRA8_SRGB || Format == ERTFormat::BC1_SRGB ||
	       Format == ERTFormat::BC3_SRGB || Format == ERTFormat::BC7_SRGB || Format == ERTFormat::ASTC4x4_SRGB;
}
constexpr bool IsCompressed(ERTFormat Format) { return Format >= ERTFormat::BC1_UNORM; }
/// Returns the bytes of a block of 4 × 4 texels; 0 for formats without blocks.
constexpr uint32_t BytesPerBlock(ERTFormat Format)
{
	if (!IsCompressed(Format)) { return 0; }
	return Format == ERTFormat::BC1_UNORM || Format == ERTFormat::BC1_SRGB || Format == ERTFormat::BC4_UNORM ? 8 : 16;
}

/// Returns the bytes of one texel; of formats with depth and stencil those of the depth, of formats with blocks 0.
constexpr uint32_t BytesPerTexel(ERTFormat Format)
{
	switch (Format)
	{
	case ERTFormat::Unknown: return 0;
	case ERTFormat::D16_UNORM: return 2;
	case ERTFormat::R8_UNORM: return 1;
	case ERTFormat::RG8_UNORM:
	case ERTFormat::R16_FLOAT:
	case ERTFormat::R16_UINT: return 2;
	case ERTFormat::RGBA8_UNORM:
	case ERTFormat::RGBA8_SRGB:
	case ERTFormat::RGB10A2_UNORM:
	case ERTFormat::R11G11B10_FLOAT:
	case ERTFormat::RG16_FLOAT:
	case ERTFormat::RG16_UNORM:
	case ERTFormat::RG16_SNORM:
	case ERTFormat::R32_UINT:
	case ERTFormat::R32_FLOAT:
	case ERTFormat::RGBA8_SNORM:
	case ERTFormat::BGRA8_UNORM:
	case ERTFormat::BGRA8_SRGB:
	case ERTFormat::D24_UNORM_S8_UINT:
	case ERTFormat::D32_FLOAT_S8_UINT:
	case ERTFormat::D32_FLOAT: return 4;
	case ERTFormat::RGBA16_FLOAT:
	case ERTFormat::RGBA16_UNORM:
	case ERTFormat::RGBA16_SNORM:
	case ERTFormat::RG32_UINT:
	case ERTFormat::RG32_FLOAT: return 8;
	case ERTFormat::RGBA32_UINT:
	case ERTFormat::RGBA32_FLOAT: return 16;
	default: return 0; // blocks
	}
	return 0;
}

} // namespace Lantern
