// What changed of lights: by place, for whoever keeps lists of them, and by strength, for whoever keeps their light.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "LightCellTypes.h"

namespace Lantern
{

/// Remembers the newest MostChanges changes. Any number of consumers read it, each from its own place on.
/// Threads: one at a time.
template <typename T>
class TLightJournal
{
public:
	static constexpr uint32_t MostChanges = 4096;

	/// O(1).
	void Add(const T& Change)
	{
		if (Ring.size() < MostChanges) { Ring.push_back(Change); }
		else { Ring[Count % MostChanges] = Change; }
		++Count;
	}
	/// Returns the number of changes so far, forgotten ones included: a consumer's next place.
	uint64_t GetCount() const { return Count; }
	/// Appends the changes from place First on to Out, oldest first. Returns false, with Out as it was, if some are forgotten.
	bool GetSince(uint64_t First, std::vector<T>& Out) const
	{
		assert(First <= Count);
		if (Count - First > Ring.size()) { return false; }
		for (uint64_t Change = First; Change < Count; ++Change) { Out.push_back(Ring[Change % MostChanges]); }
		return true;
	}

private:
	std::vector<T> Ring; // change N is at N modulo MostChanges
	uint64_t Count = 0;
};

/// What lights reached before a change, and reach from then on.
using FLightJournal = TLightJournal<FLightReach>;

/// By how much a light brings more or less than before.
struct FLightChange
{
	uint32_t Slot = 0;      ///< of the light, FLightId::Index
	glm::dvec3 Position{0}; ///< metres
	double Range = 0.0;     ///< metres; 0: no end
	bool bDirectional = false;
	double Strength = 0.0; ///< luminance of what came or went of its intensity, candela; directional: lux
	double Moved = 0.0;    ///< way times intensity, candela metres
	double Part = 0.0;     ///< Strength over the greater intensity, 0 to 1
};
using FLightChanges = TLightJournal<FLightChange>;

} // namespace Lantern
