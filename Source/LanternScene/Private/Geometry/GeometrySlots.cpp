// FGeometrySlots: slots are taken and freed, entries found, changes listed.
#include "Geometry/GeometrySlots.h"

#include <algorithm>
#include <utility>

#include "Geometry/CoarserLevel.h"
#include "Geometry/GeometryReleases.h"

namespace Lantern
{

FGeometrySlots::FGeometrySlots(std::vector<uint64_t>& InAddresses) : Releases(std::make_shared<FGeometryReleases>()), Addresses(InAddresses)
{}

FGeometrySlots::~FGeometrySlots() { Releases->Close(); }

FRTGeometryRef FGeometrySlots::Create(FRTGeometryInfo Info)
{
	const FRTGeometryRef Geometry(
	    new FRTGeometry(std::move(Info)), [To = Releases](FRTGeometry* Ownerless) { To->Add(std::unique_ptr<FRTGeometry>(Ownerless)); });
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
	Entry.Bind(Geometry, Slot);
	DynamicCount += Geometry->GetInfo().bDynamic ? 1 : 0;
	FillingCount += Geometry->GetInfo().bWaitsForData ? 1 : 0;
	return Geometry;
}

void FGeometrySlots::Bury(std::unique_ptr<FRTGeometry> Geometry, FCoarserLevel* Level)
{
	// Its destructor waits for the level. That must not be here, if the level's input lives long enough.
	if (!Level || Level->IsDone() || !Geometry->GetInfo().CpuOwner) { return; }
	Level->Cancel();
	Dying.push_back({std::move(Geometry), Level});
}

uint32_t FGeometrySlots::FreeReleased(uint32_t& OutCoarse, const std::function<void(uint32_t)>& Freed)
{
	OutCoarse = 0;
	std::erase_if(Dying, [](const FDying& Item) { return Item.Level->IsDone(); });
	std::vector<std::unique_ptr<FRTGeometry>> Items = Releases->Take();
	for (std::unique_ptr<FRTGeometry>& Item : Items)
	{
		const uint32_t Slot = Item->GetSlot();
		FGeometryEntry& Entry = Entries[Slot];
		DynamicCount -= Item->GetInfo().bDynamic ? 1 : 0;
		OutCoarse += Entry.bCoarse ? 1 : 0;
		FillingCount -= Entry.State == EGeometryState::Filling ? 1 : 0;
		SetAddress(Entry, 0);
		++Entry.Generation;
		Entry.State = EGeometryState::Free;
		FCoarserLevel* const Level = Entry.GetCoarserLevel();
		Entry.Geometry = nullptr;
		Entry.Owner.reset();
		Entry.Compacted = nullptr;
		Entry.Staging = nullptr;
		FreeSlots.push_back(Slot);
		if (Freed) { Freed(Slot); }
		Bury(std::move(Item), Level);
	}
	return static_cast<uint32_t>(Items.size());
}

bool FGeometrySlots::HasReleased() const
{
	return !Releases->IsEmpty() || std::any_of(Dying.begin(), Dying.end(), [](const FDying& Item) { return Item.Level->IsDone(); });
}

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

void FGeometrySlots::NoteFilled(FGeometryEntry& Entry)
{
	--FillingCount;
	Entry.SetFilled();
	MarkChanged(Entry);
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
