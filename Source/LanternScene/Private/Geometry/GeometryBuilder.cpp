// FGeometryBuilder: structures, scratch and commands of a frame's builds and refits.
#include "Geometry/GeometryBuilder.h"

#include <algorithm>

#include "LanternScene/Memory/Upload.h"

namespace Lantern
{

namespace
{
// A batch takes what fits into this much scratch, and at least one build.
constexpr uint64_t BatchScratchBytes = 32ull << 20;

uint64_t AlignUp(uint64_t Value, uint64_t Alignment) { return (Value + Alignment - 1) / Alignment * Alignment; }

uint64_t GetScratchAlignment(IRTDevice& Device) { return std::max(1u, Device.GetCapabilities().ScratchAlignment); }
} // namespace

FGeometryBuilder::FGeometryBuilder(FGeometryContext& InContext, FGeometryCompactor& InCompactor, FGeometryRefits& InRefits)
    : Context(InContext),
      Compactor(InCompactor),
      Refits(InRefits)
{}

void FGeometryBuilder::AddRefit(FGeometryEntry& Entry)
{
	Context.Slots.Hold(Entry);
	Builds.push_back(Context.Slots.MakeRef(Entry));
}

FRTStatus FGeometryBuilder::AddBuild(FGeometryEntry& Entry)
{
	if (FRTStatus S = Context.Scratch.Grow(Entry.Sizes.BuildScratchBytes); !S) { return S; }
	if (!Entry.Geometry->GetStructure())
	{
		const std::vector<FRTGeometrySection> Sections = MakeStructureSections(*Entry.Geometry);
		const FRTGeometryDesc Desc = Entry.MakeDesc(Sections);
		Entry.bCompactable = Desc.bAllowCompaction;
		TRTRef<IRTGeometry> Structure;
		if (FRTStatus S = Context.Device.CreateGeometry(Desc, Structure.ReleaseAndGetAddress()); !S) { return S; }
		Entry.Sizes = Structure->GetBuildSizes();
		Entry.SetStructure(std::move(Structure));
	}
	AddRefit(Entry);
	Entry.State = EGeometryState::Building;
	Entry.bUpdate = Entry.bLost = Entry.bDeformed = false;
	Entry.Misfits = Entry.Waits = 0;
	Entry.SetBuilt(true);
	Context.Slots.SetAddress(Entry, Entry.Geometry->GetStructure()->GetDeviceAddress());
	++Context.Stats.Built;
	Context.Stats.TrianglesBuilt += Entry.Triangles;
	Context.Memory.UpdatePeak();
	return FRTStatus::Success();
}

uint64_t FGeometryBuilder::GetScratchBytes(const FGeometryEntry& Entry) const
{
	return Entry.bUpdate ? Entry.Sizes.UpdateScratchBytes : Entry.Sizes.BuildScratchBytes;
}

FRTStatus FGeometryBuilder::GrowForBatches()
{
	const uint64_t Alignment = GetScratchAlignment(Context.Device);
	uint64_t Sum = 0;
	for (const FGeometrySlotRef Ref : Builds) { Sum += AlignUp(GetScratchBytes(Context.Slots[Ref.Slot]), Alignment); }
	Sum = std::min(Sum, BatchScratchBytes);
	if (Sum == 0 || Context.Scratch.GetGrowth(Sum) > Context.Memory.GetRoom() / 4) { return FRTStatus::Success(); }
	const FRTStatus Status = Context.Scratch.Grow(Sum);
	return Status.Code == ERTResult::OutOfDeviceMemory ? FRTStatus::Success() : Status;
}

void FGeometryBuilder::RecordStaging(IRTCommandList& List) const
{
	for (const FGeometrySlotRef Ref : Builds)
	{
		const FGeometryEntry& Entry = Context.Slots[Ref.Slot];
		if (!Entry.Staging) { continue; }
		IRTBuffer* const Indices = Entry.Geometry->GetIndices();
		const FRTBarrier Before{Indices, nullptr, ERTAccess::None, ERTAccess::CopyWrite};
		const FRTBarrier After{Indices, nullptr, ERTAccess::CopyWrite, UploadedAccess};
		List.Barriers(&Before, 1);
		List.CopyBuffer(Indices, 0, Entry.Staging.Get(), 0, Entry.Staging->GetDesc().Size);
		List.Barriers(&After, 1);
	}
}

uint32_t FGeometryBuilder::Plan(uint32_t MostParts)
{
	const uint64_t Alignment = GetScratchAlignment(Context.Device);
	PlannedScratch = TRTRef<IRTBuffer>(Context.Scratch.Get());
	ScratchOffsets.assign(Builds.size(), 0);
	Parts.clear();
	const size_t PerPart = std::max<size_t>(FewestPerPart, (Builds.size() + MostParts - 1) / std::max(1u, MostParts));
	uint64_t Used = 0;
	for (size_t Index = 0; Index < Builds.size(); ++Index)
	{
		const uint64_t Bytes = GetScratchBytes(Context.Slots[Builds[Index].Slot]);
		const bool bNewBatch = Index > 0 && Used + Bytes > PlannedScratch->GetDesc().Size;
		if (bNewBatch)
		{
			Parts.back().bEndsBatch = true;
			Used = 0;
		}
		if (Parts.empty() || bNewBatch || Parts.back().End - Parts.back().First == PerPart) { Parts.push_back({Index, Index}); }
		Parts.back().End = Index + 1;
		ScratchOffsets[Index] = Used;
		Used = AlignUp(Used + Bytes, Alignment);
	}
	if (!Parts.empty()) { Parts.back().bEndsBatch = true; }
	return static_cast<uint32_t>(Parts.size());
}

void FGeometryBuilder::RecordPart(IRTCommandList& List, uint32_t PartIndex) const
{
	const FPart& Part = Parts[PartIndex];
	std::vector<std::vector<FRTGeometrySection>> Sections;
	std::vector<FRTGeometryBuild> Batch;
	for (size_t Index = Part.First; Index < Part.End; ++Index)
	{
		const FGeometryEntry& Entry = Context.Slots[Builds[Index].Slot];
		FRTGeometryBuild& Build = Batch.emplace_back();
		Sections.push_back(MakeStructureSections(*Entry.Geometry));
		Build.Geometry = Entry.Geometry->GetStructure();
		Build.Sections = Sections.back().data(); // moving the outer vector moves no sections
		Build.SectionCount = static_cast<uint32_t>(Sections.back().size());
		Build.bUpdate = Entry.bUpdate;
		Build.Scratch = PlannedScratch.Get();
		Build.ScratchOffset = ScratchOffsets[Index];
	}
	List.BuildGeometries(Batch.data(), static_cast<uint32_t>(Batch.size()));
	const FRTBarrier Behind{nullptr, nullptr, ERTAccess::BuildWrite, ERTAccess::BuildWrite | ERTAccess::BuildRead};
	if (Part.bEndsBatch) { List.Barriers(&Behind, 1); }
}

void FGeometryBuilder::Submitted()
{
	for (const FGeometrySlotRef Ref : Builds)
	{
		FGeometryEntry& Entry = Context.Slots[Ref.Slot];
		// The next frame asks for the size: a query in this one could be recorded before the tasks have recorded the build.
		if (Entry.State == EGeometryState::Building && Entry.bCompactable) { Compactor.Want(Entry); }
		Entry.State = EGeometryState::Built;
		Entry.Staging = nullptr;
		Entry.bRebuild = false;
		Entry.RefitsSinceBuild = Entry.bUpdate ? Entry.RefitsSinceBuild + 1 : 0;
		if (!Entry.bUpdate)
		{
			Entry.RefitRatio = 1.0f;
			++Entry.Builds;
		}
	}
	Builds.clear();
	PlannedScratch = nullptr;
}

void FGeometryBuilder::Lost()
{
	for (const FGeometrySlotRef Ref : Builds)
	{
		FGeometryEntry& Entry = Context.Slots[Ref.Slot];
		if (Entry.State == EGeometryState::Building)
		{
			Entry.bLost = true;
			Entry.Compaction = EGeometryCompaction::None;
			Entry.SetBuilt(false);
			Context.Slots.SetAddress(Entry, 0);
			Context.Queue.Add(Entry);
			continue;
		}
		Entry.bRebuild |= !Entry.bUpdate;
		Refits.Add(Entry);
	}
	Builds.clear();
	PlannedScratch = nullptr;
}

} // namespace Lantern
