// How FMaterialData::Textures names a texture together with its sampler.
#pragma once

#include "SceneTypes.h"

namespace Lantern
{

/// Packs a sampled index and a sampler index into a texture slot. Returns false, and NO_TEXTURE, if one of them does not fit. A
/// texture without ERTTextureUsage::Sampled never does.
constexpr bool MakeTextureSlot(uint32_t SampledIndex, uint32_t SamplerIndex, uint32_t& OutSlot)
{
	const bool bFits = SampledIndex < 1u << TEXTURE_INDEX_BITS && SamplerIndex < 1u << (32 - TEXTURE_INDEX_BITS);
	OutSlot = bFits ? SampledIndex | SamplerIndex << TEXTURE_INDEX_BITS : NO_TEXTURE;
	return OutSlot != NO_TEXTURE;
}

} // namespace Lantern
