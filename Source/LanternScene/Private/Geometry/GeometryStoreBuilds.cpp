// Which structures are built and refitted in a frame, and the commands for it.
#include <algorithm>
#include <bit>
#include <limits>
#include <tuple>
#include <utility>

#include "Geometry/GeometryStoreVariables.h"
#include "LanternScene/Geometry/GeometryStore.h"
#include "LanternScene/Memory/Upload.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarTriangles("r.RT.Build.TrianglesPerFrame", 500000,
    "Triangles of acceleration structures built in a frame, near and large ones first; at least one geometry. "
    "0: all at once. Offline pictures build all.",
    {0, 2'000'000'000});
TRTConsoleVariable<int32_t> CVarRebuildInterval(
    "r.RT.Skinning.RebuildInterval", 16, "Deformed geometry is refitted, and rebuilt every so many frames. 1: always rebuilt.", {1, 1000});
// Above 2, rays visit so many more boxes that a rebuild pays within a few frames; a walking figure stays below 1.5.
TRTConsoleVariable<float> CVarRebuildQuality("r.RT.Skinning.RebuildQuality", 2.0f,
    "Deformed geometry is rebuilt when the boxes around its triangles are so many times looser than at the "
    "last build. 0: never for that reason.",
    {0.0, 1000.0});

// A batch of builds takes what fits into this much scratch, and at least one geometry.
constexpr uint64_t BatchScratchBytes = 32ull << 20;
// Heights of the picture by which a geometry gains on others in each frame that it waits: after 200 frames nothing is
// ahead of it but what is older, so that none starves.
constexpr float AgingPerFrame = 0.005f;
// A geometry that the next release could make room for holds others back no longer than this.
constexpr uint32_t MostWaitFrames = 32;

uint64_t AlignUp(uint64_t Value, uint64_t Alignment) { return (Value + Alignment - 1) / Alignment * Alignment; }
} // namespace

// ---------------------------------------------------------------------------------------------------- choosing

FRTGeometryDesc FGeometryStore::MakeDesc(const FEntry& Entry, const std::vector<FRTGeometrySection>& Sections) const
{
	const FRTGeometryInfo& Info = Entry.Geometry->Info;
	FRTGeometryDesc Desc;
	Desc.Sections = Sections.data();
	Desc.SectionCount = static_cast<uint32_t>(Sections.size());
	Desc.bAllowUpdate = Info.bDynamic;
	Desc.bFastBuild = Info.bDynamic;
	Desc.bAllowCompaction = Entry.Geometry->Structure ? Entry.bCompactable : !Info.bDynamic && IsCompactionOn();
	Desc.Name = Info.Name.c_str();
	return Desc;
}

void FGeometryStore::UpdateSizes(FEntry& Entry)
{
	const std::vector<FRTGeometrySection> Sections = MakeStructureSections(*Entry.Geometry);
	Entry.Sizes = Device.GetGeometrySizes(MakeDesc(Entry, Sections));
	Entry.Triangles = Entry.Geometry->GetPrimitiveCount();
}

bool FGeometryStore::WantsRefitQuality() const { return CVarRebuildQuality.GetOnRenderThread() > 0.0f; }

void FGeometryStore::Queue(FEntry& Entry)
{
	Entry.State = EState::Pending;
	Pending.push_back(MakeRef(Entry));
}

void FGeometryStore::ChooseRebuilds(std::vector<FEntry*>& Due, uint32_t Interval, uint64_t& Need)
{
	const float Threshold = CVarRebuildQuality.GetOnRenderThread();
	// Characters that came together must not all be rebuilt in one frame: the worst come first, the others follow.
	const auto MakeKey = [=](const FEntry& Entry) {
		const bool bDegraded = Threshold > 0.0f && Entry.RefitRatio > Threshold;
		return std::tuple(!Entry.bRebuild, bDegraded ? -Entry.RefitRatio : 0.0f, -int64_t(Entry.RefitsSinceBuild), Entry.Age);
	};
	std::sort(Due.begin(), Due.end(), [&](const FEntry* A, const FEntry* B) { return MakeKey(*A) < MakeKey(*B); });
	const uint32_t Most = std::max(1u, (DynamicCount + Interval - 1) / Interval);
	for (FEntry* const Entry : Due)
	{
		if (Stats.Rebuilt >= Most && !Entry->bRebuild) { break; }
		const uint64_t Bytes = Entry->Sizes.BuildScratchBytes;
		if (!Entry->bRebuild && GetScratchGrowth(std::max(Need, Bytes)) > GetRoom()) { continue; }
		Entry->bUpdate = false;
		++Stats.Rebuilt;
		Stats.TrianglesBuilt += Entry->Triangles;
		Need = std::max(Need, Bytes);
	}
}

FRTStatus FGeometryStore::ChooseRefits()
{
	const uint32_t Interval = static_cast<uint32_t>(CVarRebuildInterval.GetOnRenderThread());
	const float Threshold = CVarRebuildQuality.GetOnRenderThread();
	const auto IsDegraded = [=](const FEntry& Entry) { return Threshold > 0.0f && Entry.RefitRatio > Threshold; };
	std::vector<FEntry*> Work, Due;
	uint64_t Need = 0;
	for (const FSlotRef Ref : Deformed)
	{
		FEntry* const Entry = Resolve(Ref);
		if (!Entry || Entry->State != EState::Built) { continue; }
		Entry->bDeformed = false;
		Entry->bUpdate = true;
		Need = std::max(Need, Entry->Sizes.UpdateScratchBytes);
		Work.push_back(Entry);
		if (Entry->bRebuild || IsDegraded(*Entry) || Entry->RefitsSinceBuild + 1 >= Interval) { Due.push_back(Entry); }
	}
	Deformed.clear();
	for (FEntry* const Entry : Work)
	{
		Held.push_back(Entry->Owner.lock());
		Recorded.push_back(MakeRef(*Entry));
	}
	RefitScratch = Work.empty() ? RefitScratch : Need;
	ChooseRebuilds(Due, Interval, Need);
	Stats.Refitted = static_cast<uint32_t>(Work.size()) - Stats.Rebuilt;
	// Also where refits need none of it: a build names a buffer.
	return Work.empty() ? FRTStatus::Success() : GrowScratch(Need);
}

void FGeometryStore::OrderPending(bool bBuildAll)
{
	std::erase_if(Pending, [&](FSlotRef Ref) {
		const FEntry* const Entry = Resolve(Ref);
		return !Entry || Entry->State != EState::Pending;
	});
	std::vector<std::pair<float, FSlotRef>> Scored;
	Scored.reserve(Pending.size());
	for (const FSlotRef Ref : Pending)
	{
		FEntry& Entry = Entries[Ref.Slot];
		std::atomic<uint32_t>& Priority = Priorities[Ref.Slot / ChunkSlots][Ref.Slot % ChunkSlots];
		if (const uint32_t Bits = Priority.exchange(0, std::memory_order_relaxed)) { Entry.ScreenSize = std::bit_cast<float>(Bits); }
		float Score = Entry.ScreenSize + AgingPerFrame * static_cast<float>(Frame - Entry.QueuedFrame);
		if (bBuildAll && GetRoom() != ~0ull) { Score = -static_cast<float>(Entry.Sizes.StructureBytes); } // see ChooseBuilds
		if (Entry.bLost) { Score = std::numeric_limits<float>::max(); }
		Scored.push_back({Score, Ref});
	}
	std::sort(Scored.begin(), Scored.end(), [&](const auto& A, const auto& B) {
		return A.first != B.first ? A.first > B.first : Entries[A.second.Slot].Age < Entries[B.second.Slot].Age;
	});
	for (size_t I = 0; I < Scored.size(); ++I) { Pending[I] = Scored[I].second; }
}

FRTStatus FGeometryStore::ChooseBuilds(bool bBuildAll)
{
	if (Pending.empty()) { return FRTStatus::Success(); }
	OrderPending(bBuildAll);
	const uint64_t Limit = static_cast<uint64_t>(CVarTriangles.GetOnRenderThread());
	const std::vector<FSlotRef> Order = std::exchange(Pending, {});
	bool bStop = false;
	size_t Next = 0;
	FRTStatus Status = FRTStatus::Success();
	for (; Next < Order.size() && !bStop && Status; ++Next)
	{
		FEntry& Entry = Entries[Order[Next].Slot];
		const bool bSpent = Limit > 0 && Stats.Built > 0 && !Entry.bLost; // what was in the picture stays there
		if (!bBuildAll && bSpent && Stats.TrianglesBuilt + Entry.Triangles > Limit) { break; }
		// All at once, smallest first: each may take an equal share of the room, and what small ones leave goes to the large.
		const uint64_t Share = bBuildAll ? GetRoom() / (Order.size() - Next) : ~0ull;
		Status = ChooseBuild(Entry, bBuildAll, Share, bStop);
		if (Entry.State == EState::Pending) { Pending.push_back(Order[Next]); }
	}
	Pending.insert(Pending.end(), Order.begin() + static_cast<ptrdiff_t>(Next), Order.end());
	return Status;
}

FRTStatus FGeometryStore::ChooseBuild(FEntry& Entry, bool bBuildAll, uint64_t Share, bool& bOutStop)
{
	const uint64_t Room = GetRoom();
	const uint64_t Structure = Entry.Geometry->Structure ? 0 : Entry.Sizes.StructureBytes;
	const uint64_t Need = Structure + GetScratchGrowth(Entry.Sizes.BuildScratchBytes);
	// While it is compacted there are two of it.
	const bool bOverlap = !bBuildAll && Entry.Misfits < PatienceFrames && IsCompactionOn() && !Entry.Geometry->Info.bDynamic;
	const uint64_t Overlap = bOverlap ? static_cast<uint64_t>(static_cast<double>(Structure) * CompactedShare) : 0;
	if (Room != ~0ull && Need + Overlap > std::min(Room, Share))
	{
		++Stats.WaitingForMemory;
		if (!bBuildAll && Need <= GetBudget() && IsMemoryComing() && ++Entry.Waits <= MostWaitFrames)
		{
			bOutStop = true; // what is behind it must not take what it waits for
			return FRTStatus::Success();
		}
		return OnMisfit(Entry, bBuildAll, std::min(Room, Share));
	}
	const FRTStatus Status = Admit(Entry);
	if (Status.Code != ERTResult::OutOfDeviceMemory || bBuildAll) { return Status; }
	// The device has less than the budget: as if it did not fit.
	++Stats.WaitingForMemory;
	return OnMisfit(Entry, bBuildAll, Entry.Sizes.StructureBytes / 2);
}

FRTStatus FGeometryStore::Admit(FEntry& Entry)
{
	if (FRTStatus S = GrowScratch(Entry.Sizes.BuildScratchBytes); !S) { return S; }
	FRTGeometry& Geometry = *Entry.Geometry;
	if (!Geometry.Structure)
	{
		const std::vector<FRTGeometrySection> Sections = MakeStructureSections(Geometry);
		const FRTGeometryDesc Desc = MakeDesc(Entry, Sections);
		Entry.bCompactable = Desc.bAllowCompaction;
		if (FRTStatus S = Device.CreateGeometry(Desc, Geometry.Structure.ReleaseAndGetAddress()); !S) { return S; }
		Entry.Sizes = Geometry.Structure->GetBuildSizes();
	}
	Held.push_back(Entry.Owner.lock());
	Recorded.push_back(MakeRef(Entry));
	if (Entry.bCompactable)
	{
		Entry.Compaction = ECompaction::Wanted;
		WantSize.push_back(MakeRef(Entry));
	}
	Entry.State = EState::Building;
	Entry.bUpdate = Entry.bLost = Entry.bDeformed = false;
	Entry.Misfits = Entry.Waits = 0;
	Geometry.bBuilt = true;
	SetAddress(Entry, Geometry.Structure->GetDeviceAddress());
	++Stats.Built;
	Stats.TrianglesBuilt += Entry.Triangles;
	Stats.PeakBytes = std::max(Stats.PeakBytes, GetUsed());
	return FRTStatus::Success();
}

// ---------------------------------------------------------------------------------------------------- scratch

FRTStatus FGeometryStore::ReserveScratch(uint64_t Bytes, IRTBuffer*& Out)
{
	SceneScratch = Bytes;
	const FRTStatus Status = GrowScratch(Bytes);
	Out = Scratch.Get();
	return Status;
}

FRTStatus FGeometryStore::GrowScratch(uint64_t Bytes)
{
	ScratchNeed = std::max(ScratchNeed, Bytes);
	if (GetScratchGrowth(Bytes) > 0)
	{
		const FRTBufferDesc Desc{
		    GetScratchGrowth(Bytes), ERTBufferUsage::Scratch | ERTBufferUsage::Storage, ERTMemory::Device, "BuildScratch"};
		TRTRef<IRTBuffer> Larger;
		if (FRTStatus S = Device.CreateBuffer(Desc, Larger.ReleaseAndGetAddress()); !S) { return S; }
		Stats.PeakBytes = std::max(Stats.PeakBytes, GetUsed());
		if (Scratch) { LastReleaseFrame = Frame; }
		Scratch = std::move(Larger);
	}
	return FRTStatus::Success();
}

FRTStatus FGeometryStore::ReserveBatchScratch()
{
	const uint64_t Alignment = std::max(1u, Device.GetCapabilities().ScratchAlignment);
	uint64_t Sum = 0;
	for (const FSlotRef Ref : Recorded)
	{
		const FEntry& Entry = Entries[Ref.Slot];
		Sum += AlignUp(Entry.bUpdate ? Entry.Sizes.UpdateScratchBytes : Entry.Sizes.BuildScratchBytes, Alignment);
	}
	// More is quicker, for builds of one batch overlap, but what there is will do: it holds each alone.
	Sum = std::min(Sum, BatchScratchBytes);
	if (Sum == 0 || GetScratchGrowth(Sum) > GetRoom() / 4) { return FRTStatus::Success(); }
	const FRTStatus Status = GrowScratch(Sum);
	return Status.Code == ERTResult::OutOfDeviceMemory ? FRTStatus::Success() : Status;
}

// ---------------------------------------------------------------------------------------------------- recording

void FGeometryStore::RecordStaging(IRTCommandList& List)
{
	for (const FSlotRef Ref : Recorded)
	{
		const FEntry& Entry = Entries[Ref.Slot];
		if (!Entry.Staging) { continue; }
		IRTBuffer* const Indices = Entry.Geometry->Indices.Get();
		const FRTBarrier Before{Indices, nullptr, ERTAccess::None, ERTAccess::CopyWrite};
		const FRTBarrier After{Indices, nullptr, ERTAccess::CopyWrite, UploadedAccess};
		List.Barriers(&Before, 1);
		List.CopyBuffer(Indices, 0, Entry.Staging.Get(), 0, Entry.Staging->GetDesc().Size);
		List.Barriers(&After, 1);
	}
}

void FGeometryStore::RecordBuilds(IRTCommandList& List)
{
	const uint64_t Alignment = std::max(1u, Device.GetCapabilities().ScratchAlignment);
	const FRTBarrier Between{nullptr, nullptr, ERTAccess::BuildWrite, ERTAccess::BuildWrite | ERTAccess::BuildRead};
	for (size_t Next = 0; Next < Recorded.size();)
	{
		std::vector<std::vector<FRTGeometrySection>> Sections;
		std::vector<FRTGeometryBuild> Builds;
		uint64_t Used = 0;
		for (; Next < Recorded.size(); ++Next)
		{
			const FEntry& Entry = Entries[Recorded[Next].Slot];
			const uint64_t Bytes = Entry.bUpdate ? Entry.Sizes.UpdateScratchBytes : Entry.Sizes.BuildScratchBytes;
			if (!Builds.empty() && Used + Bytes > Scratch->GetDesc().Size) { break; }
			FRTGeometryBuild& Build = Builds.emplace_back();
			Sections.push_back(MakeStructureSections(*Entry.Geometry));
			Build.Geometry = Entry.Geometry->Structure.Get();
			Build.Sections = Sections.back().data(); // moving the outer vector moves no sections
			Build.SectionCount = static_cast<uint32_t>(Sections.back().size());
			Build.bUpdate = Entry.bUpdate;
			Build.Scratch = Scratch.Get();
			Build.ScratchOffset = Used;
			Used = AlignUp(Used + Bytes, Alignment);
		}
		List.BuildGeometries(Builds.data(), static_cast<uint32_t>(Builds.size()));
		List.Barriers(&Between, 1);
	}
}

void FGeometryStore::RecordCompaction(IRTCommandList& List)
{
	for (const FSlotRef Ref : Copying)
	{
		const FEntry& Entry = Entries[Ref.Slot];
		List.CompactGeometry(Entry.Compacted.Get(), Entry.Geometry->Structure.Get());
	}
}

FRTStatus FGeometryStore::RecordQueries(IRTCommandList& List)
{
	std::erase_if(WantSize, [&](FSlotRef Ref) {
		const FEntry* const Entry = Resolve(Ref);
		return !Entry || Entry->Compaction != ECompaction::Wanted;
	});
	if (WantSize.empty()) { return FRTStatus::Success(); }
	// A pool of its own for each frame: one that is used again could still show the answers of its last use.
	FSizeBatch Batch;
	const auto Count = static_cast<uint32_t>(WantSize.size());
	if (FRTStatus S = Device.CreateQueryPool(ERTQuery::CompactedSize, Count, Batch.Queries.ReleaseAndGetAddress()); !S)
	{
		// What does without compaction does without it a little longer.
		return S.Code == ERTResult::OutOfDeviceMemory ? FRTStatus::Success() : S;
	}
	List.ResetQueries(Batch.Queries.Get(), 0, Count);
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		FEntry& Entry = Entries[WantSize[Index].Slot];
		Entry.Compaction = ECompaction::Queried;
		List.WriteCompactedSize(Batch.Queries.Get(), Index, Entry.Geometry->Structure.Get());
	}
	Batch.Items = std::exchange(WantSize, {});
	Batches.push_back(std::move(Batch));
	return FRTStatus::Success();
}

} // namespace Lantern
