// FVulkanShaderTable: growth, staging, and what an update does on the GPU.
#include "ShaderTable/VulkanShaderTable.h"

#include <algorithm>
#include <cassert>

namespace Lantern
{

namespace
{

constexpr VkBufferUsageFlags HostUsage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
constexpr uint64_t MinHostCopyBytes = 64 * 1024;
/// If more batches are staged than this, they are gathered into one.
constexpr size_t MaxBatches = 4;
/// A host copy gives its memory back if so many stagings did not use it.
constexpr uint64_t IdleStagings = 64;

} // namespace

// ------------------------------------------------------------------------------------------------ creation, growth

FRTStatus FVulkanShaderTable::Initialise(const FRTShaderTableDesc& InDesc)
{
	Desc = InDesc;
	Name = InDesc.Name ? InDesc.Name : "";
	Desc.Name = Name.c_str();
	assert(Desc.Pipeline && Desc.RecordDataBytes <= MaxRecordDataBytes && Desc.Copies >= 1);
	Records.Initialise(Device.GetCapabilities(), Desc, EHandleUpdates::Apart);
	SetPipeline(Desc.Pipeline);
	FRTStatus Status = MakeDeviceTable(GetRecordCounts(Desc), Current);
	for (uint32_t Copy = 0; Status && Copy < Desc.Copies; ++Copy)
	{
		FHostCopy Made;
		Status = MakeBuffer(std::min(MinHostCopyBytes, Current.Buffer->Size), HostUsage, ERTMemory::Upload, " (host)", Made.Buffer);
		HostCopies.push_back(std::move(Made));
	}
	return Status;
}

FRTStatus FVulkanShaderTable::MakeBuffer(
    uint64_t Size, VkBufferUsageFlags Usage, ERTMemory Memory, const char* Suffix, TRTRef<FVulkanKeptBlock>& Out)
{
	TRTRef<FVulkanKeptBlock> Made = MakeVulkanObject<FVulkanKeptBlock>(Device);
	Made->Size = Size;
	const uint64_t Alignment = Memory == ERTMemory::Device ? Device.GetCapabilities().ShaderGroupBaseAlignment : 16;
	FRTStatus Status = Made->Block.Create(Device, Size, Usage, Memory, Alignment, EVulkanMemoryKind::ShaderTable, (Name + Suffix).c_str());
	if (Status) { Out = std::move(Made); }
	return Status;
}

FRTStatus FVulkanShaderTable::MakeDeviceTable(const FRecordCounts& Counts, FDeviceTable& Out)
{
	FDeviceTable Made;
	Made.Layout = Records.GetLayout();
	Made.Layout.SetCounts(Counts);
	const VkBufferUsageFlags Usage = VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
	                                 VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
	FRTStatus Status = MakeBuffer(std::max(Made.Layout.Size, Made.Layout.BaseAlignment), Usage, ERTMemory::Device, "", Made.Buffer);
	if (Status) { Out = std::move(Made); }
	return Status;
}

FRTStatus FVulkanShaderTable::Reserve(const uint32_t Counts[4])
{
	const FRecordCounts Before = Records.GetLayout().Counts;
	const FRecordCounts Grown = GrowRecordCounts(Before, Counts);
	if (Grown == Before) { return {}; }
	// If no update has gone into Next yet, the contents still come from Current.
	FRTStatus Status = MakeDeviceTable(Grown, bCurrentUsed ? Next : Current);
	if (!Status) { return Status; }
	Records.Grow(Grown);
	for (uint32_t Kind = 0; bContentLost && Kind < RecordKindCount; ++Kind)
	{
		Records[Kind].MarkDirty({Before[Kind], Grown[Kind] - Before[Kind]});
	}
	SetRecordCounts(Desc, Grown);
	return Status;
}

// ------------------------------------------------------------------------------------------------ records

void FVulkanShaderTable::SetPipeline(IRTPipeline* InPipeline)
{
	assert(InPipeline);
	Desc.Pipeline = InPipeline;
	Pipeline = TRTRef<FVulkanPipeline>(static_cast<FVulkanPipeline*>(InPipeline));
	assert(Pipeline->GetGroupHandles() && "a ray-tracing pipeline that is no library");
	Records.SetPipeline(Pipeline->GetGroupHandles(), Pipeline->GetGroupCount());
}

void FVulkanShaderTable::SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data, uint32_t DataBytes)
{
	Records.SetRecord(Kind, Index, Group, Data, DataBytes);
}

void FVulkanShaderTable::SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data)
{
	Records.SetHitRecords(First, Count, Groups, Data);
}

void FVulkanShaderTable::SetGroups(ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups)
{
	Records.SetGroups(Kind, First, Count, Groups);
}

void FVulkanShaderTable::Invalidate()
{
	Batches.clear();
	Records.MarkAllDirty();
	bContentLost = true;
}

// ------------------------------------------------------------------------------------------------ staging

void FVulkanShaderTable::ReturnBatches()
{
	for (const FBatch& Batch : Batches)
	{
		for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind)
		{
			for (const FRun& Run : Batch.Parts[Kind].Runs) { Records[Kind].MarkDirty(Run); }
		}
		for (const FRun& Run : Batch.HitHandles.Runs) { Records.Of(ERTRecordKind::Hit).MarkDirty(Run); }
	}
	Batches.clear();
}

FRTStatus FVulkanShaderTable::Stage()
{
	if (!Records.IsDirty()) { return {}; }
	if (Batches.size() >= MaxBatches) { ReturnBatches(); }
	FBatch Batch;
	uint64_t Bytes = 0;
	TakeDirtyHandles(Batch, Bytes);
	for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind)
	{
		FPart& Part = Batch.Parts[Kind];
		Records[Kind].TakeDirty(Part.Runs);
		Part.Count = static_cast<uint32_t>(FTableRecords::CountRecords(Part.Runs));
		Part.Offset = Bytes;
		Bytes += Records[Kind].GetStride() * Part.Count;
		Part.bScatter = Part.Runs.size() > FVulkanScatter::MostCopies;
		Part.IndexOffset = Bytes;
		Bytes += Part.bScatter ? sizeof(uint32_t) * Part.Count : 0;
	}
	FRTStatus Status = FindHostCopy(Bytes, Batch.Source);
	Batches.push_back(std::move(Batch));
	if (!Status)
	{
		ReturnBatches(); // what was not staged must stay dirty
		return Status;
	}
	Fill(Batches.back());
	FillHandles(Batches.back());
	return Status;
}

void FVulkanShaderTable::Fill(const FBatch& Batch) const
{
	uint8_t* Begin = static_cast<uint8_t*>(Batch.Source->Block.Allocation.Mapped);
	for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind)
	{
		const FPart& Part = Batch.Parts[Kind];
		uint8_t* Dest = Begin + Part.Offset;
		uint32_t* Index = reinterpret_cast<uint32_t*>(Begin + Part.IndexOffset);
		for (const FRun& Run : Part.Runs)
		{
			Records.CopyTo(Dest, Kind, Run);
			Dest += Records[Kind].GetStride() * Run.Count;
			for (uint32_t Record = 0; Part.bScatter && Record < Run.Count; ++Record) { *Index++ = Run.First + Record; }
		}
	}
}

FRTStatus FVulkanShaderTable::FindHostCopy(uint64_t Size, TRTRef<FVulkanKeptBlock>& Out)
{
	++StageCount;
	DropIdleHostCopies();
	// Takes the smallest free host copy that is large enough; if there is none, the largest free one grows.
	const auto Find = [&]() -> FHostCopy* {
		FHostCopy* Best = nullptr;
		for (FHostCopy& Copy : HostCopies)
		{
			if (Copy.Buffer->GetReferences() > 1) { continue; }
			const uint64_t Has = Copy.Buffer->Size;
			const uint64_t BestHas = Best ? Best->Buffer->Size : 0;
			const bool bBetter = Has >= Size ? BestHas < Size || Has < BestHas : BestHas < Size && Has > BestHas;
			Best = !Best || bBetter ? &Copy : Best;
		}
		return Best;
	};
	FHostCopy* Copy = Find();
	if (!Copy)
	{
		Device.CollectGarbage(); // the GPU may be done with one
		Copy = Find();
	}
	if (!Copy || Copy->Buffer->Size < Size)
	{
		TRTRef<FVulkanKeptBlock> Made;
		const uint64_t Bytes = std::max(Size + Size / 4, std::min(MinHostCopyBytes, Newest().Buffer->Size));
		FRTStatus Status = MakeBuffer(Bytes, HostUsage, ERTMemory::Upload, " (host)", Made);
		if (!Status) { return Status; }
		Copy = Copy ? Copy : &HostCopies.emplace_back();
		Copy->Buffer = std::move(Made);
	}
	Copy->LastUse = StageCount;
	Out = Copy->Buffer;
	return {};
}

void FVulkanShaderTable::DropIdleHostCopies()
{
	const auto IsIdle = [&](const FHostCopy& Copy) {
		const bool bSpare = Copy.Buffer->Size > MinHostCopyBytes || HostCopies.size() > Desc.Copies;
		return bSpare && StageCount - Copy.LastUse > IdleStagings && Copy.Buffer->GetReferences() == 1;
	};
	const auto Idle = std::find_if(HostCopies.begin(), HostCopies.end(), IsIdle);
	if (Idle != HostCopies.end()) { HostCopies.erase(Idle); }
}

// ------------------------------------------------------------------------------------------------ the GPU's side

void FVulkanShaderTable::AddMove(FUpdate& Out)
{
	const FDeviceTable& To = Newest();
	const bool bMoves = bCurrentUsed && Next.Buffer;
	if (bContentLost || (bCurrentUsed && !bMoves)) { return; }
	for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind)
	{
		const uint64_t Stride = Records[Kind].GetStride();
		const uint64_t Old = bMoves ? Stride * Current.Layout.Counts[Kind] : 0;
		const uint64_t All = Stride * To.Layout.Counts[Kind];
		if (Old > 0)
		{
			Out.Moved.Source = Current.Buffer;
			Out.Moved.Regions.push_back({Current.Layout.Offsets[Kind], To.Layout.Offsets[Kind], Old});
		}
		if (All > Old) { Out.Zeros.push_back({To.Layout.Offsets[Kind] + Old, All - Old}); }
	}
}

void FVulkanShaderTable::AddPart(const FBatch& Batch, uint32_t Kind, FCopies& Out)
{
	const FPart& Part = Batch.Parts[Kind];
	const uint64_t Stride = Records[Kind].GetStride();
	UpdatedBytes += Stride * Part.Count;
	if (Part.bScatter)
	{
		const VkDeviceAddress From = Batch.Source->Block.Address;
		assert(Stride % sizeof(uint32_t) == 0);
		Out.Scatters.push_back({Current.Buffer->Block.Address + Current.Layout.Offsets[Kind], From + Part.Offset, From + Part.IndexOffset,
		    static_cast<uint32_t>(Stride / sizeof(uint32_t)), Part.Count, static_cast<uint32_t>(Stride / sizeof(uint32_t)),
		    FVulkanScatter::EKind::Records});
		return;
	}
	uint64_t Offset = Part.Offset;
	for (const FRun& Run : Part.Runs)
	{
		Out.Regions.push_back({Offset, Current.Layout.Offsets[Kind] + Stride * Run.First, Stride * Run.Count});
		Offset += Stride * Run.Count;
	}
}

FRTStatus FVulkanShaderTable::TakeUpdate(FUpdate& Out)
{
	FRTStatus Status = Stage();
	if (!Status) { return Status; }
	AddMove(Out);
	if (Next.Buffer)
	{
		Current = std::move(Next);
		Next = {};
	}
	Out.Dest = Current.Buffer.Get();
	UpdatedBytes = 0;
	for (FBatch& Batch : Batches)
	{
		// Handles come first: a record that is also new as a whole then gets its own handle.
		if (Batch.HitHandles.Count > 0)
		{
			FCopies& OfHandles = Out.Copies.emplace_back();
			AddHandles(Batch, OfHandles);
			OfHandles.Source = Batch.Source;
		}
		FCopies& Copies = Out.Copies.emplace_back();
		for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind) { AddPart(Batch, Kind, Copies); }
		Copies.Source = std::move(Batch.Source);
	}
	Batches.clear();
	bCurrentUsed = true;
	bContentLost = false;
	return Status;
}

VkStridedDeviceAddressRegionKHR FVulkanShaderTable::GetRegion(ERTRecordKind Kind, uint32_t RayGen) const
{
	const uint32_t Index = static_cast<uint32_t>(Kind);
	const uint64_t Stride = Records[Index].GetStride();
	const uint32_t Count = Current.Layout.Counts[Index];
	const VkDeviceAddress Address = Current.Buffer->Block.Address + Current.Layout.Offsets[Index];
	if (Count == 0) { return {}; }
	if (Kind == ERTRecordKind::RayGen)
	{
		assert(RayGen < Count);
		return {Address + Stride * RayGen, Stride, Stride};
	}
	return {Address, Stride, Stride * Count};
}

} // namespace Lantern
