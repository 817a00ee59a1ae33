// Packs vertex attributes as shaders read them.
#include "LanternHost/VertexPacking.h"

#include <cmath>

namespace Lantern
{

namespace
{

constexpr uint32_t TangentSignBit = 1u << 16;

uint32_t PackSnorm2x16(const glm::vec2& V)
{
	const auto Quantise = [](float X) { return uint32_t(uint16_t(int16_t(std::lround(glm::clamp(X, -1.0f, 1.0f) * 32767.0f)))); };
	return Quantise(V.x) | Quantise(V.y) << 16;
}

glm::vec2 UnpackSnorm2x16(uint32_t Packed)
{
	const glm::vec2 V(float(int16_t(Packed & 0xffff)), float(int16_t(Packed >> 16)));
	return glm::clamp(V / 32767.0f, -1.0f, 1.0f);
}

glm::vec2 SignNotZero(const glm::vec2& V) { return {V.x >= 0 ? 1.0f : -1.0f, V.y >= 0 ? 1.0f : -1.0f}; }

} // namespace

uint32_t PackUnitVector(const glm::vec3& V)
{
	const float Sum = std::abs(V.x) + std::abs(V.y) + std::abs(V.z);
	glm::vec2 P = glm::vec2(V) / Sum;
	if (V.z < 0) { P = (1.0f - glm::abs(glm::vec2(P.y, P.x))) * SignNotZero(P); }
	return PackSnorm2x16(P);
}

glm::vec3 UnpackUnitVector(uint32_t Packed)
{
	const glm::vec2 P = UnpackSnorm2x16(Packed);
	glm::vec3 V(P, 1.0f - std::abs(P.x) - std::abs(P.y));
	if (V.z < 0)
	{
		const glm::vec2 Folded = (1.0f - glm::abs(glm::vec2(P.y, P.x))) * SignNotZero(P);
		V.x = Folded.x;
		V.y = Folded.y;
	}
	return glm::normalize(V);
}

uint32_t PackTangent(const glm::vec4& Tangent)
{
	const uint32_t Packed = PackUnitVector(glm::vec3(Tangent)) & ~TangentSignBit;
	return Tangent.w < 0 ? Packed | TangentSignBit : Packed;
}

glm::vec4 UnpackTangent(uint32_t Packed)
{
	return {UnpackUnitVector(Packed & ~TangentSignBit), (Packed & TangentSignBit) != 0 ? -1.0f : 1.0f};
}

uint32_t PackColor(const glm::vec4& Color)
{
	uint32_t Packed = 0;
	for (int I = 0; I < 4; ++I) { Packed |= uint32_t(std::lround(glm::clamp(Color[I], 0.0f, 1.0f) * 255.0f)) << (8 * I); }
	return Packed;
}

glm::vec4 UnpackColor(uint32_t Packed) { return glm::vec4(Packed & 0xff, Packed >> 8 & 0xff, Packed >> 16 & 0xff, Packed >> 24) / 255.0f; }

} // namespace Lantern
