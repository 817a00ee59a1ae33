// FGeometrySlots: slots are taken and freed, entries found, changes listed.
#include "Geometry/GeometrySlots.h"

#include <utility>

#include "Geometry/GeometryReleases.h"

namespace Lantern
{

FGeometrySlots::FGeometrySlots(std::vector<uint64_t>& InAddresses) : Releases(std::make_shared<FGeometryReleases>()), Addresses(InAddresses)
{}

FGeometryEntry& FGeometrySlots::Add(const std::shared_ptr<FRTGeometry>& Geometry)
{
	uint32_t Slot = GetCount();
	if (FreeSlots.empty())
	{
		Entries.emplace_back();
		Addresses.push_back(0);
	}
	else
	{
		Slot = FreeSlots.back();
		FreeSlots.pop_back();
	}
	FGeometryEntry& Entry = Entries[Slot];
	const uint32_t Generation = Entry.Generation;
	const bool bChanged = Entry.bChanged;
	Entry = {};
	Entry.Generation = Generation;
	Entry.bChanged = bChanged;
	Entry.Age = NextAge++;
	Entry.Bind(Geometry, Slot, Releases);
	DynamicCount += Geometry->GetInfo().bDynamic ? 1 : 0;
	return Entry;
}

uint32_t FGeometrySlots::FreeReleased(uint32_t& OutCoarse)
{
	OutCoarse = 0;
	const std::vector<FGeometryReleases::FItem> Items = Releases->Take();
	for (const FGeometryReleases::FItem& Item : Items)
	{
		FGeometryEntry& Entry = Entries[Item.Slot];
		DynamicCount -= Item.bDynamic ? 1 : 0;
		OutCoarse += Entry.bCoarse ? 1 : 0;
		SetAddress(Entry, 0);
		++Entry.Generation;
		Entry.State = EGeometryState::Free;
		Entry.Geometry = nullptr;
		Entry.Owner.reset();
		Entry.Compacted = nullptr;
		Entry.Staging = nullptr;
		FreeSlots.push_back(Item.Slot);
	}
	return static_cast<uint32_t>(Items.size());
}

bool FGeometrySlots::HasReleased() const { return !Releases->IsEmpty(); }

FGeometryEntry* FGeometrySlots::Resolve(FGeometrySlotRef Ref)
{
	FGeometryEntry& Entry = Entries[Ref.Slot];
	return Entry.Generation == Ref.Generation && !Entry.Owner.expired() ? &Entry : nullptr;
}

const FGeometryEntry* FGeometrySlots::Resolve(FGeometrySlotRef Ref) const
{
	const FGeometryEntry& Entry = Entries[Ref.Slot];
	return Entry.Generation == Ref.Generation && !Entry.Owner.expired() ? &Entry : nullptr;
}

FGeometrySlotRef FGeometrySlots::MakeRef(const FGeometryEntry& Entry) const { return {GetSlot(Entry), Entry.Generation}; }

const FRTGeometry* FGeometrySlots::GetGeometry(uint32_t Slot) const
{
	return Slot < Entries.size() && !Entries[Slot].Owner.expired() ? Entries[Slot].Geometry : nullptr;
}

void FGeometrySlots::MarkChanged(FGeometryEntry& Entry)
{
	if (Entry.bChanged) { return; }
	Entry.bChanged = true;
	Changed.push_back(GetSlot(Entry));
}

void FGeometrySlots::SetAddress(FGeometryEntry& Entry, uint64_t Address)
{
	uint64_t& Now = Addresses[GetSlot(Entry)];
	if (Now == Address) { return; }
	Now = Address;
	MarkChanged(Entry);
}

std::vector<uint32_t> FGeometrySlots::TakeChanged()
{
	for (const uint32_t Slot : Changed) { Entries[Slot].bChanged = false; }
	return std::exchange(Changed, {});
}

} // namespace Lantern
