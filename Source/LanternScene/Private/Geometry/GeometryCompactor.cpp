// FGeometryCompactor: queries of sizes, copies, take-over.
#include "Geometry/GeometryCompactor.h"

#include <algorithm>
#include <utility>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCompaction(
    "r.RT.Build.Compaction", true, "Copies static acceleration structures to as little memory as they need.");

constexpr double LeastSaved = 0.1;              // of a structure: below that, its copy is not worth the bandwidth
constexpr uint64_t BytesPerFrame = 64ull << 20; // the first copy of a frame may exceed it
constexpr float ShareWeight = 0.1f;             // of a new size in the expected share
} // namespace

FGeometryCompactor::FGeometryCompactor(FGeometryContext& InContext) : Context(InContext) {}

bool FGeometryCompactor::IsOn() { return CVarCompaction.GetOnRenderThread(); }

void FGeometryCompactor::Want(FGeometryEntry& Entry)
{
	Entry.Compaction = EGeometryCompaction::Wanted;
	Wanted.push_back(Context.Slots.MakeRef(Entry));
}

void FGeometryCompactor::Forget(FGeometryEntry& Entry)
{
	Entry.Compaction = EGeometryCompaction::None;
	Entry.Compacted = nullptr;
	const uint32_t Slot = Context.Slots.GetSlot(Entry);
	for (FSizeBatch& Batch : Batches)
	{
		for (FGeometrySlotRef& Item : Batch.Items) { Item.Generation = Item.Slot == Slot ? ~Entry.Generation : Item.Generation; }
	}
}

void FGeometryCompactor::TakeCopies()
{
	for (const FGeometrySlotRef Ref : Copied)
	{
		FGeometryEntry* const Entry = Context.Slots.Resolve(Ref);
		if (!Entry || Entry->Compaction != EGeometryCompaction::Copied) { continue; }
		Entry->Compaction = EGeometryCompaction::None;
		Context.Stats.CompactionSavedBytes += Entry->Sizes.StructureBytes - Entry->CompactedBytes;
		Entry->Sizes.StructureBytes = Entry->CompactedBytes;
		Entry->SetStructure(std::move(Entry->Compacted));
		Context.Slots.SetAddress(*Entry, Entry->Geometry->GetStructure()->GetDeviceAddress());
		Context.Memory.NoteRelease();
	}
	Copied.clear();
}

void FGeometryCompactor::TakeSize(FGeometrySlotRef Ref, uint64_t Bytes)
{
	FGeometryEntry* const Entry = Context.Slots.Resolve(Ref);
	if (!Entry || Entry->Compaction != EGeometryCompaction::Queried) { return; }
	const double Share = static_cast<double>(Bytes) / static_cast<double>(Entry->Sizes.StructureBytes);
	ExpectedShare += ShareWeight * (static_cast<float>(std::min(Share, 1.0)) - ExpectedShare);
	const bool bWorthIt = Bytes > 0 && Share <= 1.0 - LeastSaved;
	Entry->Compaction = bWorthIt ? EGeometryCompaction::Sized : EGeometryCompaction::None;
	Entry->CompactedBytes = Bytes;
	if (bWorthIt) { Sized.push_back(Ref); }
}

void FGeometryCompactor::TakeSizes()
{
	for (FSizeBatch& Batch : Batches)
	{
		std::vector<uint64_t> Sizes(Batch.Items.size());
		if (!Batch.bSubmitted || !Batch.Queries->GetResults(0, static_cast<uint32_t>(Sizes.size()), Sizes.data())) { continue; }
		Batch.Queries = nullptr;
		for (size_t Index = 0; Index < Sizes.size(); ++Index) { TakeSize(Batch.Items[Index], Sizes[Index]); }
	}
	std::erase_if(Batches, [](const FSizeBatch& Batch) { return !Batch.Queries; });
}

bool FGeometryCompactor::Fits(const FGeometryEntry& Entry) const
{
	const uint64_t Room = Context.Memory.GetRoom();
	return Room == FGeometryMemoryBudget::Unlimited || Entry.CompactedBytes + Context.Scratch.GetGrowth(0) <= Room;
}

FRTStatus FGeometryCompactor::CreateCopy(FGeometryEntry& Entry)
{
	const std::vector<FRTGeometrySection> Sections = MakeStructureSections(*Entry.Geometry);
	FRTGeometryDesc Desc = Entry.MakeDesc(Sections);
	Desc.CompactedBytes = Entry.CompactedBytes;
	if (FRTStatus S = Context.Device.CreateGeometry(Desc, Entry.Compacted.ReleaseAndGetAddress()); !S) { return S; }
	Context.Memory.UpdatePeak();
	return FRTStatus::Success();
}

FRTStatus FGeometryCompactor::Choose()
{
	if (Sized.empty()) { return FRTStatus::Success(); }
	std::erase_if(Sized, [&](FGeometrySlotRef Ref) {
		const FGeometryEntry* const Entry = Context.Slots.Resolve(Ref);
		return !Entry || Entry->Compaction != EGeometryCompaction::Sized;
	});
	// Each copy of a small structure makes room for that of a larger one.
	std::sort(Sized.begin(), Sized.end(), [&](FGeometrySlotRef A, FGeometrySlotRef B) {
		return Context.Slots[A.Slot].CompactedBytes < Context.Slots[B.Slot].CompactedBytes;
	});
	uint64_t Bytes = 0;
	size_t Next = 0;
	FRTStatus Status = FRTStatus::Success();
	for (; Next < Sized.size(); ++Next)
	{
		FGeometryEntry& Entry = Context.Slots[Sized[Next].Slot];
		const bool bFits = Entry.Compacted || Fits(Entry);
		if (!bFits || (Bytes > 0 && Bytes + Entry.CompactedBytes > BytesPerFrame)) { break; }
		if (!Entry.Compacted) { Status = CreateCopy(Entry); }
		if (!Status) { break; }
		Bytes += Entry.CompactedBytes;
		Entry.Compaction = EGeometryCompaction::Copying;
		Context.Slots.Hold(Entry);
		Copying.push_back(Sized[Next]);
		++Context.Stats.Compacted;
	}
	Sized.erase(Sized.begin(), Sized.begin() + static_cast<ptrdiff_t>(Next));
	return Status.Code == ERTResult::OutOfDeviceMemory ? FRTStatus::Success() : Status;
}

void FGeometryCompactor::RecordCopies(IRTCommandList& List)
{
	for (const FGeometrySlotRef Ref : Copying)
	{
		const FGeometryEntry& Entry = Context.Slots[Ref.Slot];
		List.CompactGeometry(Entry.Compacted.Get(), Entry.Geometry->GetStructure());
	}
}

void FGeometryCompactor::DropUnwanted()
{
	std::erase_if(Wanted, [&](FGeometrySlotRef Ref) {
		const FGeometryEntry* const Entry = Context.Slots.Resolve(Ref);
		return !Entry || Entry->Compaction != EGeometryCompaction::Wanted;
	});
}

FRTStatus FGeometryCompactor::RecordQueries(IRTCommandList& List)
{
	DropUnwanted();
	if (Wanted.empty()) { return FRTStatus::Success(); }
	// Each frame has a pool of its own: one that is used again could still show the answers of its last use.
	FSizeBatch Batch;
	const auto Count = static_cast<uint32_t>(Wanted.size());
	if (FRTStatus S = Context.Device.CreateQueryPool(ERTQuery::CompactedSize, Count, Batch.Queries.ReleaseAndGetAddress()); !S)
	{
		return S.Code == ERTResult::OutOfDeviceMemory ? FRTStatus::Success() : S;
	}
	List.ResetQueries(Batch.Queries.Get(), 0, Count);
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		FGeometryEntry& Entry = Context.Slots[Wanted[Index].Slot];
		Entry.Compaction = EGeometryCompaction::Queried;
		List.WriteCompactedSize(Batch.Queries.Get(), Index, Entry.Geometry->GetStructure());
	}
	Batch.Items = std::exchange(Wanted, {});
	Batches.push_back(std::move(Batch));
	return FRTStatus::Success();
}

void FGeometryCompactor::Submitted()
{
	for (const FGeometrySlotRef Ref : Copying) { Context.Slots[Ref.Slot].Compaction = EGeometryCompaction::Copied; }
	Copied.insert(Copied.end(), Copying.begin(), Copying.end());
	for (FSizeBatch& Batch : Batches) { Batch.bSubmitted = true; }
	Copying.clear();
}

void FGeometryCompactor::Lost()
{
	for (const FGeometrySlotRef Ref : Copying)
	{
		Context.Slots[Ref.Slot].Compaction = EGeometryCompaction::Sized;
		Sized.push_back(Ref);
	}
	Copying.clear();
	for (const FSizeBatch& Batch : Batches)
	{
		for (const FGeometrySlotRef Ref : Batch.Items)
		{
			FGeometryEntry* const Entry = Batch.bSubmitted ? nullptr : Context.Slots.Resolve(Ref);
			if (Entry && Entry->Compaction == EGeometryCompaction::Queried) { Want(*Entry); }
		}
	}
	std::erase_if(Batches, [](const FSizeBatch& Batch) { return !Batch.bSubmitted; });
}

bool FGeometryCompactor::NeedsUpdate() const
{
	if (!Wanted.empty() || !Copied.empty()) { return true; }
	const auto IsReady = [&](FGeometrySlotRef Ref) {
		const FGeometryEntry* const Entry = Context.Slots.Resolve(Ref);
		return Entry && Fits(*Entry);
	};
	if (std::any_of(Sized.begin(), Sized.end(), IsReady)) { return true; }
	for (const FSizeBatch& Batch : Batches)
	{
		std::vector<uint64_t> Sizes(Batch.Items.size());
		if (Batch.Queries->GetResults(0, static_cast<uint32_t>(Sizes.size()), Sizes.data())) { return true; }
	}
	return false;
}

} // namespace Lantern
