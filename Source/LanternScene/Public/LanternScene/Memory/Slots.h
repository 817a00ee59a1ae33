// TSlots: values in slots that never move, each with a generation, so that a stale name of a reused slot is noticed.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

namespace Lantern
{

/// Slots are taken from the lowest free one on, so that the end of the table falls free. Taking and freeing costs O(log n).
/// Threads: one at a time.
template <class T>
class TSlots
{
public:
	static constexpr uint32_t None = ~0u;

	/// Returns a slot with a value T{}; None if Most slots are taken.
	uint32_t Take(uint32_t Most)
	{
		uint32_t Slot = Num();
		if (!FreeSlots.empty() && FreeSlots.front() < Slot)
		{
			std::pop_heap(FreeSlots.begin(), FreeSlots.end(), std::greater());
			Slot = FreeSlots.back();
			FreeSlots.pop_back();
		}
		else
		{
			FreeSlots.clear(); // all of them are behind the end
			if (Slot >= Most) { return None; }
			Entries.emplace_back().Generation = GenerationFloor;
		}
		Entries[Slot].bAlive = true;
		++Alive;
		return Slot;
	}
	/// Free slots at the end go: Num may be smaller afterwards.
	void Free(uint32_t Slot)
	{
		assert(IsAlive(Slot));
		Entries[Slot] = {T{}, Entries[Slot].Generation + 1, false};
		--Alive;
		FreeSlots.push_back(Slot);
		std::push_heap(FreeSlots.begin(), FreeSlots.end(), std::greater());
		while (!Entries.empty() && !Entries.back().bAlive)
		{
			GenerationFloor = std::max(GenerationFloor, Entries.back().Generation);
			Entries.pop_back();
		}
	}
	uint32_t Num() const { return static_cast<uint32_t>(Entries.size()); } ///< all slots, free ones included
	uint32_t GetAliveCount() const { return Alive; }
	bool IsAlive(uint32_t Slot) const { return Slot < Num() && Entries[Slot].bAlive; }
	bool IsCurrent(uint32_t Slot, uint32_t Generation) const { return IsAlive(Slot) && Entries[Slot].Generation == Generation; }
	uint32_t GetGeneration(uint32_t Slot) const { return Entries[Slot].Generation; }
	T& operator[](uint32_t Slot) { return Entries[Slot].Value; }
	const T& operator[](uint32_t Slot) const { return Entries[Slot].Value; }

private:
	struct FEntry
	{
		T Value;
		uint32_t Generation = 0;
		bool bAlive = false;
	};
	std::deque<FEntry> Entries;      // which grows without moving what is there: 16,384 objects moved take milliseconds
	std::vector<uint32_t> FreeSlots; // a heap, the lowest first
	uint32_t GenerationFloor = 0;    // of slots that the table never had, or has lost
	uint32_t Alive = 0;
};

} // namespace Lantern
