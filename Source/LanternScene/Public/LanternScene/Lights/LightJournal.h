// What lights reached and reach that changed, for whoever keeps lists of lights by place.
#pragma once

#include <cstdint>
#include <vector>

#include "LightCellTypes.h"

namespace Lantern
{

/// Remembers the newest MostChanges changes. Any number of consumers read it, each from its own place on.
/// Threads: one at a time.
class FLightJournal
{
public:
	static constexpr uint32_t MostChanges = 4096;

	/// Adds what a light reached, or reaches from now on. O(1).
	void Add(const FLightReach& Reach);
	/// Returns the number of changes so far, forgotten ones included: a consumer's next place.
	uint64_t GetCount() const { return Count; }
	/// Appends the changes from place First on to Out, oldest first. Returns false, with Out as it was, if some are forgotten.
	bool GetSince(uint64_t First, std::vector<FLightReach>& Out) const;

private:
	std::vector<FLightReach> Ring; // change N is at N modulo MostChanges
	uint64_t Count = 0;
};

} // namespace Lantern
