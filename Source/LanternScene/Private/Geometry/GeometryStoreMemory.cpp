// The memory of acceleration structures: the budget, compaction, and what becomes of geometry that does not fit.
#include <algorithm>
#include <cstring>
#include <utility>

#include "Geometry/CoarserLevel.h"
#include "Geometry/GeometryStoreVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternScene/Geometry/GeometryStore.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarMemory("r.RT.Build.MemoryMB", 0,
    "Most memory of acceleration structures and their builds, at the peak, in MiB: living, being built, being "
    "compacted, scratch, and released but still in use. 0: no limit.",
    {0, 1 << 20});
TRTConsoleVariable<bool> CVarCompaction(
    "r.RT.Build.Compaction", true, "Static acceleration structures are copied to as little memory as they need.");
TRTConsoleVariable<bool> CVarCoarser("r.RT.Build.CoarserLevels", true,
    "Static geometry that does not fit into r.RT.Build.MemoryMB is simplified. Off: it is left out of the scene.");

constexpr double LeastSaved = 0.1;                       // of a structure: below that, its copy is not worth the bandwidth
constexpr uint64_t CompactedBytesPerFrame = 64ull << 20; // beside at least one
constexpr uint64_t ScratchStep = 64 << 10;
// The GPU lets go of what was released within the frames that are in flight.
constexpr uint64_t FramesUntilReleased = 8;
constexpr uint32_t MaxCoarsenings = 4;
constexpr double LeastShare = 1.0 / 64; // of the triangles: a coarser level than that is no picture of the geometry
constexpr double Safety = 0.9;          // of the room: bytes are not quite proportional to triangles

double ToMiB(uint64_t Bytes) { return static_cast<double>(Bytes) / (1 << 20); }
} // namespace

bool IsCompactionOn() { return CVarCompaction.GetOnRenderThread(); }

// ---------------------------------------------------------------------------------------------------- budget

uint64_t FGeometryStore::GetBudget() const { return static_cast<uint64_t>(CVarMemory.GetOnRenderThread()) << 20; }

uint64_t FGeometryStore::GetUsed() const
{
	const FRTMemoryStats Memory = Device.GetMemoryStats();
	return Memory.Geometry + Memory.Scene + Memory.Scratch;
}

uint64_t FGeometryStore::GetRoom() const
{
	const uint64_t Budget = GetBudget();
	const uint64_t Used = Budget > 0 ? GetUsed() : 0;
	return Budget == 0 ? ~0ull : Budget > Used ? Budget - Used : 0;
}

uint64_t FGeometryStore::GetScratchGrowth(uint64_t Bytes) const
{
	// With what must be in the same frame, whatever is chosen to be built.
	Bytes = std::max({Bytes, SceneScratch, DynamicCount > 0 ? RefitScratch : 0});
	const bool bEnough = Scratch && Scratch->GetDesc().Size >= Bytes;
	// Of the whole size, since the GPU may still use the smaller one.
	return bEnough ? 0 : (std::max<uint64_t>(Bytes, 1) + ScratchStep - 1) / ScratchStep * ScratchStep;
}

bool FGeometryStore::IsMemoryComing() const
{
	const bool bReleased = LastReleaseFrame > 0 && Frame - LastReleaseFrame < FramesUntilReleased;
	return bReleased || !Batches.empty() || !Copying.empty() || !WantSize.empty();
}

// ---------------------------------------------------------------------------------------------------- compaction

void FGeometryStore::TakeSizes()
{
	for (FSizeBatch& Batch : Batches)
	{
		std::vector<uint64_t> Sizes(Batch.Items.size());
		if (!Batch.bSubmitted || !Batch.Queries->GetResults(0, static_cast<uint32_t>(Sizes.size()), Sizes.data())) { continue; }
		Batch.Queries = nullptr;
		for (size_t Index = 0; Index < Sizes.size(); ++Index)
		{
			FEntry* const Entry = Resolve(Batch.Items[Index]);
			if (!Entry || Entry->Compaction != ECompaction::Queried) { continue; }
			const double Share = static_cast<double>(Sizes[Index]) / static_cast<double>(Entry->Sizes.StructureBytes);
			CompactedShare += 0.1f * (static_cast<float>(std::min(Share, 1.0)) - CompactedShare);
			const bool bWorthIt = Sizes[Index] > 0 && Share <= 1.0 - LeastSaved;
			Entry->Compaction = bWorthIt ? ECompaction::Sized : ECompaction::None;
			Entry->CompactedBytes = Sizes[Index];
			if (bWorthIt) { Sized.push_back(Batch.Items[Index]); }
		}
	}
	std::erase_if(Batches, [](const FSizeBatch& Batch) { return !Batch.Queries; });
}

bool FGeometryStore::FitsCompacted(const FEntry& Entry) const
{
	const uint64_t Room = GetRoom();
	return Room == ~0ull || Entry.CompactedBytes + GetScratchGrowth(0) <= Room;
}

FRTStatus FGeometryStore::ChooseCompactions()
{
	if (Sized.empty()) { return FRTStatus::Success(); }
	std::erase_if(Sized, [&](FSlotRef Ref) {
		const FEntry* const Entry = Resolve(Ref);
		return !Entry || Entry->Compaction != ECompaction::Sized;
	});
	// The smallest first: each that is done makes room for a larger one.
	std::sort(Sized.begin(), Sized.end(),
	    [&](FSlotRef A, FSlotRef B) { return Entries[A.Slot].CompactedBytes < Entries[B.Slot].CompactedBytes; });
	uint64_t Bytes = 0;
	size_t Next = 0;
	FRTStatus Status = FRTStatus::Success();
	for (; Next < Sized.size(); ++Next)
	{
		FEntry& Entry = Entries[Sized[Next].Slot];
		const bool bFits = Entry.Compacted || FitsCompacted(Entry);
		if (!bFits || (Bytes > 0 && Bytes + Entry.CompactedBytes > CompactedBytesPerFrame)) { break; }
		if (!Entry.Compacted)
		{
			const std::vector<FRTGeometrySection> Sections = MakeStructureSections(*Entry.Geometry);
			FRTGeometryDesc Desc = MakeDesc(Entry, Sections);
			Desc.CompactedBytes = Entry.CompactedBytes;
			Status = Device.CreateGeometry(Desc, Entry.Compacted.ReleaseAndGetAddress());
			if (!Status) { break; }
			Stats.PeakBytes = std::max(Stats.PeakBytes, GetUsed());
		}
		Bytes += Entry.CompactedBytes;
		Entry.Compaction = ECompaction::Copying;
		Held.push_back(Entry.Owner.lock());
		Copying.push_back(Sized[Next]);
		++Stats.Compacted;
	}
	Sized.erase(Sized.begin(), Sized.begin() + static_cast<ptrdiff_t>(Next));
	// What does without compaction does without it a little longer.
	return Status.Code == ERTResult::OutOfDeviceMemory ? FRTStatus::Success() : Status;
}

void FGeometryStore::TakeCompacted()
{
	for (const FSlotRef Ref : Copied)
	{
		FEntry* const Entry = Resolve(Ref);
		if (!Entry || Entry->Compaction != ECompaction::Copied) { continue; }
		Entry->Compaction = ECompaction::None;
		Stats.CompactionSavedBytes += Entry->Sizes.StructureBytes - Entry->CompactedBytes;
		Entry->Sizes.StructureBytes = Entry->CompactedBytes;
		Entry->Geometry->Structure = std::move(Entry->Compacted);
		SetAddress(*Entry, Entry->Geometry->Structure->GetDeviceAddress());
		LastReleaseFrame = Frame;
	}
	Copied.clear();
}

// ---------------------------------------------------------------------------------------------------- what does not fit

bool FGeometryStore::CanCoarsen(const FEntry& Entry) const
{
	const FRTGeometryInfo& Info = Entry.Geometry->Info;
	const bool bBoxes =
	    std::any_of(Info.Sections.begin(), Info.Sections.end(), [](const FRTSectionInfo& Section) { return Section.bProcedural; });
	return CVarCoarser.GetOnRenderThread() && Info.CpuPositions && Info.CpuIndices && !Info.bDynamic && !bBoxes &&
	       Entry.Coarsenings < MaxCoarsenings;
}

bool FGeometryStore::StartCoarser(FEntry& Entry, uint64_t Room)
{
	if (!CanCoarsen(Entry)) { return false; }
	const double Need = static_cast<double>(Entry.Sizes.StructureBytes + GetScratchGrowth(Entry.Sizes.BuildScratchBytes));
	const double Triangles = Safety * static_cast<double>(Room) / Need * static_cast<double>(Entry.Triangles);
	uint64_t All = 0;
	for (const FRTSectionInfo& Section : Entry.Geometry->Info.Sections) { All += Section.IndexCount / 3; }
	// Always from the finest level: simplifying twice would add up errors.
	const double Share = std::min(Triangles, 0.75 * static_cast<double>(Entry.Triangles)) / static_cast<double>(All);
	if (Share < LeastShare) { return false; }
	++Entry.Coarsenings;
	Entry.Geometry->Structure = nullptr;
	Entry.Geometry->Coarser = std::make_unique<FCoarserLevel>(Entry.Geometry->Info, Share);
	Entry.State = EState::Coarsening;
	Coarsening.push_back(MakeRef(Entry));
	return true;
}

FRTStatus FGeometryStore::TakeCoarser()
{
	const std::vector<FSlotRef> Work = std::exchange(Coarsening, {});
	FRTStatus Status = FRTStatus::Success();
	for (const FSlotRef Ref : Work)
	{
		FEntry* const Entry = Resolve(Ref);
		if (!Entry || Entry->State != EState::Coarsening) { continue; }
		if (Status && Entry->Geometry->Coarser->IsDone()) { Status = TakeCoarser(*Entry); }
		if (Entry->State == EState::Coarsening) { Coarsening.push_back(Ref); }
	}
	return Status;
}

FRTStatus FGeometryStore::TakeCoarser(FEntry& Entry)
{
	FRTGeometry& Geometry = *Entry.Geometry;
	const FCoarserLevel& Level = *Geometry.Coarser;
	if (Level.GetIndices().empty())
	{
		Geometry.Coarser = nullptr;
		Refuse(Entry, GetRoom());
		return FRTStatus::Success();
	}
	const uint64_t Bytes = Level.GetIndices().size() * sizeof(uint32_t);
	const ERTBufferUsage Usage = ERTBufferUsage::Index | ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput | ERTBufferUsage::CopyDest;
	TRTRef<IRTBuffer> Indices, Staging;
	FRTStatus Status = Device.CreateBuffer({Bytes, Usage, ERTMemory::Device, Geometry.Info.Name.c_str()}, Indices.ReleaseAndGetAddress());
	if (Status)
	{
		Status = Device.CreateBuffer(
		    {Bytes, ERTBufferUsage::CopySource, ERTMemory::Upload, Geometry.Info.Name.c_str()}, Staging.ReleaseAndGetAddress());
	}
	if (!Status) { return Status.Code == ERTResult::OutOfDeviceMemory ? FRTStatus::Success() : Status; } // again in the next frame
	std::memcpy(Staging->GetMapped(), Level.GetIndices().data(), Bytes);
	Stats.Coarse += std::exchange(Entry.bCoarse, true) ? 0 : 1;
	const uint64_t Before = Entry.Triangles, BytesBefore = Entry.Sizes.StructureBytes;
	Geometry.Indices = std::move(Indices);
	Geometry.IndicesOffset = 0;
	Geometry.IndexType = ERTIndexType::UInt32;
	Geometry.Parts = Level.GetParts();
	Geometry.bCoarse = true;
	Geometry.Coarser = nullptr;
	Entry.Staging = std::move(Staging);
	UpdateSizes(Entry);
	Queue(Entry);
	MarkChanged(Entry);
	if (!std::exchange(Entry.bSaid, true))
	{
		LogOnce(ERTLogLevel::Warning, fmt::format("Scene: geometry \"{}\" does not fit: {:.1f} MiB of acceleration "
		                                          "structure, r.RT.Build.MemoryMB {}; a coarser "
		                                          "level of {} of its {} triangles takes its place",
		                                  EscapeText(Geometry.Info.Name, MaxQuotedBytes), ToMiB(BytesBefore),
		                                  CVarMemory.GetOnRenderThread(), Entry.Triangles, Before));
	}
	return FRTStatus::Success();
}

void FGeometryStore::Refuse(FEntry& Entry, uint64_t Room)
{
	Entry.State = EState::Refused;
	Entry.RefusedRoom = Room;
	Entry.Geometry->Structure = nullptr;
	Refused.push_back(MakeRef(Entry));
	if (std::exchange(Entry.bSaid, true)) { return; }
	LogOnce(ERTLogLevel::Warning,
	    fmt::format("Scene: geometry \"{}\" ({} triangles) is left out: {:.1f} MiB of acceleration structure do not fit, "
	                "r.RT.Build.MemoryMB {}, {:.1f} MiB in use",
	        EscapeText(Entry.Geometry->Info.Name, MaxQuotedBytes), Entry.Triangles, ToMiB(Entry.Sizes.StructureBytes),
	        CVarMemory.GetOnRenderThread(), ToMiB(GetUsed())));
}

FRTStatus FGeometryStore::OnMisfit(FEntry& Entry, bool bBuildAll, uint64_t Room)
{
	if (!bBuildAll && ++Entry.Misfits <= PatienceFrames) { return FRTStatus::Success(); }
	if (!StartCoarser(Entry, Room))
	{
		Refuse(Entry, Room);
		return FRTStatus::Success();
	}
	if (!bBuildAll) { return FRTStatus::Success(); }
	Entry.Geometry->Coarser->Wait();
	if (FRTStatus S = TakeCoarser(); !S) { return S; }
	std::erase_if(Pending, [&](FSlotRef Ref) { return Ref.Slot == MakeRef(Entry).Slot; });
	if (Entry.State != EState::Pending) { return FRTStatus::Success(); }
	if (Entry.Sizes.StructureBytes + GetScratchGrowth(Entry.Sizes.BuildScratchBytes) <= GetRoom()) { return Admit(Entry); }
	Refuse(Entry, Room);
	return FRTStatus::Success();
}

bool FGeometryStore::IsWorthAnother(const FEntry& Entry, uint64_t Room) const
{
	const bool bFits = Entry.Sizes.StructureBytes + GetScratchGrowth(Entry.Sizes.BuildScratchBytes) <= Room;
	return bFits || (CanCoarsen(Entry) && Room / 2 > std::max(Entry.RefusedRoom, ScratchStep));
}

void FGeometryStore::ReconsiderRefused()
{
	if (Refused.empty()) { return; }
	const uint64_t Room = GetRoom();
	std::erase_if(Refused, [&](FSlotRef Ref) {
		FEntry* const Entry = Resolve(Ref);
		if (!Entry || Entry->State != EState::Refused) { return true; }
		if (!IsWorthAnother(*Entry, Room)) { return false; }
		Queue(*Entry);
		return true;
	});
}

} // namespace Lantern
