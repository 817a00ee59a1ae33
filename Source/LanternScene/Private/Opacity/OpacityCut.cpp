// CutOpacityPieces: which triangles are cut into how many pieces. Thousands of foliage cards share texture coordinates, so
// ways to cut are found once for each distinct footprint. One price for a piece, in area, holds for all triangles.
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "LanternCore/Tasks/Tasks.h"
#include "LanternScene/Opacity/OpacityPieces.h"
#include "Opacity/OpacityFootprintKey.h"

namespace Lantern
{

namespace
{
// Ways of one footprint take a third of a millisecond. The footprints that are worth least stay whole.
constexpr size_t MaxFootprints = 512;
// The footprints that are worth most get a finer grid, which takes four times as long.
constexpr size_t FineFootprints = 64;
constexpr double WorthwhileShare = 0.98; // of the area of all triangles
constexpr int PriceSteps = 40;

struct FFootprint
{
	size_t Source = 0, Triangle = 0; // the first that has it
	double Area = 0.0;
	std::vector<FOpacityPieces> Ways;
};

struct FTriangleRef
{
	uint32_t Footprint = 0;
	float Area = 0.0f;
	const FOpacityPieces* Way = nullptr; // null: whole
};

/// Returns the way that saves most area at the price, in area, of a piece; null if none is worth it.
const FOpacityPieces* Choose(const FFootprint& Footprint, double Area, double Price)
{
	const FOpacityPieces* Best = nullptr;
	double BestValue = 0.0;
	for (const FOpacityPieces& Way : Footprint.Ways)
	{
		const double Value = Area * (1.0 - Way.Share) - Price * (double(Way.GetCount()) - 1.0);
		if (Value > BestValue)
		{
			BestValue = Value;
			Best = &Way;
		}
	}
	return Best;
}

class FCutter
{
public:
	explicit FCutter(std::span<const FPieceSource> InSources) : Sources(InSources), Triangles(InSources.size()) {}

	void FindFootprints()
	{
		std::unordered_map<FFootprintKey, uint32_t, FFootprintHash> Known;
		for (size_t Source = 0; Source < Sources.size(); ++Source)
		{
			const FPieceSource& S = Sources[Source];
			for (size_t T = 0; T < S.Indices.size() / 3; ++T)
			{
				const uint32_t* const Corners = &S.Indices[3 * T];
				const auto [It, bNew] =
				    Known.try_emplace(MakeFootprintKey(*S.Test, S.Vertices, Corners), static_cast<uint32_t>(Footprints.size()));
				if (bNew) { Footprints.push_back({Source, T, 0.0, {}}); }
				const glm::vec3 E1 = S.Positions[Corners[1]] - S.Positions[Corners[0]];
				const glm::vec3 E2 = S.Positions[Corners[2]] - S.Positions[Corners[0]];
				const float Area = 0.5f * glm::length(glm::cross(E1, E2)) * S.Weight;
				Triangles[Source].push_back({It->second, std::isfinite(Area) ? Area : 0.0f, nullptr});
				Footprints[It->second].Area += Triangles[Source].back().Area;
			}
		}
	}

	void FindWays()
	{
		std::vector<uint32_t> Order(Footprints.size());
		double Total = 0.0;
		for (uint32_t I = 0; I < Order.size(); ++I)
		{
			Order[I] = I;
			Total += Footprints[I].Area;
		}
		std::stable_sort(Order.begin(), Order.end(), [&](uint32_t A, uint32_t B) { return Footprints[A].Area > Footprints[B].Area; });
		size_t Count = 0;
		for (double Sum = 0.0; Count < std::min(Order.size(), MaxFootprints) && Sum < WorthwhileShare * Total; ++Count)
		{
			Sum += Footprints[Order[Count]].Area;
		}
		ParallelFor(Count, 8, [&](size_t Begin, size_t End) {
			for (size_t I = Begin; I < End; ++I)
			{
				FFootprint& Footprint = Footprints[Order[I]];
				const FPieceSource& S = Sources[Footprint.Source];
				const uint32_t* const C = &S.Indices[3 * Footprint.Triangle];
				Footprint.Ways = MakeOpacityPieces(*S.Test, S.Vertices[C[0]], S.Vertices[C[1]], S.Vertices[C[2]],
				    I < FineFootprints ? MaxOpacityCells : MaxOpacityCells / 2);
			}
		});
	}

	uint64_t CountExtra(double Price) const
	{
		uint64_t Extra = 0;
		for (const std::vector<FTriangleRef>& OfSource : Triangles)
		{
			for (const FTriangleRef& T : OfSource)
			{
				const FOpacityPieces* const Way = Choose(Footprints[T.Footprint], T.Area, Price);
				Extra += Way ? Way->GetCount() - 1 : 0;
			}
		}
		return Extra;
	}

	/// Chooses a way for each triangle.
	void ChooseWays(uint64_t MostExtra)
	{
		const auto [Low, High] = FindPrice(MostExtra);
		uint64_t Left = MostExtra - CountExtra(High);
		for (std::vector<FTriangleRef>& OfSource : Triangles)
		{
			for (FTriangleRef& T : OfSource)
			{
				T.Way = Choose(Footprints[T.Footprint], T.Area, High);
				// Many triangles are alike, and change their way at one price. Some of them still can.
				const FOpacityPieces* const Finer = Choose(Footprints[T.Footprint], T.Area, Low);
				const size_t More = (Finer ? Finer->GetCount() : 1) - (T.Way ? T.Way->GetCount() : 1);
				if (More <= Left)
				{
					T.Way = Finer;
					Left -= More;
				}
			}
		}
	}

	FOpacityPieceList MakePieces(size_t Source) const
	{
		static const std::vector<glm::vec2> Whole = {{0, 0}, {1, 0}, {0, 1}};
		const FPieceSource& S = Sources[Source];
		FOpacityPieceList Out;
		bool bCut = false;
		for (size_t T = 0; T < Triangles[Source].size(); ++T)
		{
			const FOpacityPieces* const Way = Triangles[Source][T].Way;
			bCut |= Way != nullptr;
			const uint32_t* const C = &S.Indices[3 * T];
			const glm::dvec3 P0(S.Positions[C[0]]), P1(S.Positions[C[1]]), P2(S.Positions[C[2]]);
			const std::vector<glm::vec2>& Corners = Way ? Way->Corners : Whole;
			for (const glm::vec2 At : Corners)
			{
				Out.Positions.push_back(glm::vec3(P0 + double(At.x) * (P1 - P0) + double(At.y) * (P2 - P0)));
			}
			for (size_t Piece = 0; Piece < Corners.size() / 3; ++Piece) { Out.Indices.insert(Out.Indices.end(), {C[0], C[1], C[2]}); }
		}
		return bCut ? Out : FOpacityPieceList{};
	}

private:
	/// Returns two prices of a piece, in area: one just too low for MostExtra, and one that is high enough.
	std::pair<double, double> FindPrice(uint64_t MostExtra) const
	{
		double High = 0.0;
		for (const std::vector<FTriangleRef>& OfSource : Triangles)
		{
			for (const FTriangleRef& T : OfSource) { High = std::max(High, double(T.Area)); }
		}
		if (CountExtra(0.0) <= MostExtra) { return {0.0, 0.0}; }
		// Areas span many orders of magnitude, so the search halves the exponent.
		double Low = High * 1e-9;
		for (int Step = 0; Step < PriceSteps && High > Low * 1.01; ++Step)
		{
			const double Middle = std::sqrt(Low * High);
			(CountExtra(Middle) <= MostExtra ? High : Low) = Middle;
		}
		return {Low, High};
	}

	std::span<const FPieceSource> Sources;
	std::vector<std::vector<FTriangleRef>> Triangles; // by source
	std::vector<FFootprint> Footprints;
};
} // namespace

std::vector<FOpacityPieceList> CutOpacityPieces(std::span<const FPieceSource> Sources, uint64_t MostExtra)
{
	std::vector<FOpacityPieceList> Out(Sources.size());
	if (MostExtra == 0) { return Out; }
	FCutter Cutter(Sources);
	Cutter.FindFootprints();
	Cutter.FindWays();
	Cutter.ChooseWays(MostExtra);
	ParallelFor(Sources.size(), 1, [&](size_t Begin, size_t End) {
		for (size_t Source = Begin; Source < End; ++Source) { Out[Source] = Cutter.MakePieces(Source); }
	});
	return Out;
}

} // namespace Lantern
