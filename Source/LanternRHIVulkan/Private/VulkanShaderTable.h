// The shader binding table: a copy on the CPU, one on the GPU, and a bit per record that differs between them.
#pragma once

#include "VulkanBuffer.h"
#include "VulkanPipeline.h"

#include <memory>

namespace Lantern
{

class FVulkanShaderTable final : public TVulkanObject<IRTShaderTable>
{
public:
	using TVulkanObject::TVulkanObject;
	FRTStatus Initialise(const FRTShaderTableDesc& InDesc);

	const FRTShaderTableDesc& GetDesc() const override { return Desc; }
	/// Different records may be set from several threads; not while UpdateShaderTable records this table.
	void SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data, uint32_t DataBytes) override;
	void SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data) override
	{
		for (uint32_t Index = 0; Index < Count; ++Index)
		{
			SetRecord(ERTRecordKind::Hit, First + Index, Groups[Index],
			          Data ? static_cast<const uint8_t*>(Data) + uint64_t(Index) * Desc.RecordDataBytes : nullptr,
			          Desc.RecordDataBytes);
		}
	}
	void SetGroups(ERTRecordKind, uint32_t, uint32_t, const uint32_t*) override {}
	void SetPipeline(IRTPipeline*) override {}
	FRTStatus Reserve(const uint32_t*) override
	{
		return FRTStatus::Error(ERTResult::Unsupported, "Shader tables do not grow yet");
	}
	FRTStatus Stage() override { return {}; }
	void Invalidate() override {}
	uint64_t GetUpdatedBytes() const override { return 0; }
	uint64_t GetRecordStride(ERTRecordKind Kind) const override { return Of(Kind).Stride; }
	uint64_t GetSizeBytes() const override { return Records.size(); }

	struct FRange
	{
		uint64_t Offset = 0;
		uint64_t Size = 0;
	};
	/// The bytes that the GPU has not got yet, in order; they count as copied from here on.
	void TakeDirty(std::vector<FRange>& Out);
	const uint8_t* GetRecords() const { return Records.data(); }
	VkBuffer GetBuffer() const { return Block.Handle; }
	/// RayGen: the region of one record.
	VkStridedDeviceAddressRegionKHR GetRegion(ERTRecordKind Kind, uint32_t RayGen) const;

private:
	static constexpr uint32_t KindCount = 4;
	struct FRegion
	{
		uint64_t Offset = 0;
		uint64_t Stride = 0;
		uint32_t Count = 0;
		std::unique_ptr<std::atomic<uint64_t>[]> Dirty;
	};
	FRegion& Of(ERTRecordKind Kind) { return Regions[static_cast<uint32_t>(Kind)]; }
	const FRegion& Of(ERTRecordKind Kind) const { return Regions[static_cast<uint32_t>(Kind)]; }

	FRTShaderTableDesc Desc;
	std::string Name;
	TRTRef<FVulkanPipeline> Pipeline;
	FRegion Regions[KindCount];
	std::vector<uint8_t> Records;
	FVulkanBlock Block;
};

} // namespace Lantern
