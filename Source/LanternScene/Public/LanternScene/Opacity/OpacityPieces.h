// Mixed triangles (OpacityClassifier.h) without most of what is transparent in them: a triangle is covered by pieces
// that leave out only points which surely fail the alpha test. Rays that pass through the rest meet nothing, and no
// any-hit shader runs. It is to hardware without opacity micromaps what those are to other hardware: cards of foliage,
// more than half of whose area is empty, are worth a few more triangles.
//
// Pieces overlap each other by a hair, so that no ray slips between them: alpha tests may run twice there, and decide
// the same.
#pragma once

#include <span>
#include <vector>

#include "LanternScene/Opacity/OpacityClassifier.h"

namespace Lantern
{

/// One way to cover a triangle.
struct FOpacityPieces
{
	/// Of the triangle's area that is covered, 0 … 1.
	float Share = 1.0f;
	/// Three for each piece: weights of the second and third corner, as hit shaders have barycentrics. Winding is the
	/// triangle's. They reach beyond it by a thousandth, where hit shaders see nothing.
	std::vector<glm::vec2> Corners;
	size_t GetCount() const { return Corners.size() / 3; }
};

inline constexpr uint32_t MaxOpacityRects = 16, MaxOpacityCells = 64;

/// Ways to cover a mixed triangle, with more pieces and less area each. Empty where nothing can be told or saved. Cells:
/// of the grid on which it is told, along each axis; a power of two.
std::vector<FOpacityPieces> MakeOpacityPieces(
    const FAlphaTest& Test, const FVertexAttributes& A, const FVertexAttributes& B, const FVertexAttributes& C, uint32_t Cells = 32);

/// Mixed triangles of one section, as ClassifySection leaves them at the start of its range.
struct FPieceSource
{
	const FAlphaTest* Test = nullptr; ///< the same pointer for the same test: their triangles are then cut but once
	const FVertexAttributes* Vertices = nullptr;
	const glm::vec3* Positions = nullptr;
	std::span<const uint32_t> Indices;
	/// How much area in the world one square metre of the geometry stands for: its objects, times the square of their scale.
	float Weight = 1.0f;
};

/// Contents of FRTGeometryInfo::PiecePositions and PieceIndices. Either empty, or they cover all of a source's triangles.
struct FOpacityPieceList
{
	std::vector<glm::vec3> Positions;
	std::vector<uint32_t> Indices;
	uint32_t GetCount() const { return static_cast<uint32_t>(Positions.size() / 3); }
};

/// Cuts triangles where it saves most area for a piece, until there are MostExtra more pieces than triangles or nothing
/// is left to be saved. In parallel. Out: for each source.
std::vector<FOpacityPieceList> CutOpacityPieces(std::span<const FPieceSource> Sources, uint64_t MostExtra);

} // namespace Lantern
