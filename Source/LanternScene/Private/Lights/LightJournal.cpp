// A ring of what lights reached.
#include "LanternScene/Lights/LightJournal.h"

#include <cassert>

namespace Lantern
{

void FLightJournal::Add(const FLightReach& Reach)
{
	if (Ring.size() < MostChanges) { Ring.push_back(Reach); }
	else { Ring[Count % MostChanges] = Reach; }
	++Count;
}

bool FLightJournal::GetSince(uint64_t First, std::vector<FLightReach>& Out) const
{
	assert(First <= Count);
	if (Count - First > Ring.size()) { return false; }
	for (uint64_t Change = First; Change < Count; ++Change) { Out.push_back(Ring[Change % MostChanges]); }
	return true;
}

} // namespace Lantern
