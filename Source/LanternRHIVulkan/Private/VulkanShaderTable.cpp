#include "VulkanShaderTable.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

namespace Lantern
{

namespace
{

constexpr uint32_t WordBits = 64;

constexpr uint64_t AlignUp(uint64_t Value, uint64_t Alignment)
{
	return (Value + Alignment - 1) / Alignment * Alignment;
}

} // namespace

FRTStatus FVulkanShaderTable::Initialise(const FRTShaderTableDesc& InDesc)
{
	Desc = InDesc;
	Name = InDesc.Name ? InDesc.Name : "";
	Desc.Name = Name.c_str();
	assert(Desc.Pipeline && Desc.Pipeline->GetGroupCount() > 0 && Desc.RecordDataBytes <= MaxRecordDataBytes);
	Pipeline = TRTRef<FVulkanPipeline>(static_cast<FVulkanPipeline*>(Desc.Pipeline));

	const FRTCapabilities& Caps = Device.GetCapabilities();
	const uint64_t Handle = AlignUp(Caps.ShaderGroupHandleSize, Caps.ShaderGroupHandleAlignment);
	// A dispatch names one ray generation record as a region of its own: each starts at the base alignment.
	const uint64_t Strides[KindCount] = {
	    AlignUp(Caps.ShaderGroupHandleSize, Caps.ShaderGroupBaseAlignment), Handle,
	    AlignUp(Caps.ShaderGroupHandleSize + Desc.RecordDataBytes, Caps.ShaderGroupHandleAlignment), Handle};
	const uint32_t Counts[KindCount] = {Desc.RayGenCount, Desc.MissCount, Desc.HitCount, Desc.CallableCount};
	uint64_t Size = 0;
	for (uint32_t Kind = 0; Kind < KindCount; ++Kind)
	{
		FRegion& Region = Regions[Kind];
		Region.Offset = AlignUp(Size, Caps.ShaderGroupBaseAlignment);
		Region.Stride = Strides[Kind];
		Region.Count = Counts[Kind];
		assert(Region.Stride <= Caps.MaxShaderGroupStride);
		Size = Region.Offset + Region.Stride * Region.Count;
		const uint32_t Words = (Region.Count + WordBits - 1) / WordBits;
		Region.Dirty = std::make_unique<std::atomic<uint64_t>[]>(Words);
		for (uint32_t Word = 0; Word < Words; ++Word)
		{
			// Never-written records are zeros on the GPU too, which is a record without shaders.
			const uint32_t Left = Region.Count - Word * WordBits;
			Region.Dirty[Word] = Left >= WordBits ? ~uint64_t(0) : (uint64_t(1) << Left) - 1;
		}
	}
	Records.assign(std::max<uint64_t>(Size, 1), 0);
	const VkBufferUsageFlags Usage = VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
	return Block.Create(Device, Records.size(), Usage, ERTMemory::Device, Caps.ShaderGroupBaseAlignment,
	                    EVulkanMemoryKind::ShaderTable, Desc.Name);
}

void FVulkanShaderTable::SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data,
                                   uint32_t DataBytes)
{
	FRegion& Region = Of(Kind);
	assert(Index < Region.Count);
	assert(DataBytes <= (Kind == ERTRecordKind::Hit ? Desc.RecordDataBytes : 0));
	const uint32_t HandleSize = Device.GetCapabilities().ShaderGroupHandleSize;
	uint8_t* Record = Records.data() + Region.Offset + Region.Stride * Index;
	memcpy(Record, Pipeline->GetGroupHandle(Group), HandleSize);
	const uint32_t DataRoom = Kind == ERTRecordKind::Hit ? Desc.RecordDataBytes : 0;
	const uint32_t Given = Data ? DataBytes : 0;
	if (Given)
	{
		memcpy(Record + HandleSize, Data, Given);
	}
	memset(Record + HandleSize + Given, 0, DataRoom - Given);
	std::atomic<uint64_t>& Word = Region.Dirty[Index / WordBits];
	const uint64_t Bit = uint64_t(1) << (Index % WordBits);
	if (!(Word.load(std::memory_order_relaxed) & Bit))
	{
		Word.fetch_or(Bit, std::memory_order_relaxed);
	}
}

void FVulkanShaderTable::TakeDirty(std::vector<FRange>& Out)
{
	Out.clear();
	for (FRegion& Region : Regions)
	{
		for (uint32_t First = 0; First < Region.Count; First += WordBits)
		{
			uint64_t Word = Region.Dirty[First / WordBits].exchange(0, std::memory_order_relaxed);
			while (Word)
			{
				const uint32_t Begin = static_cast<uint32_t>(std::countr_zero(Word));
				const uint32_t Run = static_cast<uint32_t>(std::countr_one(Word >> Begin));
				const FRange Range = {Region.Offset + Region.Stride * (First + Begin), Region.Stride * Run};
				if (!Out.empty() && Out.back().Offset + Out.back().Size == Range.Offset)
				{
					Out.back().Size += Range.Size;
				}
				else
				{
					Out.push_back(Range);
				}
				Word = Begin + Run >= WordBits ? 0 : Word >> (Begin + Run) << (Begin + Run);
			}
		}
	}
}

VkStridedDeviceAddressRegionKHR FVulkanShaderTable::GetRegion(ERTRecordKind Kind, uint32_t RayGen) const
{
	const FRegion& Region = Of(Kind);
	if (Region.Count == 0)
	{
		return {};
	}
	if (Kind == ERTRecordKind::RayGen)
	{
		assert(RayGen < Region.Count);
		return {Block.Address + Region.Offset + Region.Stride * RayGen, Region.Stride, Region.Stride};
	}
	return {Block.Address + Region.Offset, Region.Stride, Region.Stride * Region.Count};
}

} // namespace Lantern
