// Key of what a triangle reads of a texture. Thousands of foliage cards share their texture coordinates, and so their cuts.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "LanternScene/Opacity/OpacityClassifier.h"

namespace Lantern
{

struct FFootprintKey
{
	const FAlphaTest* Test;
	std::array<uint32_t, 9> Words; // coordinates and alphas of the corners
	friend bool operator==(const FFootprintKey&, const FFootprintKey&) = default;
};

struct FFootprintHash
{
	size_t operator()(const FFootprintKey& Key) const
	{
		uint64_t Hash = std::bit_cast<uintptr_t>(Key.Test);
		for (const uint32_t Word : Key.Words)
		{
			Hash = (Hash ^ Word) * 0x9e3779b97f4a7c15ull;
			Hash ^= Hash >> 29;
		}
		return Hash;
	}
};

/// Corners points to three indices.
inline FFootprintKey MakeFootprintKey(const FAlphaTest& Test, const FVertexAttributes* Vertices, const uint32_t* Corners)
{
	FFootprintKey Key{&Test, {}};
	for (int I = 0; I < 3; ++I)
	{
		const FVertexAttributes& Vertex = Vertices[Corners[I]];
		const glm::vec2 UV = Test.bUV1 ? Vertex.UV1 : Vertex.UV0;
		Key.Words[3 * I] = std::bit_cast<uint32_t>(UV.x);
		Key.Words[3 * I + 1] = std::bit_cast<uint32_t>(UV.y);
		Key.Words[3 * I + 2] = Vertex.Color >> 24;
	}
	return Key;
}

} // namespace Lantern
