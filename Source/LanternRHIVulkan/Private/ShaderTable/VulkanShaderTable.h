// The shader binding table: records on the CPU, host copies of what is new, and the table on the GPU.
#pragma once

#include "Commands/VulkanScatter.h"
#include "LanternRHICommon/ShaderTableRecords.h"
#include "Pipelines/VulkanPipeline.h"
#include "Resources/VulkanBuffer.h"

namespace Lantern
{

class FVulkanShaderTable final : public TVulkanObject<IRTShaderTable>
{
public:
	using TVulkanObject::TVulkanObject;
	FRTStatus Initialise(const FRTShaderTableDesc& InDesc);

	const FRTShaderTableDesc& GetDesc() const override { return Desc; }
	void SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data, uint32_t DataBytes) override;
	void SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data) override;
	void SetGroups(ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups) override;
	void SetPipeline(IRTPipeline* InPipeline) override;
	FRTStatus Reserve(const uint32_t Counts[4]) override;
	FRTStatus Stage() override;
	void Invalidate() override;
	uint64_t GetRecordStride(ERTRecordKind Kind) const override { return Records.GetLayout().Strides[static_cast<uint32_t>(Kind)]; }
	uint64_t GetSizeBytes() const override { return Newest().Buffer->Size; }
	uint64_t GetUpdatedBytes() const override { return UpdatedBytes; }

	struct FCopies
	{
		TRTRef<FVulkanKeptBlock> Source;
		std::vector<VkBufferCopy> Regions;
		std::vector<FVulkanScatter::FPush> Scatters;
	};
	struct FFill
	{
		uint64_t Offset = 0;
		uint64_t Size = 0;
	};
	/// What the GPU has to do, in this order: zeros, what moves from the old device table, then each of Copies.
	struct FUpdate
	{
		FVulkanKeptBlock* Dest = nullptr;
		std::vector<FFill> Zeros;
		FCopies Moved;
		std::vector<FCopies> Copies;

		bool IsEmpty() const { return Zeros.empty() && !Moved.Source && Copies.empty(); }
	};
	/// Stages the rest and takes all that is staged, which counts as copied from here on. On error nothing has been taken.
	FRTStatus TakeUpdate(FUpdate& Out);
	/// Returns the device's copy as of the last update.
	FVulkanKeptBlock* GetBuffer() const { return Current.Buffer.Get(); }
	/// RayGen: index of the one record in the region, if Kind is ray generation.
	VkStridedDeviceAddressRegionKHR GetRegion(ERTRecordKind Kind, uint32_t RayGen) const;

private:
	using FRun = FTableRecords::FRun;

	struct FDeviceTable
	{
		TRTRef<FVulkanKeptBlock> Buffer;
		FTableLayout Layout;
	};
	/// Records of one kind in a host copy, one after another. If they are scattered, their indices stand behind them.
	struct FPart
	{
		std::vector<FRun> Runs;
		uint32_t Count = 0; ///< records
		bool bScatter = false;
		uint64_t Offset = 0;
		uint64_t IndexOffset = 0;
	};
	/// Hit records whose handles alone are new. A host copy has the numbers of the handles, and behind them the handles.
	struct FHandlePart
	{
		std::vector<FRun> Runs;
		uint32_t Count = 0; ///< records
		uint64_t SlotOffset = 0;
		uint64_t HandleOffset = 0;
	};
	/// A filled host copy.
	struct FBatch
	{
		TRTRef<FVulkanKeptBlock> Source;
		FPart Parts[RecordKindCount];
		FHandlePart HitHandles;
	};
	struct FHostCopy
	{
		TRTRef<FVulkanKeptBlock> Buffer;
		uint64_t LastUse = 0; ///< StageCount at that time
	};

	const FDeviceTable& Newest() const { return Next.Buffer ? Next : Current; }
	FRTStatus MakeDeviceTable(const FRecordCounts& Counts, FDeviceTable& Out);
	FRTStatus MakeBuffer(uint64_t Size, VkBufferUsageFlags Usage, ERTMemory Memory, const char* Suffix, TRTRef<FVulkanKeptBlock>& Out);
	void Fill(const FBatch& Batch) const;
	void ReturnBatches();
	/// Finds a free host copy of at least Size bytes; makes one if all are in use.
	FRTStatus FindHostCopy(uint64_t Size, TRTRef<FVulkanKeptBlock>& Out);
	void DropIdleHostCopies();
	void AddMove(FUpdate& Out);
	void AddPart(const FBatch& Batch, uint32_t Kind, FCopies& Out);
	void AddHandles(const FBatch& Batch, FCopies& Out);
	void TakeDirtyHandles(FBatch& Batch, uint64_t& InOutBytes);
	void FillHandles(const FBatch& Batch) const;

	FRTShaderTableDesc Desc;
	std::string Name;
	TRTRef<FVulkanPipeline> Pipeline;
	FShaderTableRecords Records;
	FDeviceTable Current;      ///< of the last update
	FDeviceTable Next;         ///< of the next update, if the table has grown
	bool bCurrentUsed = false; ///< an update has gone into Current
	bool bContentLost = false; ///< everything is dirty: nothing need move or be filled with zeros
	std::vector<FBatch> Batches;
	std::vector<FHostCopy> HostCopies;
	uint64_t StageCount = 0;
	uint64_t UpdatedBytes = 0;
};

} // namespace Lantern
