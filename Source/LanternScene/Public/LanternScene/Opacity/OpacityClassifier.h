// The classifier finds which triangles of an alpha-tested section need their alpha test. A triangle is opaque if every texel
// that the test can read on it passes, and transparent if every one fails. All others are mixed, and only these must reach
// any-hit shaders.
//
// An engine classifies a section once, at load, on the CPU.
//
//   FAlphaPyramid Pyramid(Texels);                                // once a texture.
//   FAlphaTest Test = MakeAlphaTest(Material, &Pyramid, Sampler); // once a material.
//   ClassifySection(Test, MakeOpacityKey(Material), Vertices, Indices, Section);
//
// It uploads the indices afterwards, since they are reordered. The scene does the rest: an object that uses the section
// with another alpha test gets the unclassified geometry (see FRTSectionInfo).
//
// Opacity micromaps refine this idea: Gruen, Benthin and Woop, "Sub-triangle opacity masks for faster ray tracing of
// transparent objects", HPG 2020.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "LanternRHI/RTTypes.h"
#include "LanternScene/Geometry/Geometry.h"
#include "SceneTypes.h"

namespace Lantern
{

enum class EOpacity : uint8_t
{
	Mixed,
	Opaque,
	Transparent
};

/// The alpha channel of a texture's finest level, as the GPU decodes it: linear, unorm8, by rows from the top.
struct FAlphaTexels
{
	const uint8_t* Alpha = nullptr; ///< of the first texel
	uint32_t Width = 0, Height = 0; ///< > 0
	uint32_t TexelBytes = 1;        ///< from one alpha to the next: 4 for RGBA8
};

struct FAlphaRange
{
	uint8_t Min = 0, Max = 0;
};

/// Least and greatest alpha of blocks of 2^level × 2^level texels. The texels must live as long as the pyramid.
class FAlphaPyramid
{
public:
	explicit FAlphaPyramid(const FAlphaTexels& Texels);

	const FAlphaTexels& GetTexels() const { return Texels; }
	/// Level 0 is the texels. The last level is a single block.
	uint32_t GetLevelCount() const { return static_cast<uint32_t>(Levels.size()) + 1; }
	FAlphaRange GetRange(uint32_t Level, uint32_t X, uint32_t Y) const
	{
		if (Level > 0) { return Levels[Level - 1].Ranges[size_t(Y) * Levels[Level - 1].Width + X]; }
		const uint8_t Value = Texels.Alpha[(size_t(Y) * Texels.Width + X) * Texels.TexelBytes];
		return {Value, Value};
	}

private:
	struct FLevel
	{
		uint32_t Width = 0, Height = 0;
		std::vector<FAlphaRange> Ranges;
	};
	FAlphaTexels Texels;
	std::vector<FLevel> Levels; // from level 1
};

/// What the alpha test of a material reads. A point is cut away if BaseAlpha · vertex alpha · texture alpha < Cutoff, see
/// IsHitCutAway in Shaders/Materials/Standard.glsl.
struct FAlphaTest
{
	const FAlphaPyramid* Texture = nullptr;
	/// If the test has a texture but Texture is null, nothing is known, and all triangles are mixed.
	bool bTextured = false;
	ERTAddress AddressU = ERTAddress::Repeat, AddressV = ERTAddress::Repeat;
	bool bLinear = true; ///< filter; false: nearest
	bool bUV1 = false;   ///< second set of texture coordinates
	float BaseAlpha = 1.0f, Cutoff = 0.5f;
	glm::vec4 UVTransform{1, 0, 0, 1}; ///< rows of the 2×2 part
	glm::vec2 UVOffset{0};
};

/// Texture is null if the material has none. Sampler is that of the base colour texture.
FAlphaTest MakeAlphaTest(const FMaterialData& Material, const FAlphaPyramid* Texture, const FRTSamplerDesc& Sampler);

/// Returns a hash, never 0, of everything in a material that its alpha test depends on. Texels that change under one texture
/// index change no key: if they are replaced, the material must be given another texture.
uint64_t MakeOpacityKey(const FMaterialData& Material, uint32_t Program = 0);

/// Classifies one triangle. Never wrong, whatever the coordinates: a triangle is mixed if the test cannot tell.
EOpacity ClassifyTriangle(const FAlphaTest& Test, const FVertexAttributes& A, const FVertexAttributes& B, const FVertexAttributes& C);

/// Classifies all triangles of Indices, in parallel. Out has a third as many entries as Indices.
void ClassifyTriangles(
    const FAlphaTest& Test, const FVertexAttributes* Vertices, std::span<const uint32_t> Indices, std::span<EOpacity> Out);

struct FOpacityCounts
{
	uint32_t Mixed = 0, Opaque = 0, Transparent = 0; ///< triangles
};

/// Orders triangles mixed | opaque | transparent. Each class keeps the order it had.
FOpacityCounts ReorderByOpacity(std::span<uint32_t> Indices, std::span<const EOpacity> Classes);
FOpacityCounts ReorderByOpacity(std::span<uint16_t> Indices, std::span<const EOpacity> Classes);

/// Classifies a section and reorders its range of Indices (the geometry's). If all triangles are mixed, the section stays
/// as it was. The section must be alpha-tested (bOpaque is false) and made of triangles.
FOpacityCounts ClassifySection(
    const FAlphaTest& Test, uint64_t Key, const FVertexAttributes* Vertices, uint32_t* Indices, FRTSectionInfo& Section);

} // namespace Lantern
