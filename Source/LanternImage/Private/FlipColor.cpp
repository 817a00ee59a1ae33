// Colour spaces and the colour error of FLIP.
#include "FlipColor.h"

#include <algorithm>
#include <cmath>

namespace Lantern
{

namespace
{

// Parameters of the paper.
constexpr float Qc = 0.7f;
constexpr float Pc = 0.4f;
constexpr float Pt = 0.95f;

struct FMatrix3
{
	double M[3][3] = {};
};

/// From the chromaticities of Rec.709 and the D65 white point (0.3127, 0.3290).
constexpr FMatrix3 RgbToXyz = {{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};

/// By cofactors; indices wrap, which gives the signs.
constexpr FMatrix3 Invert(const FMatrix3& A)
{
	FMatrix3 Inverse;
	double Determinant = 0.0;
	for (int Row = 0; Row < 3; ++Row)
	{
		for (int Column = 0; Column < 3; ++Column)
		{
			const int R1 = (Row + 1) % 3, R2 = (Row + 2) % 3, C1 = (Column + 1) % 3, C2 = (Column + 2) % 3;
			Inverse.M[Column][Row] = A.M[R1][C1] * A.M[R2][C2] - A.M[R1][C2] * A.M[R2][C1];
		}
		Determinant += A.M[Row][0] * Inverse.M[0][Row];
	}
	for (auto& Row : Inverse.M)
	{
		for (double& Value : Row) { Value /= Determinant; }
	}
	return Inverse;
}

/// Rows divided by the white point, so that white becomes (1, 1, 1): all that follows needs only such ratios.
constexpr FMatrix3 NormaliseToWhite(FMatrix3 A)
{
	for (auto& Row : A.M)
	{
		const double White = Row[0] + Row[1] + Row[2];
		for (double& Value : Row) { Value /= White; }
	}
	return A;
}

struct FMatrix3f
{
	float M[3][3] = {};
};

constexpr FMatrix3f ToFloat(const FMatrix3& A)
{
	FMatrix3f B;
	for (int Row = 0; Row < 3; ++Row)
	{
		for (int Column = 0; Column < 3; ++Column) { B.M[Row][Column] = static_cast<float>(A.M[Row][Column]); }
	}
	return B;
}

constexpr FMatrix3f RgbToRelativeXyz = ToFloat(NormaliseToWhite(RgbToXyz));
constexpr FMatrix3f RelativeXyzToRgb = ToFloat(Invert(NormaliseToWhite(RgbToXyz)));

FColor3 Multiply(const FMatrix3f& A, const FColor3& V)
{
	return {A.M[0][0] * V.X + A.M[0][1] * V.Y + A.M[0][2] * V.Z, A.M[1][0] * V.X + A.M[1][1] * V.Y + A.M[1][2] * V.Z,
	    A.M[2][0] * V.X + A.M[2][1] * V.Y + A.M[2][2] * V.Z};
}

/// CIELAB's cube root with its straight part near black.
float CompressLab(float Ratio)
{
	constexpr float Delta = 6.0f / 29.0f;
	return Ratio > Delta * Delta * Delta ? std::cbrt(Ratio) : Ratio / (3.0f * Delta * Delta) + 4.0f / 29.0f;
}

float ComputeHyAb(const FColor3& A, const FColor3& B)
{
	const float DeltaA = A.Y - B.Y;
	const float DeltaB = A.Z - B.Z;
	return std::abs(A.X - B.X) + std::sqrt(DeltaA * DeltaA + DeltaB * DeltaB);
}

/// The largest distance in the gamut, between green and blue.
float GetLargestError()
{
	static const float Largest = std::pow(ComputeHyAb(LinearToHuntLab({0.0f, 1.0f, 0.0f}), LinearToHuntLab({0.0f, 0.0f, 1.0f})), Qc);
	return Largest;
}

} // namespace

FColor3 LinearToYCxCz(const FColor3& Rgb)
{
	const FColor3 Xyz = Multiply(RgbToRelativeXyz, Rgb);
	return {116.0f * Xyz.Y - 16.0f, 500.0f * (Xyz.X - Xyz.Y), 200.0f * (Xyz.Y - Xyz.Z)};
}

FColor3 YCxCzToLinear(const FColor3& Opponent)
{
	const float Y = (Opponent.X + 16.0f) / 116.0f;
	const FColor3 Rgb = Multiply(RelativeXyzToRgb, {Y + Opponent.Y / 500.0f, Y, Y - Opponent.Z / 200.0f});
	return {std::clamp(Rgb.X, 0.0f, 1.0f), std::clamp(Rgb.Y, 0.0f, 1.0f), std::clamp(Rgb.Z, 0.0f, 1.0f)};
}

FColor3 LinearToHuntLab(const FColor3& Rgb)
{
	const FColor3 Xyz = Multiply(RgbToRelativeXyz, Rgb);
	const FColor3 F = {CompressLab(Xyz.X), CompressLab(Xyz.Y), CompressLab(Xyz.Z)};
	const float L = 116.0f * F.Y - 16.0f;
	return {L, 0.01f * L * 500.0f * (F.X - F.Y), 0.01f * L * 200.0f * (F.Y - F.Z)};
}

float ComputeFlipColorError(const FColor3& A, const FColor3& B)
{
	const float Largest = GetLargestError();
	const float Knee = Pc * Largest;
	const float Error = std::pow(ComputeHyAb(A, B), Qc);
	const float Redistributed = Error < Knee ? Pt / Knee * Error : Pt + (Error - Knee) / (Largest - Knee) * (1.0f - Pt);
	return std::min(Redistributed, 1.0f);
}

} // namespace Lantern
