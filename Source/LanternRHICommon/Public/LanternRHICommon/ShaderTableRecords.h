// The CPU's side of a shader binding table: what an implementation of IRTShaderTable keeps before it reaches the GPU.
#pragma once

#include "LanternRHICommon/HandleStore.h"
#include "LanternRHICommon/TableLayout.h"
#include "LanternRHICommon/TableRecords.h"

#include <algorithm>
#include <cassert>

namespace Lantern
{

/// Records of all four kinds, the handles that they name, and the layout for which they are meant.
/// Threads: as IRTShaderTable's: the Set… calls may run at once for different records; everything else excludes them.
class FShaderTableRecords
{
public:
	/// Records are zeros and clean at first. Call SetPipeline before the Set… calls for records.
	void Initialise(const FRTCapabilities& Capabilities, const FRTShaderTableDesc& Desc, EHandleUpdates HandleUpdates);
	/// Handles: of the pipeline's groups, ShaderGroupHandleSize bytes each. Groups that are set from now on are of these.
	void SetPipeline(const uint8_t* Handles, uint32_t GroupCount);
	/// Counts: GrowRecordCounts of what there is. New records are zeros and clean.
	void Grow(const FRecordCounts& Counts);

	// As the calls of IRTShaderTable. Inline: a frame may set hundreds of thousands of records.
	void SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data, uint32_t DataBytes)
	{
		assert(Group < Handles.GetGroupCount());
		Of(Kind).SetOne(Index, Handles.GetSlotsOfGroups()[Group], Data, DataBytes);
	}
	void SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data)
	{
		assert(AreGroups(Count, Groups));
		Of(ERTRecordKind::Hit).Set(First, Count, Handles.GetSlotsOfGroups(), Groups, Data);
	}
	void SetGroups(ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups)
	{
		assert(AreGroups(Count, Groups));
		Of(Kind).SetHandles(First, Count, Handles.GetSlotsOfGroups(), Groups);
	}

	bool IsDirty() const;
	void MarkAllDirty();

	const FTableLayout& GetLayout() const { return Layout; }
	const FHandleStore& GetHandles() const { return Handles; }
	FTableRecords& Of(ERTRecordKind Kind) { return Records[static_cast<uint32_t>(Kind)]; }
	/// Kind: an ERTRecordKind.
	FTableRecords& operator[](uint32_t Kind) { return Records[Kind]; }
	const FTableRecords& operator[](uint32_t Kind) const { return Records[Kind]; }
	/// Writes Run of a kind, a stride for each record.
	void CopyTo(uint8_t* Dest, uint32_t Kind, FTableRecords::FRun Run) const { Records[Kind].CopyTo(Dest, Run, Handles.GetHandles()); }

private:
	void PruneHandles();
	bool AreGroups(uint32_t Count, const uint32_t* Groups) const
	{
		return std::all_of(Groups, Groups + Count, [&](uint32_t Group) { return Group < Handles.GetGroupCount(); });
	}

	FTableLayout Layout;
	FHandleStore Handles; ///< of the pipeline, and of those before that records still name
	std::array<FTableRecords, RecordKindCount> Records;
};

} // namespace Lantern
