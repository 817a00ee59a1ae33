// Maps accesses to usage flags, layouts and names.
#include "FrameGraph/FrameGraphAccess.h"

namespace Lantern
{

ERTTextureUsage GetTextureUsage(ERTAccess Access)
{
	ERTTextureUsage Usage = ERTTextureUsage::None;
	const auto Add = [&](ERTAccess Bits, ERTTextureUsage Needed) {
		if (HasAny(Access, Bits)) { Usage |= Needed; }
	};
	Add(ERTAccess::ShaderRead, ERTTextureUsage::Sampled);
	Add(ERTAccess::StorageRead | ERTAccess::StorageWrite, ERTTextureUsage::Storage);
	Add(ERTAccess::RenderTarget, ERTTextureUsage::RenderTarget);
	Add(ERTAccess::DepthWrite, ERTTextureUsage::Depth);
	Add(ERTAccess::CopyRead, ERTTextureUsage::CopySource);
	Add(ERTAccess::CopyWrite, ERTTextureUsage::CopyDest);
	return Usage;
}

ERTBufferUsage GetBufferUsage(ERTAccess Access)
{
	ERTBufferUsage Usage = ERTBufferUsage::None;
	const auto Add = [&](ERTAccess Bits, ERTBufferUsage Needed) {
		if (HasAny(Access, Bits)) { Usage |= Needed; }
	};
	Add(ERTAccess::ShaderRead | ERTAccess::StorageRead | ERTAccess::StorageWrite, ERTBufferUsage::Storage);
	Add(ERTAccess::IndexRead, ERTBufferUsage::Index);
	Add(ERTAccess::IndirectRead, ERTBufferUsage::Indirect);
	Add(ERTAccess::CopyRead, ERTBufferUsage::CopySource);
	Add(ERTAccess::CopyWrite, ERTBufferUsage::CopyDest);
	Add(ERTAccess::GeometryInput, ERTBufferUsage::GeometryInput);
	Add(ERTAccess::BuildRead | ERTAccess::BuildWrite, ERTBufferUsage::Scratch);
	Add(ERTAccess::TraceRead, ERTBufferUsage::ShaderTable);
	return Usage;
}

std::string ToString(ERTAccess Access)
{
	static constexpr const char* Names[] = {"ShaderRead", "StorageRead", "StorageWrite", "RenderTarget", "DepthWrite", "IndexRead",
	    "IndirectRead", "CopyRead", "CopyWrite", "GeometryInput", "BuildRead", "BuildWrite", "TraceRead", "HostRead", "External"};
	std::string Text;
	for (uint32_t Bit = 0; Bit < sizeof(Names) / sizeof(Names[0]); ++Bit)
	{
		if ((static_cast<uint32_t>(Access) >> Bit) & 1u) { Text += (Text.empty() ? "" : "|") + std::string(Names[Bit]); }
	}
	return Text.empty() ? "None" : Text;
}

const char* ToString(ERTFormat Format)
{
	switch (Format)
	{
	case ERTFormat::Unknown: return "Unknown";
	case ERTFormat::R8_UNORM: return "R8_UNORM";
	case ERTFormat::RG8_UNORM: return "RG8_UNORM";
	case ERTFormat::RGBA8_UNORM: return "RGBA8_UNORM";
	case ERTFormat::RGBA8_SRGB: return "RGBA8_SRGB";
	case ERTFormat::RGB10A2_UNORM: return "RGB10A2_UNORM";
	case ERTFormat::R11G11B10_FLOAT: return "R11G11B10_FLOAT";
	case ERTFormat::R16_FLOAT: return "R16_FLOAT";
	case ERTFormat::RG16_FLOAT: return "RG16_FLOAT";
	case ERTFormat::RGBA16_FLOAT: return "RGBA16_FLOAT";
	case ERTFormat::RG16_UNORM: return "RG16_UNORM";
	case ERTFormat::RGBA16_UNORM: return "RGBA16_UNORM";
	case ERTFormat::RG16_SNORM: return "RG16_SNORM";
	case ERTFormat::RGBA16_SNORM: return "RGBA16_SNORM";
	case ERTFormat::R16_UINT: return "R16_UINT";
	case ERTFormat::R32_UINT: return "R32_UINT";
	case ERTFormat::RG32_UINT: return "RG32_UINT";
	case ERTFormat::RGBA32_UINT: return "RGBA32_UINT";
	case ERTFormat::R32_FLOAT: return "R32_FLOAT";
	case ERTFormat::RG32_FLOAT: return "RG32_FLOAT";
	case ERTFormat::RGBA32_FLOAT: return "RGBA32_FLOAT";
	case ERTFormat::D32_FLOAT: return "D32_FLOAT";
	case ERTFormat::RGBA8_SNORM: return "RGBA8_SNORM";
	case ERTFormat::BGRA8_UNORM: return "BGRA8_UNORM";
	case ERTFormat::BGRA8_SRGB: return "BGRA8_SRGB";
	case ERTFormat::D16_UNORM: return "D16_UNORM";
	case ERTFormat::D24_UNORM_S8_UINT: return "D24_UNORM_S8_UINT";
	case ERTFormat::D32_FLOAT_S8_UINT: return "D32_FLOAT_S8_UINT";
	case ERTFormat::BC1_UNORM: return "BC1_UNORM";
	case ERTFormat::BC1_SRGB: return "BC1_SRGB";
	case ERTFormat::BC3_UNORM: return "BC3_UNORM";
	case ERTFormat::BC3_SRGB: return "BC3_SRGB";
	case ERTFormat::BC4_UNORM: return "BC4_UNORM";
	case ERTFormat::BC5_UNORM: return "BC5_UNORM";
	case ERTFormat::BC6H_FLOAT: return "BC6H_FLOAT";
	case ERTFormat::BC7_UNORM: return "BC7_UNORM";
	case ERTFormat::BC7_SRGB: return "BC7_SRGB";
	case ERTFormat::ASTC4x4_UNORM: return "ASTC4x4_UNORM";
	case ERTFormat::ASTC4x4_SRGB: return "ASTC4x4_SRGB";
	}
	return "?";
}

} // namespace Lantern
