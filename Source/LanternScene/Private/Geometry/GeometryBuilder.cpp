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
	if (Entry.bCompactable) { Compactor.Want(Entry); }
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

void FGeometryBuilder::RecordStaging(IRTCommandList& List)
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

size_t FGeometryBuilder::RecordBatch(IRTCommandList& List, size_t Next)
{
	const uint64_t Alignment = GetScratchAlignment(Context.Device);
	IRTBuffer* const Scratch = Context.Scratch.Get();
	std::vector<std::vector<FRTGeometrySection>> Sections;
	std::vector<FRTGeometryBuild> Batch;
	uint64_t Used = 0;
	for (; Next < Builds.size(); ++Next)
	{
		const FGeometryEntry& Entry = Context.Slots[Builds[Next].Slot];
		const uint64_t Bytes = GetScratchBytes(Entry);
		if (!Batch.empty() && Used + Bytes > Scratch->GetDesc().Size) { break; }
		FRTGeometryBuild& Build = Batch.emplace_back();
		Sections.push_back(MakeStructureSections(*Entry.Geometry));
		Build.Geometry = Entry.Geometry->GetStructure();
		Build.Sections = Sections.back().data(); // moving the outer vector moves no sections
		Build.SectionCount = static_cast<uint32_t>(Sections.back().size());
		Build.bUpdate = Entry.bUpdate;
		Build.Scratch = Scratch;
		Build.ScratchOffset = Used;
		Used = AlignUp(Used + Bytes, Alignment);
	}
	List.BuildGeometries(Batch.data(), static_cast<uint32_t>(Batch.size()));
	return Next;
}

void FGeometryBuilder::RecordBuilds(IRTCommandList& List)
{
	const FRTBarrier Behind{nullptr, nullptr, ERTAccess::BuildWrite, ERTAccess::BuildWrite | ERTAccess::BuildRead};
	for (size_t Next = 0; Next < Builds.size();)
	{
		Next = RecordBatch(List, Next);
		List.Barriers(&Behind, 1);
	}
}

void FGeometryBuilder::Submitted()
{
	for (const FGeometrySlotRef Ref : Builds)
	{
		FGeometryEntry& Entry = Context.Slots[Ref.Slot];
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
}

} // namespace Lantern
