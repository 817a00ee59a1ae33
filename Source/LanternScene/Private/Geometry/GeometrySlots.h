// The slots of FGeometryStore: which geometry has which, where its structure lies, which ones changed.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "Geometry/GeometryEntry.h"

namespace Lantern
{

class FGeometryReleases;

/// Threads: render thread. Only a geometry's last owner may let go on any thread: the geometry then stays until FreeReleased.
class FGeometrySlots
{
public:
	/// Addresses gets one element for each slot, 0 if the slot has no structure to trace. It must outlive this.
	explicit FGeometrySlots(std::vector<uint64_t>& Addresses);
	~FGeometrySlots();
	FGeometrySlots(const FGeometrySlots&) = delete;
	FGeometrySlots& operator=(const FGeometrySlots&) = delete;

	/// Makes a geometry in a slot, a free one first. Slots and references to entries stay.
	FRTGeometryRef Create(FRTGeometryInfo Info);
	/// Frees the slots of geometries whose last owner has let go since the last call. Returns how many there were.
	/// OutCoarse: how many of them were coarser levels. Freed: is called with each slot.
	uint32_t FreeReleased(uint32_t& OutCoarse, const std::function<void(uint32_t)>& Freed = {});
	bool HasReleased() const;

	FGeometryEntry& operator[](uint32_t Slot) { return Entries[Slot]; }
	const FGeometryEntry& operator[](uint32_t Slot) const { return Entries[Slot]; }
	/// Null: the geometry is gone.
	FGeometryEntry* Resolve(FGeometrySlotRef Ref);
	const FGeometryEntry* Resolve(FGeometrySlotRef Ref) const;
	FGeometrySlotRef MakeRef(const FGeometryEntry& Entry) const;
	static uint32_t GetSlot(const FGeometryEntry& Entry) { return Entry.Slot; }
	uint32_t GetCount() const { return static_cast<uint32_t>(Entries.size()); }
	/// Null: the slot is free.
	const FRTGeometry* GetGeometry(uint32_t Slot) const;
	/// Number of dynamic geometries.
	uint32_t GetDynamicCount() const { return DynamicCount; }

	/// Number of geometries that wait for their data.
	uint32_t GetFillingCount() const { return FillingCount; }
	/// The entry's geometry has its data. Marks the slot as changed.
	void NoteFilled(FGeometryEntry& Entry);

	/// A different address marks the slot as changed.
	void SetAddress(FGeometryEntry& Entry, uint64_t Address);
	void MarkChanged(FGeometryEntry& Entry);
	/// Slots that changed since the last call, each once, in the order of their first change.
	std::vector<uint32_t> TakeChanged();

	/// Keeps the geometry alive until DropHeld: commands that name it are being recorded.
	void Hold(const FGeometryEntry& Entry) { Held.push_back(Entry.Owner.lock()); }
	void DropHeld() { Held.clear(); }

private:
	/// A geometry without owners whose coarser level is still in the making.
	struct FDying
	{
		std::unique_ptr<FRTGeometry> Geometry;
		FCoarserLevel* Level = nullptr;
	};
	void Bury(std::unique_ptr<FRTGeometry> Geometry, FCoarserLevel* Level);

	std::shared_ptr<FGeometryReleases> Releases;
	std::vector<FDying> Dying;
	std::deque<FGeometryEntry> Entries; // grows without moving what is there
	std::vector<uint64_t>& Addresses;
	std::vector<uint32_t> FreeSlots, Changed;
	std::vector<FRTGeometryRef> Held;
	uint64_t NextAge = 0;
	uint32_t DynamicCount = 0, FillingCount = 0;
};

} // namespace Lantern
