// The texels of an octahedral map of the sky, for tests of sky maps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace Lantern
{

/// Returns Size · Size texels, row by row: GetRadiance of the unit direction at each texel's centre, and alpha 1 (Cigolle et al. 2014).
template <class FGet>
std::vector<glm::vec4> MakeOctahedralTexels(uint32_t Size, FGet GetRadiance)
{
	std::vector<glm::vec4> Texels;
	for (uint32_t Texel = 0; Texel < Size * Size; ++Texel)
	{
		const glm::vec2 E = (glm::vec2(Texel % Size, Texel / Size) + 0.5f) * (2.0f / float(Size)) - 1.0f;
		glm::vec3 V(E, 1.0f - std::abs(E.x) - std::abs(E.y));
		const float Fold = std::max(-V.z, 0.0f);
		V.x += V.x >= 0.0f ? -Fold : Fold;
		V.y += V.y >= 0.0f ? -Fold : Fold;
		Texels.emplace_back(glm::vec3(GetRadiance(glm::normalize(V))), 1.0f);
	}
	return Texels;
}

} // namespace Lantern
