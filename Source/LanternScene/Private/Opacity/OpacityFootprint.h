// Finds which texels a triangle's alpha test can read, and whether all of them pass or fail.
#pragma once

#include <array>

#include "LanternScene/Opacity/OpacityPieces.h"

namespace Lantern
{

/// Texels of at least PassFrom surely pass the test, those of at most FailUpTo surely fail it.
struct FAlphaLimits
{
	int PassFrom = 256;
	int FailUpTo = -1;
};

/// A triangle's corners in texels, unwrapped.
struct FTexelTriangle
{
	glm::dvec2 P[3];
	/// Greatest absolute value, in UV, of the terms that their computation adds up. It bounds the rounding error.
	glm::dvec2 Magnitude{0};
};

/// Returns false if the shader's own arithmetic would not be finite.
bool MakeTexelTriangle(const FAlphaTest& Test, const FVertexAttributes* const (&Corners)[3], FTexelTriangle& Out);
FAlphaLimits MakeAlphaLimits(const FAlphaTest& Test, const FVertexAttributes* const (&Corners)[3]);

EOpacity ClassifyFootprint(const FAlphaTest& Test, const FAlphaLimits& Limits, const FTexelTriangle& Triangle);
/// Marks, as bit x of Rows[y], the cells of a grid that the triangle overlaps and that are not wholly transparent. May mark
/// some that are. The grid begins at Origin and has Cells (a power of two) cells of Step texels along each axis.
void MarkCells(const FAlphaTest& Test, const FAlphaLimits& Limits, const FTexelTriangle& Triangle, glm::dvec2 Origin, glm::dvec2 Step,
    uint32_t Cells, std::array<uint64_t, MaxOpacityCells>& Rows);

} // namespace Lantern
