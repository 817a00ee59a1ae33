// The builds that wait: by size on the screen and age, so many triangles in a frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "Geometry/BuildPriorities.h"
#include "Geometry/GeometrySlots.h"
#include "LanternScene/Geometry/GeometryStore.h"

namespace Lantern
{

/// Threads: render thread, except RaisePriority.
class FGeometryBuildQueue
{
public:
	/// Slots and Stats must outlive this. Reads Built and TrianglesBuilt of Stats: what the frame has already spent.
	FGeometryBuildQueue(FGeometrySlots& Slots, const FGeometryStoreStats& Stats);

	/// Must come before the first RaisePriority of a slot that a new geometry has taken.
	void ResetPriority(uint32_t Slot) { Priorities.Reset(Slot); }
	/// See FGeometryStore::RaisePriority.
	void RaisePriority(uint32_t Slot, float ScreenSize) { Priorities.Raise(Slot, ScreenSize); }

	/// Queues the entry, which becomes Pending.
	void Add(FGeometryEntry& Entry);
	void Remove(uint32_t Slot);
	bool IsEmpty() const { return Pending.empty(); }
	uint32_t GetCount() const { return static_cast<uint32_t>(Pending.size()); }

	struct FRound
	{
		uint64_t Frame = 0;          ///< geometries that were queued in earlier frames gain on newer ones
		bool bAll = false;           ///< no limit of triangles
		bool bSmallestFirst = false; ///< by bytes of the structure instead of size on the screen
	};
	/// Starts the build of Entry or finds that it must wait; in the second case Entry stays Pending. Left: entries that
	/// the round has not yet tried, Entry included. bOutStop: the round ends here.
	using FStart = std::function<FRTStatus(FGeometryEntry& Entry, size_t Left, bool& bOutStop)>;
	/// Calls Start for waiting entries in order until r.RT.Build.TrianglesPerFrame is spent. The first build of a frame
	/// may exceed that limit, and entries of a lost frame ignore it. Start may add entries: they wait for the next round.
	/// Returns the first error of Start; entries that have not been started stay.
	FRTStatus Run(const FRound& Round, const FStart& Start);

private:
	void Order(const FRound& Round);

	FGeometrySlots& Slots;
	const FGeometryStoreStats& Stats;
	FBuildPriorities Priorities;
	std::vector<FGeometrySlotRef> Pending;
};

} // namespace Lantern
