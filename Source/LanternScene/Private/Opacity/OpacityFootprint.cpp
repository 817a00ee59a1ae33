// The texels that a triangle can read: blocks of the alpha pyramid are walked until they decide.
#include "Opacity/OpacityFootprint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace Lantern
{

namespace
{
// Texels beside the footprint that a sampler may still read: implementations round coordinates to 1/256 of a texel.
constexpr double SamplerMargin = 1.0 / 32.0;
// Error of the shader's own fp32 arithmetic: three products and sums for the position, two for the transform.
constexpr double RelativeMargin = 1.0e-6;
// A triangle over more repetitions than this along an axis is taken to see all of the texture along it.
constexpr double MaxTiles = 8.0;
// A triangle that is not decided after this many blocks stays mixed.
constexpr uint32_t MaxVisits = 16384;

/// One axis of texel space, in which the triangle lies unwrapped.
struct FAxis
{
	double Size = 0.0;           // texels
	double Reach = 0.0;          // beyond its own box in which a texel is read
	double Min = 0.0, Max = 0.0; // of all points from which something is read
	ERTAddress Address = ERTAddress::Repeat;
	bool bAll = false; // the triangle sees the whole axis
	int64_t FirstTile = 0, LastTile = 0;
};

FAxis MakeAxis(double A, double B, double C, uint32_t Size, double Magnitude, ERTAddress Address, bool bLinear)
{
	FAxis Axis;
	Axis.Size = Size;
	Axis.Address = Address;
	Axis.Reach = (bLinear ? 0.5 : 0.0) + SamplerMargin + Magnitude * Axis.Size * RelativeMargin;
	Axis.Min = std::min({A, B, C}) - Axis.Reach;
	Axis.Max = std::max({A, B, C}) + Axis.Reach;
	if (Address == ERTAddress::Clamp)
	{
		Axis.bAll = Axis.Reach > Axis.Size;
		return Axis;
	}
	const double First = std::floor(Axis.Min / Axis.Size), Last = std::floor(Axis.Max / Axis.Size);
	Axis.bAll = !(Last - First < MaxTiles) || Axis.Reach > Axis.Size;
	if (!Axis.bAll)
	{
		Axis.FirstTile = static_cast<int64_t>(First);
		Axis.LastTile = static_cast<int64_t>(Last);
	}
	return Axis;
}

struct FInterval
{
	double Low, High;
};

/// Finds where the texels [Low, High) lie in a repetition of the texture.
FInterval Place(const FAxis& Axis, int64_t Tile, double Low, double High)
{
	if (Axis.bAll) { return {Axis.Min, Axis.Max}; }
	if (Axis.Address == ERTAddress::Clamp)
	{
		// A border texel goes on without end.
		return {Low <= 0.0 ? std::min(Axis.Min, 0.0) : Low, High >= Axis.Size ? std::max(Axis.Max, Axis.Size) : High};
	}
	const double Origin = static_cast<double>(Tile) * Axis.Size;
	if (Axis.Address == ERTAddress::Mirror && (Tile & 1) != 0) { return {Origin + Axis.Size - High, Origin + Axis.Size - Low}; }
	return {Origin + Low, Origin + High};
}

/// A triangle against boxes: separating axes (Gottschalk, Lin and Manocha 1996), in two dimensions.
class FTriangleTest
{
public:
	FTriangleTest(const std::array<glm::dvec2, 3>& P)
	{
		Low = glm::min(P[0], glm::min(P[1], P[2]));
		High = glm::max(P[0], glm::max(P[1], P[2]));
		for (int I = 0; I < 3; ++I)
		{
			const glm::dvec2 Edge = P[(I + 1) % 3] - P[I];
			Normals[I] = {-Edge.y, Edge.x};
			const double D[3] = {glm::dot(Normals[I], P[0]), glm::dot(Normals[I], P[1]), glm::dot(Normals[I], P[2])};
			// The edge's own corners give the same value, but for rounding.
			Slack[I] = 1e-12 * (std::abs(D[0]) + std::abs(D[1]) + std::abs(D[2]));
			From[I] = std::min({D[0], D[1], D[2]}) - Slack[I];
			To[I] = std::max({D[0], D[1], D[2]}) + Slack[I];
		}
	}
	bool MayOverlap(glm::dvec2 Min, glm::dvec2 Max) const
	{
		if (Min.x > High.x || Max.x < Low.x || Min.y > High.y || Max.y < Low.y) { return false; }
		const glm::dvec2 Center = 0.5 * (Min + Max), Half = 0.5 * (Max - Min);
		for (int I = 0; I < 3; ++I)
		{
			const double At = glm::dot(Normals[I], Center);
			const double Radius = Half.x * std::abs(Normals[I].x) + Half.y * std::abs(Normals[I].y) + Slack[I];
			if (At + Radius < From[I] || At - Radius > To[I]) { return false; }
		}
		return true;
	}

	bool Contains(glm::dvec2 Min, glm::dvec2 Max) const
	{
		if (Min.x < Low.x || Max.x > High.x || Min.y < Low.y || Max.y > High.y) { return false; }
		const glm::dvec2 Center = 0.5 * (Min + Max), Half = 0.5 * (Max - Min);
		for (int I = 0; I < 3; ++I)
		{
			const double At = glm::dot(Normals[I], Center);
			const double Radius = Half.x * std::abs(Normals[I].x) + Half.y * std::abs(Normals[I].y);
			if (At - Radius < From[I] || At + Radius > To[I]) { return false; }
		}
		return true;
	}

private:
	glm::dvec2 Low, High, Normals[3];
	double From[3], To[3], Slack[3];
};

struct FBoxTest
{
	glm::dvec2 Low, High;
	bool MayOverlap(glm::dvec2 Min, glm::dvec2 Max) const { return Min.x <= High.x && Max.x >= Low.x && Min.y <= High.y && Max.y >= Low.y; }
	bool Contains(glm::dvec2 Min, glm::dvec2 Max) const { return Min.x >= Low.x && Max.x <= High.x && Min.y >= Low.y && Max.y <= High.y; }
};

/// Walks the pyramid's blocks that the shape may read in one repetition of the texture.
template <class TShape>
class TFootprintWalk
{
public:
	TFootprintWalk(const FAlphaPyramid& InPyramid, const FAlphaLimits& InLimits, const FAxis& InU, const FAxis& InV, const TShape& InShape,
	    bool bPassOnly)
	    : Pyramid(InPyramid),
	      Limits(InLimits),
	      U(InU),
	      V(InV),
	      Shape(InShape),
	      bSeesFail(bPassOnly)
	{}
	bool IsMixed() const { return bSeesPass && bSeesFail; }
	EOpacity GetResult() const
	{
		if (bSeesPass == bSeesFail) { return EOpacity::Mixed; }
		return bSeesPass ? EOpacity::Opaque : EOpacity::Transparent;
	}
	void VisitTile(int64_t TileU, int64_t TileV)
	{
		Visit({Pyramid.GetLevelCount() - 1, 0, 0}, TileU, TileV);
		while (!Stack.empty() && !IsMixed())
		{
			const FBlock Block = Stack.back();
			Stack.pop_back();
			for (uint32_t Child = 0; Child < 4 && !IsMixed(); ++Child)
			{
				const uint32_t X = 2 * Block.X + (Child & 1), Y = 2 * Block.Y + (Child >> 1);
				const uint32_t Level = Block.Level - 1;
				if (uint64_t(X) << Level < Pyramid.GetTexels().Width && uint64_t(Y) << Level < Pyramid.GetTexels().Height)
				{
					Visit({Level, X, Y}, TileU, TileV);
				}
			}
		}
		Stack.clear();
	}

private:
	struct FBlock
	{
		uint32_t Level, X, Y;
	};
	void Visit(const FBlock& Block, int64_t TileU, int64_t TileV)
	{
		const FAlphaRange Range = Pyramid.GetRange(Block.Level, Block.X, Block.Y);
		const bool bPass = Range.Min >= Limits.PassFrom, bFail = Range.Max <= Limits.FailUpTo;
		if ((bPass && bSeesPass) || (bFail && bSeesFail)) { return; }
		const double Size = static_cast<double>(uint64_t(1) << Block.Level);
		const FInterval X = Place(U, TileU, Block.X * Size, std::min((Block.X + 1) * Size, U.Size));
		const FInterval Y = Place(V, TileV, Block.Y * Size, std::min((Block.Y + 1) * Size, V.Size));
		if (!Shape.MayOverlap({X.Low - U.Reach, Y.Low - V.Reach}, {X.High + U.Reach, Y.High + V.Reach})) { return; }
		if (bPass || bFail)
		{
			bSeesPass |= bPass;
			bSeesFail |= bFail;
		}
		// All texels of the block are read. One of them does not pass, and one does not fail.
		else if (Block.Level == 0 || ++Visits > MaxVisits || Shape.Contains({X.Low, Y.Low}, {X.High, Y.High}))
		{
			bSeesPass = bSeesFail = true;
		}
		else { Stack.push_back(Block); }
	}

	const FAlphaPyramid& Pyramid;
	const FAlphaLimits Limits;
	const FAxis& U;
	const FAxis& V;
	const TShape& Shape;
	std::vector<FBlock> Stack;
	uint32_t Visits = 0;
	bool bSeesPass = false;
	bool bSeesFail; // from the start, where it does not matter
};

template <class TShape>
EOpacity Walk(const FAlphaTest& Test, const FAlphaLimits& Limits, const FAxis& U, const FAxis& V, const TShape& Shape, bool bPassOnly)
{
	TFootprintWalk<TShape> Footprint(*Test.Texture, Limits, U, V, Shape, bPassOnly);
	for (int64_t TileV = V.FirstTile; TileV <= V.LastTile && !Footprint.IsMixed(); ++TileV)
	{
		for (int64_t TileU = U.FirstTile; TileU <= U.LastTile && !Footprint.IsMixed(); ++TileU) { Footprint.VisitTile(TileU, TileV); }
	}
	return Footprint.GetResult();
}

class FCellMarker
{
public:
	FCellMarker(const FAlphaTest& InTest, const FAlphaLimits& InLimits, const FTexelTriangle& T, glm::dvec2 InOrigin, glm::dvec2 InStep,
	    std::array<uint64_t, MaxOpacityCells>& OutRows)
	    : Test(InTest),
	      Limits(InLimits),
	      Magnitude(T.Magnitude),
	      Triangle({T.P[0], T.P[1], T.P[2]}),
	      Origin(InOrigin),
	      Step(InStep),
	      Rows(OutRows)
	{}
	void Mark(uint32_t X, uint32_t Y, uint32_t Size)
	{
		const glm::dvec2 Low = Origin + glm::dvec2(X, Y) * Step, High = Low + double(Size) * Step;
		if (!Triangle.MayOverlap(Low, High) || IsTransparent(Low, High)) { return; }
		if (Size == 1)
		{
			Rows[Y] |= 1ull << X;
			return;
		}
		const uint32_t Half = Size / 2;
		Mark(X, Y, Half);
		Mark(X + Half, Y, Half);
		Mark(X, Y + Half, Half);
		Mark(X + Half, Y + Half, Half);
	}

private:
	bool IsTransparent(glm::dvec2 Low, glm::dvec2 High) const
	{
		const FAlphaTexels& Texels = Test.Texture->GetTexels();
		const FAxis U = MakeAxis(Low.x, High.x, High.x, Texels.Width, Magnitude.x, Test.AddressU, Test.bLinear);
		const FAxis V = MakeAxis(Low.y, High.y, High.y, Texels.Height, Magnitude.y, Test.AddressV, Test.bLinear);
		return Walk(Test, Limits, U, V, FBoxTest{Low, High}, true) == EOpacity::Transparent;
	}

	const FAlphaTest& Test;
	const FAlphaLimits Limits;
	const glm::dvec2 Magnitude;
	const FTriangleTest Triangle;
	const glm::dvec2 Origin, Step;
	std::array<uint64_t, MaxOpacityCells>& Rows;
};
} // namespace

EOpacity ClassifyFootprint(const FAlphaTest& Test, const FAlphaLimits& Limits, const FTexelTriangle& T)
{
	const FAlphaTexels& Texels = Test.Texture->GetTexels();
	const FAxis U = MakeAxis(T.P[0].x, T.P[1].x, T.P[2].x, Texels.Width, T.Magnitude.x, Test.AddressU, Test.bLinear);
	const FAxis V = MakeAxis(T.P[0].y, T.P[1].y, T.P[2].y, Texels.Height, T.Magnitude.y, Test.AddressV, Test.bLinear);
	return Walk(Test, Limits, U, V, FTriangleTest({T.P[0], T.P[1], T.P[2]}), false);
}

void MarkCells(const FAlphaTest& Test, const FAlphaLimits& Limits, const FTexelTriangle& Triangle, glm::dvec2 Origin, glm::dvec2 Step,
    uint32_t Cells, std::array<uint64_t, MaxOpacityCells>& Rows)
{
	FCellMarker(Test, Limits, Triangle, Origin, Step, Rows).Mark(0, 0, Cells);
}

} // namespace Lantern
