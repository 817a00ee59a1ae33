// Directions in 32 bits, as UnpackOct in Math.glsl reads them.
#pragma once

#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

namespace Lantern
{

/// Packs a direction of any length as 2 × snorm16, octahedral (Cigolle et al. 2014, "A Survey of Efficient Representations for
/// Independent Unit Vectors"). The sum of its components must be finite. Zero becomes +z.
inline uint32_t PackOctahedral(const glm::vec3& N)
{
	const float Sum = std::abs(N.x) + std::abs(N.y) + std::abs(N.z);
	glm::vec2 P = Sum > 0.0f ? glm::vec2(N) / Sum : glm::vec2(0);
	if (N.z < 0.0f)
	{
		const glm::vec2 Sign(P.x >= 0.0f ? 1.0f : -1.0f, P.y >= 0.0f ? 1.0f : -1.0f);
		P = (1.0f - glm::abs(glm::vec2(P.y, P.x))) * Sign;
	}
	return glm::packSnorm2x16(P);
}

} // namespace Lantern
