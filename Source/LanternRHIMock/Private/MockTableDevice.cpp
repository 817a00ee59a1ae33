// FMockShaderTable: the device's side: executed updates, and what a ray reaches.

#include "MockShaderTable.h"
#include "MockTableHandle.h"

#include <algorithm>
#include <cstring>

namespace Lantern
{

FRTStatus FMockShaderTable::TakeUpdate(FUpdate& Out)
{
	UpdatedBytes = 0;
	FRTStatus Status = Stage();
	if (!Status) { return Status; }
	Out.Source = std::move(Staged);
	Out.Ranges = std::move(StagedRanges);
	Staged.reset();
	StagedRanges.clear();
	for (const FRange& Range : Out.Ranges) { Out.Bytes += Range.Count * Records.GetLayout().Strides[Range.Kind]; }
	Out.Pipeline = Pipeline;
	if (Next)
	{
		for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind) { Out.MovedBytes += Current->Layout.GetRegionBytes(Kind); }
		Out.From = std::move(Current);
		Current = std::move(Next);
		Next.reset();
	}
	Out.To = Current;
	UpdatedBytes = Out.Bytes;
	return Status;
}

void FMockShaderTable::Execute(const FUpdate& Update)
{
	{
		std::lock_guard Lock(DeviceMutex);
		FMockDeviceCopy& To = *Update.To;
		if (Update.From)
		{
			const FMockDeviceCopy& From = *Update.From;
			for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind)
			{
				std::memcpy(To.Bytes + To.Layout.Offsets[Kind], From.Bytes + From.Layout.Offsets[Kind], From.Layout.GetRegionBytes(Kind));
			}
			++Moves;
		}
		for (const FRange& Range : Update.Ranges)
		{
			const uint64_t Offset = To.Layout.GetOffset(Range.Kind, Range.First);
			std::memcpy(To.Bytes + Offset, Update.Source->Bytes + Offset, Range.Count * To.Layout.Strides[Range.Kind]);
		}
		To.Pipeline = Update.Pipeline->Id;
		To.Groups = Update.Pipeline->Groups;
		To.bUpdated = true;
		Executed = Update.To;
	}
	std::lock_guard Lock(State->Mutex);
	State->Traffic.Table += Update.Bytes;
	State->Traffic.TableMoved += Update.MovedBytes;
}

std::string FMockShaderTable::CheckTrace(const FMockDeviceCopy& Copy, uint64_t PipelineId) const
{
	std::lock_guard Lock(DeviceMutex);
	if (!Copy.bUpdated) { return Name + ": rays traced before any UpdateShaderTable"; }
	return Copy.Pipeline == PipelineId ? std::string()
	                                   : Name + ": rays traced after SetPipeline, before an UpdateShaderTable with its handles";
}

FRTMockTable FMockShaderTable::Inspect() const
{
	FRTMockTable Table;
	Table.HostCopies = static_cast<uint32_t>(Ring.size());
	Table.HostCopiesMade = CopiesMade;
	for (const auto& Copy : Ring)
	{
		Table.HostCopiesInUse += Copy->Users.load() ? 1 : 0;
		Table.HostBytes += Copy->Size;
	}
	std::lock_guard Lock(DeviceMutex);
	Table.Moves = Moves;
	return Table;
}

FRTMockRecord FMockShaderTable::Resolve(ERTRecordKind Kind, uint32_t Index) const
{
	const auto Which = static_cast<uint32_t>(Kind);
	FRTMockRecord Record;
	Record.Index = Index;
	FMockHandle Handle;
	FMockGroups Groups;
	uint64_t Expected = 0;
	{
		std::lock_guard Lock(DeviceMutex);
		const FTableLayout& There = Executed->Layout;
		Record.bInRange = Index < There.Counts[Which];
		if (!Record.bInRange)
		{
			Record.Error = Name + ": record " + std::to_string(Index) + " of " + std::to_string(There.Counts[Which]);
			return Record;
		}
		const uint8_t* At = Executed->Bytes + There.GetOffset(Which, Index);
		std::memcpy(&Handle, At, sizeof(Handle));
		if (Kind == ERTRecordKind::Hit)
		{
			const uint8_t* Data = At + State->Desc.HandleSize;
			Record.Data.assign(Data, Data + Desc.RecordDataBytes);
		}
		Groups = Executed->Groups;
		Expected = Executed->Pipeline;
	}
	if (!Handle.IsGood())
	{
		Record.bNull = true;
		Record.Error = Name + ": record " + std::to_string(Index) + " has no handle on the device";
		return Record;
	}
	Record.Group = Handle.Group;
	{
		std::lock_guard Lock(State->Mutex);
		const auto Found = State->Pipelines.find(Handle.Pipeline);
		Record.bStale = Handle.Pipeline != Expected || Found == State->Pipelines.end();
		Record.Pipeline = Found == State->Pipelines.end() ? "?" : Found->second;
	}
	if (Record.bStale)
	{
		Record.Error = Name + ": record " + std::to_string(Index) + " has a handle of pipeline " + Record.Pipeline;
		return Record;
	}
	const FMockGroup& Group = (*Groups)[Handle.Group];
	Record.General = Group.General;
	Record.ClosestHit = Group.ClosestHit;
	Record.AnyHit = Group.AnyHit;
	Record.Intersection = Group.Intersection;
	return Record;
}

} // namespace Lantern
