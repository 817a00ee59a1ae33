// FCasterChanges: a ring of the last changes.
#include "LanternScene/Scene/CasterChanges.h"

#include <cassert>
#include <cmath>

namespace Lantern
{

void FCasterChanges::Add(const FCasterChange& Change)
{
	if (!std::isfinite(Change.Radius + glm::dot(Change.From, Change.From) + glm::dot(Change.To, Change.To))) { return AddAnywhere(); }
	if (Last.empty()) { Last.resize(MostKept); }
	Last[Count++ % MostKept] = Change;
}

void FCasterChanges::AddAnywhere() { Anywhere = ++Count; }

bool FCasterChanges::Find(uint64_t Since, std::vector<FCasterChange>& Out) const
{
	assert(Since <= Count);
	Out.clear();
	if (Anywhere > Since || Count - Since > MostKept) { return false; }
	for (uint64_t I = Since; I < Count; ++I) { Out.push_back(Last[I % MostKept]); }
	return true;
}

} // namespace Lantern
