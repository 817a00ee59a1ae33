// The shader binding table of the mock: records on the CPU, a ring of host copies, and what the device holds.
#pragma once

#include "LanternRHICommon/ShaderTableRecords.h"
#include "MockObjects.h"

#include <atomic>

namespace Lantern
{

/// Memory of one copy. It counts as the device's until its last owner lets go.
class FMockTableMemory
{
public:
	explicit FMockTableMemory(std::shared_ptr<FMockState> InState) : State(std::move(InState)) {}
	~FMockTableMemory();
	FMockTableMemory(const FMockTableMemory&) = delete;
	FMockTableMemory& operator=(const FMockTableMemory&) = delete;
	FRTStatus Allocate(uint64_t Bytes, const std::string& Name, bool bCount = true);

	uint8_t* Bytes = nullptr;
	uint64_t Size = 0;

private:
	std::shared_ptr<FMockState> State;
};

struct FMockHostCopy : FMockTableMemory
{
	using FMockTableMemory::FMockTableMemory;
	std::atomic<uint32_t> Users = 0; ///< staged, recorded or in flight
};

/// The table on the device, as executed updates left it. Guarded by FMockShaderTable::DeviceMutex.
struct FMockDeviceCopy : FMockTableMemory
{
	using FMockTableMemory::FMockTableMemory;
	FTableLayout Layout;
	uint64_t Pipeline = 0; ///< id of the pipeline of the last update
	FMockGroups Groups;    ///< of that pipeline
	bool bUpdated = false;
};

class FMockShaderTable final : public TMockObject<IRTShaderTable>
{
public:
	FMockShaderTable(std::shared_ptr<FMockState> InState, const FRTShaderTableDesc& InDesc);
	/// Allocates the copies that a new table has.
	FRTStatus Allocate();

	const FRTShaderTableDesc& GetDesc() const override { return Desc; }
	void SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data, uint32_t DataBytes) override;
	void SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data) override;
	void SetGroups(ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups) override;
	void SetPipeline(IRTPipeline* InPipeline) override;
	FRTStatus Reserve(const uint32_t Counts[4]) override;
	FRTStatus Stage() override;
	void Invalidate() override;
	uint64_t GetRecordStride(ERTRecordKind Kind) const override { return Records.GetLayout().Strides[static_cast<uint32_t>(Kind)]; }
	uint64_t GetSizeBytes() const override { return Records.GetLayout().Size; }
	uint64_t GetUpdatedBytes() const override { return UpdatedBytes; }

	struct FRange
	{
		uint32_t Kind = 0, First = 0, Count = 0;
	};
	/// What one recorded UpdateShaderTable does. It reads the host copy when it executes.
	struct FUpdate
	{
		std::shared_ptr<FMockHostCopy> Source; ///< in use until the last update with it is gone
		std::vector<FRange> Ranges;
		std::shared_ptr<FMockDeviceCopy> From; ///< null if nothing moves
		std::shared_ptr<FMockDeviceCopy> To;
		TRTRef<FMockPipeline> Pipeline;
		uint64_t Bytes = 0, MovedBytes = 0;
	};
	/// Stages the rest and takes all that is staged. On error nothing has changed.
	FRTStatus TakeUpdate(FUpdate& Out);
	void Execute(const FUpdate& Update);
	/// Returns why rays with the pipeline of this id may not be traced with this copy; empty if they may.
	std::string CheckTrace(const FMockDeviceCopy& Copy, uint64_t PipelineId) const;
	const std::shared_ptr<FMockDeviceCopy>& GetDeviceCopy() const { return Current; }
	FRTMockRecord Resolve(ERTRecordKind Kind, uint32_t Index) const;
	FRTMockTable Inspect() const;

	FRTShaderTableDesc Desc;
	TRTRef<FMockPipeline> Pipeline;

private:
	/// Moves the dirty records into Staged.
	void Gather();
	void MergeStaged();
	/// Makes what is staged dirty again: its copy will not be recorded.
	void Unstage();
	FRTStatus AcquireHostCopy(std::shared_ptr<FMockHostCopy>& OutUse);
	FRTStatus AddHostCopy(std::shared_ptr<FMockHostCopy>& Out, bool bCount);

	FShaderTableRecords Records;
	uint64_t UpdatedBytes = 0;

	std::vector<std::shared_ptr<FMockHostCopy>> Ring;
	std::shared_ptr<FMockHostCopy> Staged;
	std::vector<FRange> StagedRanges;
	uint32_t CopiesMade = 0;

	std::shared_ptr<FMockDeviceCopy> Current; ///< for what is recorded now
	std::shared_ptr<FMockDeviceCopy> Next;    ///< after Reserve, for what is recorded from the next update on

	mutable std::mutex DeviceMutex; ///< of everything below and of the contents of device copies
	std::shared_ptr<FMockDeviceCopy> Executed;
	uint32_t Moves = 0;
};

} // namespace Lantern
