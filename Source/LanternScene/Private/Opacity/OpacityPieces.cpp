// MakeOpacityPieces: a triangle's footprint is laid over a grid, and cells that are not surely transparent are marked. Boxes
// around marked cells are split where that saves most area. Each box, clipped by the triangle, makes pieces.
#include "LanternScene/Opacity/OpacityPieces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "Opacity/OpacityFootprint.h"

namespace Lantern
{

namespace
{
// Pieces overlap each other by this share of a cell, and the triangle's border by this share of the triangle. The rounding
// of their corners must not open a gap, not even far from the origin.
constexpr double CellOverlap = 1.0 / 128.0;
constexpr double TriangleOverlap = 1.0 / 2048.0;
constexpr double LeastSaving = 0.002; // of the triangle's area, for a split
constexpr double LeastCorner = 0.006; // for a corner cut off

/// A convex polygon. A triangle has three corners, and each side of an octagon adds one at most.
struct FPolygon
{
	std::array<glm::dvec2, 12> Corners;
	size_t Count = 0;
	void Add(glm::dvec2 Corner)
	{
		if (Count < Corners.size()) { Corners[Count++] = Corner; }
	}
	const glm::dvec2& operator[](size_t I) const { return Corners[I]; }
	const glm::dvec2& Next(size_t I) const { return Corners[I + 1 < Count ? I + 1 : 0]; }
};

double GetArea(const FPolygon& P)
{
	double Twice = 0.0;
	for (size_t I = 0; I < P.Count; ++I) { Twice += P[I].x * P.Next(I).y - P[I].y * P.Next(I).x; }
	return 0.5 * std::abs(Twice);
}

/// Keeps the part up to Limit along Normal (Sutherland and Hodgman 1974, for one side).
FPolygon Clip(const FPolygon& In, glm::dvec2 Normal, double Limit)
{
	FPolygon Out;
	for (size_t I = 0; I < In.Count; ++I)
	{
		const glm::dvec2 &A = In[I], &B = In.Next(I);
		const double DistanceA = Limit - glm::dot(Normal, A), DistanceB = Limit - glm::dot(Normal, B);
		if (DistanceA >= 0.0) { Out.Add(A); }
		if ((DistanceA >= 0.0) != (DistanceB >= 0.0)) { Out.Add(A + (B - A) * (DistanceA / (DistanceA - DistanceB))); }
	}
	return Out;
}

constexpr glm::dvec2 Diagonals[4] = {{1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

struct FRect
{
	int X0 = 0, Y0 = 0, X1 = 0, Y1 = 0; // cells, half open
	bool IsEmpty() const { return X0 >= X1 || Y0 >= Y1; }
};

struct FSplit
{
	FRect Low, High;
	double Saving = 0.0;
};

/// The grid's coordinates are its own: the triangle's box is [0, cells]².
class FPieceGrid
{
public:
	FPieceGrid(const FTexelTriangle& T, uint32_t InCells)
	    : Cells(static_cast<int>(InCells)),
	      Origin(glm::min(T.P[0], glm::min(T.P[1], T.P[2])))
	{
		Step = (glm::max(T.P[0], glm::max(T.P[1], T.P[2])) - Origin) / double(Cells);
		for (const glm::dvec2 Corner : T.P) { Triangle.Add((Corner - Origin) / Step); }
		Area = GetArea(Triangle);
	}
	bool IsUsable() const { return Step.x > 0.0 && Step.y > 0.0 && Area > 1e-3 && std::isfinite(Area); }

	void Mark(const FAlphaTest& Test, const FAlphaLimits& Limits, const FTexelTriangle& T)
	{
		MarkCells(Test, Limits, T, Origin, Step, static_cast<uint32_t>(Cells), Rows);
	}
	FRect Tighten(FRect R) const
	{
		const uint64_t Columns = GetColumns(R);
		uint64_t Any = 0;
		int First = R.Y1, Last = R.Y0 - 1;
		for (int Y = R.Y0; Y < R.Y1; ++Y)
		{
			if (const uint64_t Row = Rows[Y] & Columns)
			{
				Any |= Row;
				First = std::min(First, Y);
				Last = Y;
			}
		}
		return Any ? FRect{std::countr_zero(Any), First, 64 - std::countl_zero(Any), Last + 1} : FRect{};
	}
	/// Returns how far marked cells reach along Diagonals.
	std::array<double, 4> FindReach(const FRect& R) const
	{
		const uint64_t Columns = GetColumns(R);
		std::array<double, 4> Reach = {-1e9, -1e9, -1e9, -1e9};
		for (int Y = R.Y0; Y < R.Y1; ++Y)
		{
			if (const uint64_t Row = Rows[Y] & Columns)
			{
				const double First = std::countr_zero(Row), Last = 64 - std::countl_zero(Row);
				const double Of[4] = {Last + Y + 1, Last - Y, Y + 1 - First, -First - Y};
				for (int I = 0; I < 4; ++I) { Reach[I] = std::max(Reach[I], Of[I]); }
			}
		}
		return Reach;
	}
	/// Returns the rectangle, larger by Overlap on each side, clipped by Shape. Corners that are worth it are cut off.
	FPolygon GetPolygon(const FRect& R, double Overlap, const FPolygon& Shape) const
	{
		FPolygon Out = Clip(Clip(Shape, {1, 0}, R.X1 + Overlap), {-1, 0}, Overlap - R.X0);
		Out = Clip(Clip(Out, {0, 1}, R.Y1 + Overlap), {0, -1}, Overlap - R.Y0);
		const std::array<double, 4> Reach = FindReach(R);
		double Size = GetArea(Out);
		for (int I = 0; I < 4; ++I)
		{
			const FPolygon Cut = Clip(Out, Diagonals[I], Reach[I] + 2.0 * Overlap);
			if (const double CutSize = GetArea(Cut); Size - CutSize > LeastCorner * Area)
			{
				Out = Cut;
				Size = CutSize;
			}
		}
		return Out;
	}
	double GetShare(const FRect& R) const { return R.IsEmpty() ? 0.0 : GetArea(GetPolygon(R, 0.0, Triangle)) / Area; }
	FSplit FindSplit(const FRect& R) const;
	void AddPieces(const FRect& R, FOpacityPieces& Out) const;

private:
	static uint64_t GetColumns(const FRect& R) { return (R.X1 >= 64 ? ~0ull : (1ull << R.X1) - 1) & ~((1ull << R.X0) - 1); }

	const int Cells;
	glm::dvec2 Origin, Step{0};
	FPolygon Triangle;
	double Area = 0.0;
	std::array<uint64_t, MaxOpacityCells> Rows{}; // a bit for each cell
};

FSplit FPieceGrid::FindSplit(const FRect& R) const
{
	FSplit Best;
	const double Share = GetShare(R);
	const auto Try = [&](FRect Low, FRect High) {
		Low = Tighten(Low);
		High = Tighten(High);
		const double Saving = Share - GetShare(Low) - GetShare(High);
		if (Saving > Best.Saving) { Best = {Low, High, Saving}; }
	};
	for (int X = R.X0 + 1; X < R.X1; ++X) { Try({R.X0, R.Y0, X, R.Y1}, {X, R.Y0, R.X1, R.Y1}); }
	for (int Y = R.Y0 + 1; Y < R.Y1; ++Y) { Try({R.X0, R.Y0, R.X1, Y}, {R.X0, Y, R.X1, R.Y1}); }
	return Best;
}

void FPieceGrid::AddPieces(const FRect& R, FOpacityPieces& Out) const
{
	const glm::dvec2 Center = (Triangle[0] + Triangle[1] + Triangle[2]) / 3.0;
	FPolygon Larger;
	for (size_t I = 0; I < 3; ++I)
	{
		const glm::dvec2 Corner = Triangle[I];
		Larger.Add(Corner + (Corner - Center) * (3.0 * TriangleOverlap));
	}
	const FPolygon Polygon = GetPolygon(R, CellOverlap, Larger);
	const glm::dvec2 E1 = Triangle[1] - Triangle[0], E2 = Triangle[2] - Triangle[0];
	const double Determinant = E1.x * E2.y - E1.y * E2.x;
	const auto ToBarycentrics = [&](glm::dvec2 P) {
		const glm::dvec2 D = P - Triangle[0];
		return glm::vec2((D.x * E2.y - D.y * E2.x) / Determinant, (E1.x * D.y - E1.y * D.x) / Determinant);
	};
	for (size_t I = 2; I < Polygon.Count; ++I)
	{
		for (const size_t Corner : {size_t(0), I - 1, I}) { Out.Corners.push_back(ToBarycentrics(Polygon[Corner])); }
	}
}

FOpacityPieces MakePieces(const FPieceGrid& Grid, const std::vector<FRect>& Rects)
{
	FOpacityPieces Out;
	Out.Share = 0.0f;
	for (const FRect& R : Rects)
	{
		Grid.AddPieces(R, Out);
		Out.Share += static_cast<float>(Grid.GetShare(R));
	}
	return Out;
}
} // namespace

std::vector<FOpacityPieces> MakeOpacityPieces(
    const FAlphaTest& Test, const FVertexAttributes& A, const FVertexAttributes& B, const FVertexAttributes& C, uint32_t Cells)
{
	assert(std::has_single_bit(Cells) && Cells <= MaxOpacityCells);
	std::vector<FOpacityPieces> Out;
	const FVertexAttributes* const Corners[3] = {&A, &B, &C};
	FTexelTriangle Triangle;
	if (!Test.Texture || !(Test.BaseAlpha >= 0.0f) || !MakeTexelTriangle(Test, Corners, Triangle)) { return Out; }
	FPieceGrid Grid(Triangle, Cells);
	if (!Grid.IsUsable()) { return Out; }
	Grid.Mark(Test, MakeAlphaLimits(Test, Corners), Triangle);
	std::vector<FRect> Rects = {Grid.Tighten({0, 0, static_cast<int>(Cells), static_cast<int>(Cells)})};
	if (Rects[0].IsEmpty()) { return Out; }
	std::vector<FSplit> Splits = {Grid.FindSplit(Rects[0])};
	float Share = 1.0f - static_cast<float>(LeastSaving);
	while (true)
	{
		FOpacityPieces Pieces = MakePieces(Grid, Rects);
		if (Pieces.Share < Share && !Pieces.Corners.empty())
		{
			Share = Pieces.Share - static_cast<float>(LeastSaving);
			Out.push_back(std::move(Pieces));
		}
		const auto Best =
		    std::max_element(Splits.begin(), Splits.end(), [](const FSplit& X, const FSplit& Y) { return X.Saving < Y.Saving; });
		if (Best->Saving < LeastSaving || Rects.size() >= MaxOpacityRects) { return Out; }
		const FSplit Split = *Best;
		const size_t At = static_cast<size_t>(Best - Splits.begin());
		Rects[At] = Split.Low;
		Splits[At] = Grid.FindSplit(Split.Low);
		Rects.push_back(Split.High);
		Splits.push_back(Grid.FindSplit(Split.High));
	}
}

} // namespace Lantern
