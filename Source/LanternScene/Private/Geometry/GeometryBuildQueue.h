// The builds that wait: by size on the screen and age, so many triangles in a frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <set>
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
	bool IsEmpty() const { return GetCount() == 0; }
	uint32_t GetCount() const { return static_cast<uint32_t>(Order.size() + Added.size()); }
	/// Number of entries that the last round placed anew or looked at, for tests: costs follow what changed and what is built.
	uint32_t GetVisited() const { return Visited; }

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
	/// Place of an entry in the order. Entries gain equally while they wait, so that the time of queueing tells them apart.
	struct FKey
	{
		double Score = 0.0; ///< the highest first
		uint64_t Age = 0;
		FGeometrySlotRef Ref;
		bool operator<(const FKey& Other) const { return Score != Other.Score ? Score > Other.Score : Age < Other.Age; }
	};
	struct FPlace
	{
		FKey Key;
		bool bQueued = false;
		float KeyedSize = 0.0f; ///< on the screen
	};
	FPlace& GetPlace(uint32_t Slot);
	FKey MakeKey(const FGeometryEntry& Entry, bool bSmallestFirst) const;
	void Insert(FGeometryEntry& Entry, bool bSmallestFirst);
	void Erase(FPlace& Place);
	void TakeRaised();
	void InsertAdded();
	void OrderAll(bool bSmallestFirst);
	FRTStatus RunInOrder(const FRound& Round, const FStart& Start);

	FGeometrySlots& Slots;
	const FGeometryStoreStats& Stats;
	FBuildPriorities Priorities;
	std::set<FKey> Order;
	std::deque<FPlace> Places;           ///< by slot; grows without moving what is there
	std::vector<FGeometrySlotRef> Added; ///< during a round
	bool bRunning = false;
	uint32_t Visited = 0;
};

} // namespace Lantern
