// The encodings of FVertexAttributes (SceneTypes.h), both ways. Unit vectors are octahedral (Cigolle et al., "A Survey
// of Efficient Representations for Independent Unit Vectors", JCGT 2014), 2 × snorm16 as GLSL's packSnorm2x16 has it:
// x in the low half, rounded to the nearest of ±32767.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace Lantern
{

/// Unit vector (need not be exactly normalised; not zero, finite) → octahedral.
uint32_t PackUnitVector(const glm::vec3& V);
glm::vec3 UnpackUnitVector(uint32_t Packed);

/// xyz: unit tangent; w: ±1, the sign of the bitangent, kept in the lowest bit of y's half (1: −).
uint32_t PackTangent(const glm::vec4& Tangent);
glm::vec4 UnpackTangent(uint32_t Packed);

/// Linear, clamped to 0 … 1; red in the lowest byte.
uint32_t PackColor(const glm::vec4& Color);
glm::vec4 UnpackColor(uint32_t Packed);

} // namespace Lantern
