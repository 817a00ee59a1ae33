#include "LanternScene/Geometry/GeometryStore.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

#include "Geometry/CoarserLevel.h"
#include "Geometry/GeometryReleases.h"
#include "LanternRHI/RTText.h"

namespace Lantern
{

namespace
{
constexpr uint32_t ShrinkAfterFrames = 64;
constexpr uint64_t SmallScratchBytes = 256 << 10; // not worth a new allocation

FRTStatus RefuseSection(const FRTGeometryInfo& Info, size_t Section, const char* Reason)
{
	return FRTStatus::Error(
	    ERTResult::InvalidArgument, "geometry \"%s\", section %zu: %s", FRTShown(Info.Name.c_str()).Text, Section, Reason);
}
} // namespace

FGeometryStore::FGeometryStore(IRTDevice& InDevice) : Device(InDevice), Releases(std::make_shared<FGeometryReleases>()) {}
FGeometryStore::~FGeometryStore() = default;

// ---------------------------------------------------------------------------------------------------- slots

FRTStatus FGeometryStore::Check(const FRTGeometryInfo& Info) const
{
	if (Info.Sections.empty())
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "geometry \"%s\" has no section", FRTShown(Info.Name.c_str()).Text);
	}
	uint64_t Primitives = 0;
	for (size_t Index = 0; Index < Info.Sections.size(); ++Index)
	{
		const FRTSectionInfo& Section = Info.Sections[Index];
		if (Section.bProcedural)
		{
			if (Section.IndexCount == 0) { return RefuseSection(Info, Index, "no boxes"); }
			if (!Info.Aabbs) { return RefuseSection(Info, Index, "boxes, but no buffer of them"); }
			Primitives += Section.IndexCount;
			continue;
		}
		if (Section.IndexCount < 3) { return RefuseSection(Info, Index, "no triangles"); }
		if (Section.IndexCount % 3 != 0) { return RefuseSection(Info, Index, "the number of indices is not a multiple of 3"); }
		if (!Info.Positions || !Info.Attributes || !Info.Indices) { return RefuseSection(Info, Index, "a buffer is missing"); }
		if (uint64_t(Section.OpaqueIndexCount) + Section.TransparentIndexCount > Section.IndexCount)
		{
			return RefuseSection(Info, Index, "more classified triangles than triangles");
		}
		Primitives += Section.IndexCount / 3;
	}
	if (const uint64_t Most = Device.GetCapabilities().MaxPrimitiveCount; Primitives > Most)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "%s has %llu triangles; the device allows %llu", FRTShown(Info.Name.c_str()).Text,
		    static_cast<unsigned long long>(Primitives), static_cast<unsigned long long>(Most));
	}
	return FRTStatus::Success();
}

uint32_t FGeometryStore::TakeSlot()
{
	if (!FreeSlots.empty())
	{
		const uint32_t Slot = FreeSlots.back();
		FreeSlots.pop_back();
		return Slot;
	}
	const uint32_t Slot = GetSlotCount();
	assert(Slot < ChunkSlots * MaxChunks);
	if (Slot % ChunkSlots == 0) { Priorities[Slot / ChunkSlots] = std::make_unique<std::atomic<uint32_t>[]>(ChunkSlots); }
	Entries.emplace_back();
	Addresses.push_back(0);
	return Slot;
}

FRTStatus FGeometryStore::Create(FRTGeometryInfo Info, FRTGeometryRef& Out)
{
	if (FRTStatus S = Check(Info); !S) { return S; }
	DrainReleases();
	const uint32_t Slot = TakeSlot();
	auto Geometry = std::make_shared<FRTGeometry>(std::move(Info));
	Geometry->Slot = Slot;
	Geometry->Releases = Releases;
	FEntry& Entry = Entries[Slot];
	const uint32_t Generation = Entry.Generation;
	const bool bChanged = Entry.bChanged;
	Entry = {};
	Entry.Generation = Generation;
	Entry.bChanged = bChanged;
	Entry.Owner = Geometry;
	Entry.Geometry = Geometry.get();
	Entry.Age = NextAge++;
	Entry.QueuedFrame = Frame;
	Priorities[Slot / ChunkSlots][Slot % ChunkSlots].store(0, std::memory_order_relaxed);
	DynamicCount += Geometry->Info.bDynamic ? 1 : 0;
	ApplyOpacity(Entry);
	UpdateSizes(Entry);
	Queue(Entry);
	Out = std::move(Geometry);
	return FRTStatus::Success();
}

FGeometryStore::FEntry* FGeometryStore::Resolve(FSlotRef Ref)
{
	FEntry& Entry = Entries[Ref.Slot];
	return Entry.Generation == Ref.Generation && !Entry.Owner.expired() ? &Entry : nullptr;
}

FGeometryStore::FSlotRef FGeometryStore::MakeRef(const FEntry& Entry) const
{
	return {static_cast<uint32_t>(&Entry - Entries.data()), Entry.Generation};
}

void FGeometryStore::DrainReleases()
{
	for (const FGeometryReleases::FItem& Item : Releases->Take())
	{
		FEntry& Entry = Entries[Item.Slot];
		DynamicCount -= Item.bDynamic ? 1 : 0;
		Stats.Coarse -= Entry.bCoarse ? 1 : 0;
		SetAddress(Entry, 0);
		++Entry.Generation;
		Entry.State = EState::Free;
		Entry.Geometry = nullptr;
		Entry.Owner.reset();
		Entry.Compacted = nullptr;
		Entry.Staging = nullptr;
		FreeSlots.push_back(Item.Slot);
		LastReleaseFrame = Frame;
	}
}

const FRTGeometry* FGeometryStore::Get(uint32_t Slot) const
{
	return Slot < Entries.size() && !Entries[Slot].Owner.expired() ? Entries[Slot].Geometry : nullptr;
}

void FGeometryStore::MarkChanged(FEntry& Entry)
{
	if (Entry.bChanged) { return; }
	Entry.bChanged = true;
	Changed.push_back(MakeRef(Entry).Slot);
}

void FGeometryStore::SetAddress(FEntry& Entry, uint64_t Address)
{
	uint64_t& Now = Addresses[MakeRef(Entry).Slot];
	if (Now == Address) { return; }
	Now = Address;
	MarkChanged(Entry);
}

std::vector<uint32_t> FGeometryStore::TakeChanged()
{
	for (const uint32_t Slot : Changed) { Entries[Slot].bChanged = false; }
	return std::exchange(Changed, {});
}

void FGeometryStore::RaisePriority(uint32_t Slot, float ScreenSize)
{
	// Floats that are not negative order as their bits do.
	const uint32_t Bits = std::bit_cast<uint32_t>(ScreenSize > 0.0f ? ScreenSize : 0.0f); // 0 for what is no number
	std::atomic<uint32_t>& Priority = Priorities[Slot / ChunkSlots][Slot % ChunkSlots];
	uint32_t Before = Priority.load(std::memory_order_relaxed);
	while (Before < Bits && !Priority.compare_exchange_weak(Before, Bits, std::memory_order_relaxed)) {}
}

void FGeometryStore::MarkDeformed(const FRTGeometryRef& Geometry)
{
	assert(Geometry->Info.bDynamic);
	FEntry& Entry = Entries[Geometry->Slot];
	const bool bThere = Entry.State == EState::Built || Entry.State == EState::Building;
	if (!bThere || Entry.bDeformed) { return; } // its first build sees the new vertices
	Entry.bDeformed = true;
	Deformed.push_back(MakeRef(Entry));
}

void FGeometryStore::SetRefitQuality(uint32_t Slot, float Ratio)
{
	if (Slot < Entries.size()) { Entries[Slot].RefitRatio = Ratio; }
}

uint32_t FGeometryStore::GetBuildCount(uint32_t Slot) const { return Slot < Entries.size() ? Entries[Slot].Builds : 0; }

// ---------------------------------------------------------------------------------------------------- frame

bool FGeometryStore::NeedsUpdate() const
{
	if (!Pending.empty() || !Deformed.empty() || !WantSize.empty() || !Copied.empty() || !Releases->IsEmpty()) { return true; }
	const auto Fits = [&](FSlotRef Ref) { return Entries[Ref.Slot].Generation == Ref.Generation && FitsCompacted(Entries[Ref.Slot]); };
	if (std::any_of(Sized.begin(), Sized.end(), Fits)) { return true; }
	if (IsScratchTooLarge()) { return true; }
	const uint64_t Room = Refused.empty() ? 0 : GetRoom();
	for (const FSlotRef Ref : Refused)
	{
		const FEntry& Entry = Entries[Ref.Slot];
		if (Entry.Generation == Ref.Generation && !Entry.Owner.expired() && IsWorthAnother(Entry, Room)) { return true; }
	}
	for (const FSizeBatch& Batch : Batches)
	{
		std::vector<uint64_t> Sizes(Batch.Items.size());
		if (Batch.Queries->GetResults(0, static_cast<uint32_t>(Sizes.size()), Sizes.data())) { return true; }
	}
	return std::any_of(Coarsening.begin(), Coarsening.end(), [&](FSlotRef Ref) {
		const FEntry& Entry = Entries[Ref.Slot];
		return Entry.Generation == Ref.Generation && !Entry.Owner.expired() && Entry.Geometry->Coarser && Entry.Geometry->Coarser->IsDone();
	});
}

FRTStatus FGeometryStore::BeginFrame(bool bBuildAll)
{
	if (!Recorded.empty() || !Copying.empty()) { Lost(); } // EndFrame was not called
	++Frame;
	Stats.TrianglesBuilt = 0;
	Stats.Built = Stats.Refitted = Stats.Rebuilt = Stats.Compacted = Stats.WaitingForMemory = 0;
	DrainReleases();
	TakeCompacted();
	TakeSizes();
	ReconsiderRefused();
	FRTStatus Status = ChooseRefits();
	if (Status) { Status = ChooseCompactions(); }
	if (Status) { Status = TakeCoarser(); }
	if (Status) { Status = ChooseBuilds(bBuildAll); }
	if (Status) { Status = ReserveBatchScratch(); }
	if (!Status) { Lost(); }
	UpdateStats();
	return Status;
}

FRTStatus FGeometryStore::Record(IRTCommandList& List)
{
	if (Recorded.empty() && Copying.empty() && WantSize.empty()) { return FRTStatus::Success(); }
	RecordStaging(List);
	const FRTBarrier Before{nullptr, nullptr, ERTAccess::TraceRead | ERTAccess::BuildRead | ERTAccess::BuildWrite,
	    ERTAccess::BuildWrite | ERTAccess::BuildRead};
	List.Barriers(&Before, 1);
	RecordBuilds(List);
	RecordCompaction(List);
	const FRTStatus Status = RecordQueries(List);
	const FRTBarrier After{nullptr, nullptr, ERTAccess::BuildWrite, ERTAccess::BuildWrite | ERTAccess::BuildRead | ERTAccess::TraceRead};
	List.Barriers(&After, 1);
	return Status;
}

void FGeometryStore::EndFrame(bool bSubmitted)
{
	if (bSubmitted)
	{
		Submitted();
		ShrinkScratch();
	}
	else { Lost(); }
	UpdateStats();
}

void FGeometryStore::Submitted()
{
	for (const FSlotRef Ref : Recorded)
	{
		FEntry& Entry = Entries[Ref.Slot];
		Entry.State = EState::Built;
		Entry.Staging = nullptr;
		Entry.bRebuild = false;
		Entry.RefitsSinceBuild = Entry.bUpdate ? Entry.RefitsSinceBuild + 1 : 0;
		if (!Entry.bUpdate)
		{
			Entry.RefitRatio = 1.0f;
			++Entry.Builds;
		}
	}
	for (const FSlotRef Ref : Copying) { Entries[Ref.Slot].Compaction = ECompaction::Copied; }
	Copied.insert(Copied.end(), Copying.begin(), Copying.end());
	for (FSizeBatch& Batch : Batches) { Batch.bSubmitted = true; }
	Recorded.clear();
	Copying.clear();
	Held.clear();
}

void FGeometryStore::Lost()
{
	for (const FSlotRef Ref : Recorded)
	{
		FEntry& Entry = Entries[Ref.Slot];
		if (Entry.State == EState::Building)
		{
			Entry.bLost = true;
			Entry.Compaction = ECompaction::None;
			Entry.Geometry->bBuilt = false;
			SetAddress(Entry, 0);
			Queue(Entry);
			continue;
		}
		Entry.bRebuild |= !Entry.bUpdate;
		if (Entry.bDeformed) { continue; }
		Entry.bDeformed = true;
		Deformed.push_back(Ref);
	}
	for (const FSlotRef Ref : Copying)
	{
		Entries[Ref.Slot].Compaction = ECompaction::Sized;
		Sized.push_back(Ref);
	}
	for (const FSizeBatch& Batch : Batches)
	{
		for (const FSlotRef Ref : Batch.Items)
		{
			FEntry* const Entry = Batch.bSubmitted ? nullptr : Resolve(Ref);
			if (!Entry || Entry->Compaction != ECompaction::Queried) { continue; }
			Entry->Compaction = ECompaction::Wanted;
			WantSize.push_back(Ref);
		}
	}
	std::erase_if(Batches, [](const FSizeBatch& Batch) { return !Batch.bSubmitted; });
	// Of builds that were lost, no size can be asked.
	std::erase_if(WantSize, [&](FSlotRef Ref) {
		const FEntry* const Entry = Resolve(Ref);
		return !Entry || Entry->Compaction != ECompaction::Wanted;
	});
	Recorded.clear();
	Copying.clear();
	Held.clear();
}

bool FGeometryStore::IsScratchTooLarge() const
{
	const uint64_t Size = Scratch ? Scratch->GetDesc().Size : 0;
	return Size > SmallScratchBytes && RecentScratchNeed * 2 < Size;
}

void FGeometryStore::ShrinkScratch()
{
	RecentScratchNeed = std::max(RecentScratchNeed, std::exchange(ScratchNeed, 0));
	if (!IsScratchTooLarge())
	{
		FramesScratchTooLarge = 0;
		RecentScratchNeed = 0;
		return;
	}
	if (++FramesScratchTooLarge < ShrinkAfterFrames) { return; }
	Scratch = nullptr; // made anew, as small as will do, by whoever needs it next
	LastReleaseFrame = Frame;
	FramesScratchTooLarge = 0;
	RecentScratchNeed = 0;
}

void FGeometryStore::UpdateStats()
{
	const FRTMemoryStats Memory = Device.GetMemoryStats();
	Stats.LiveBytes = Memory.Geometry;
	Stats.ScratchBytes = Memory.Scratch;
	Stats.PeakBytes = std::max(Stats.PeakBytes, Memory.Geometry + Memory.Scene + Memory.Scratch);
	Stats.Pending = static_cast<uint32_t>(Pending.size() + Coarsening.size());
	Stats.Refused = static_cast<uint32_t>(Refused.size());
}

} // namespace Lantern
