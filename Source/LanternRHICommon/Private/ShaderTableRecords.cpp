// FShaderTableRecords: records of all kinds on the CPU, with the handles that they name.
#include "LanternRHICommon/ShaderTableRecords.h"

namespace Lantern
{

void FShaderTableRecords::Initialise(const FRTCapabilities& Capabilities, const FRTShaderTableDesc& Desc, EHandleUpdates HandleUpdates)
{
	Layout = FTableLayout(Capabilities, Desc);
	Handles.Initialise(Capabilities.ShaderGroupHandleSize);
	for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind)
	{
		assert(Layout.Strides[Kind] <= Capabilities.MaxShaderGroupStride);
		const bool bHit = Kind == static_cast<uint32_t>(ERTRecordKind::Hit);
		Records[Kind].Initialise(Layout.Strides[Kind], Capabilities.ShaderGroupHandleSize, bHit ? Desc.RecordDataBytes : 0, HandleUpdates);
		Records[Kind].Grow(Layout.Counts[Kind]);
	}
}

void FShaderTableRecords::SetPipeline(const uint8_t* InHandles, uint32_t GroupCount)
{
	Handles.SetPipeline(InHandles, GroupCount);
	if (Handles.IsCrowded()) { PruneHandles(); }
}

void FShaderTableRecords::PruneHandles()
{
	std::vector<bool> Used(Handles.GetCount(), false);
	for (const FTableRecords& Kind : Records) { Kind.MarkUsed(Used); }
	const std::vector<uint32_t> NewOf = Handles.Prune(Used);
	for (FTableRecords& Kind : Records) { Kind.Renumber(NewOf); }
}

void FShaderTableRecords::Grow(const FRecordCounts& Counts)
{
	for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind)
	{
		assert(Counts[Kind] >= Layout.Counts[Kind]);
		Records[Kind].Grow(Counts[Kind]);
	}
	Layout.SetCounts(Counts);
}

bool FShaderTableRecords::IsDirty() const
{
	return std::any_of(Records.begin(), Records.end(), [](const FTableRecords& Kind) { return Kind.IsDirty(); });
}

void FShaderTableRecords::MarkAllDirty()
{
	for (FTableRecords& Kind : Records) { Kind.MarkDirty({0, Kind.GetCount()}); }
}

} // namespace Lantern
