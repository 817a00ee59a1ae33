// Colour spaces and the colour error of FLIP (sections 4.1.2 to 4.1.4 of the 2020 paper).
#pragma once

namespace Lantern
{

struct FColor3
{
	float X = 0.0f, Y = 0.0f, Z = 0.0f;
};

/// Converts linear Rec.709 to the opponent space in which contrast sensitivity was measured. Its first component is
/// 116 · luminance − 16.
FColor3 LinearToYCxCz(const FColor3& Rgb);
/// Converts back to linear Rec.709, clamped to 0 to 1.
FColor3 YCxCzToLinear(const FColor3& Opponent);

/// Converts linear Rec.709 to CIELAB with the Hunt effect: chroma counts less in the dark.
FColor3 LinearToHuntLab(const FColor3& Rgb);

/// Distance of two Hunt-adjusted colours, 0 to 1. It is HyAB, which suits large differences, raised to q_c. It is then redistributed, so
/// that small and medium errors use most of the range.
float ComputeFlipColorError(const FColor3& A, const FColor3& B);

} // namespace Lantern
