// FObjectPivots: the largest reach is kept up to date, and searched anew only if it may have lessened.
#include "LanternScene/Scene/ObjectPivots.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace Lantern
{

namespace
{
double MaxNorm(const glm::dvec3& V) { return std::max(std::abs(V.x), std::max(std::abs(V.y), std::abs(V.z))); }
} // namespace

double FObjectPivots::Measure(const FPivot& Pivot) const
{
	const double Nearest = MaxNorm(Pivot.Center - Origin) - Pivot.Radius;
	if (Nearest >= Pivot.Farthest) { return 0.0; } // most of a large world
	const double Here = std::min(MaxNorm(Pivot.Pivot - Origin), Pivot.Farthest);
	return Nearest < Here ? Here : 0.0;
}

void FObjectPivots::Set(uint32_t Object, const glm::dvec3& Pivot, const glm::dvec3& Center, double Radius)
{
	const double Farthest = MaxNorm(Center - Pivot) + Radius;
	if (Radius < 0.0 || !(Farthest > LeastReach) || !std::isfinite(Farthest)) { return Remove(Object); }
	if (Object >= Places.size()) { Places.resize(Object + 1, NoPlace); }
	const bool bNew = Places[Object] == NoPlace;
	if (bNew)
	{
		Places[Object] = static_cast<uint32_t>(Pivots.size());
		Pivots.emplace_back();
	}
	FPivot& Entry = Pivots[Places[Object]];
	const double Before = bNew ? 0.0 : Measure(Entry);
	Entry = {Pivot, Center, Radius, Farthest, Object};
	const double Now = Measure(Entry);
	bStale |= Before >= Reach && Now < Before;
	Reach = std::max(Reach, Now);
}

void FObjectPivots::Remove(uint32_t Object)
{
	const uint32_t Place = Object < Places.size() ? std::exchange(Places[Object], NoPlace) : NoPlace;
	if (Place == NoPlace) { return; }
	bStale |= Measure(Pivots[Place]) >= Reach;
	if (Place + 1 < Pivots.size())
	{
		Pivots[Place] = Pivots.back();
		Places[Pivots[Place].Object] = Place;
	}
	Pivots.pop_back();
}

void FObjectPivots::Update(const glm::dvec3& InOrigin)
{
	if (!std::exchange(bStale, false) && InOrigin == Origin) { return; }
	Origin = InOrigin;
	Reach = LeastReach;
	for (const FPivot& Pivot : Pivots) { Reach = std::max(Reach, Measure(Pivot)); }
}

} // namespace Lantern
