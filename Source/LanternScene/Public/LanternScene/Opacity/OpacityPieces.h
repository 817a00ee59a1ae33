// Opacity pieces cover mixed triangles (OpacityClassifier.h) without most of their transparent area. Pieces leave out only
// points that surely fail the alpha test. Rays through the rest meet nothing, and no any-hit shader runs. Pieces are for
// hardware without opacity micromaps: more than half of a foliage card is empty, which is worth a few more triangles.
//
// Pieces overlap each other slightly, so that no ray slips between them. Alpha tests may run twice there, with the same
// result.
#pragma once

#include <span>
#include <vector>

#include "LanternScene/Opacity/OpacityClassifier.h"

namespace Lantern
{

/// One way to cover a triangle.
struct FOpacityPieces
{
	/// Share of the triangle's area that is covered, 0 … 1.
	float Share = 1.0f;
	/// Three corners for each piece: weights of the triangle's second and third corner, as hit shaders have barycentrics.
	/// Winding is the triangle's. Pieces reach beyond the triangle by a thousandth, where hit shaders see nothing.
	std::vector<glm::vec2> Corners;
	size_t GetCount() const { return Corners.size() / 3; }
};

inline constexpr uint32_t MaxOpacityRects = 16, MaxOpacityCells = 64;

/// Returns ways to cover a mixed triangle, each with more pieces and less area than the one before. Empty if nothing can be
/// told or saved. The test is evaluated on a grid of Cells × Cells; Cells is a power of two ≤ MaxOpacityCells.
std::vector<FOpacityPieces> MakeOpacityPieces(
    const FAlphaTest& Test, const FVertexAttributes& A, const FVertexAttributes& B, const FVertexAttributes& C, uint32_t Cells = 32);

/// Mixed triangles of one section, as ClassifySection leaves them at the start of its range.
struct FPieceSource
{
	const FAlphaTest* Test = nullptr; ///< sources with one pointer share cuts of equal triangles
	const FVertexAttributes* Vertices = nullptr;
	const glm::vec3* Positions = nullptr;
	std::span<const uint32_t> Indices;
	/// Area in the world for one square metre of the geometry: the sum over its objects of their scale squared.
	float Weight = 1.0f;
};

/// Contents of FRTGeometryInfo::PiecePositions and PieceIndices. The list is empty, or covers all of a source's triangles.
struct FOpacityPieceList
{
	std::vector<glm::vec3> Positions;
	std::vector<uint32_t> Indices;
	uint32_t GetCount() const { return static_cast<uint32_t>(Positions.size() / 3); }
};

/// Cuts triangles where a piece saves most area, until there are MostExtra more pieces than triangles or nothing is left to
/// save. Runs in parallel. Returns a list for each source.
std::vector<FOpacityPieceList> CutOpacityPieces(std::span<const FPieceSource> Sources, uint64_t MostExtra);

} // namespace Lantern
