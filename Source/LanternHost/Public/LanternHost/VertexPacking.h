// Packs and unpacks FVertexAttributes (SceneTypes.h). Unit vectors are octahedral (Cigolle et al., "A Survey of Efficient
// Representations for Independent Unit Vectors", JCGT 2014), 2 × snorm16. The layout is that of GLSL's packSnorm2x16: x is in
// the low half, rounded to the nearest of ±32767.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace Lantern
{

/// Packs a unit vector. V need not be exactly normalised, but must be finite and not zero.
uint32_t PackUnitVector(const glm::vec3& V);
glm::vec3 UnpackUnitVector(uint32_t Packed);

/// Packs a unit tangent (xyz) and the sign of the bitangent (w: ±1), which goes to the lowest bit of y's half (1: −).
uint32_t PackTangent(const glm::vec4& Tangent);
glm::vec4 UnpackTangent(uint32_t Packed);

/// Packs a linear colour, clamped to 0 … 1, with red in the lowest byte.
uint32_t PackColor(const glm::vec4& Color);
glm::vec4 UnpackColor(uint32_t Packed);

} // namespace Lantern
