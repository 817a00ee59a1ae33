#include "MockObjects.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace Lantern
{
namespace
{

constexpr uint64_t HandleMagic = 0x454c444e41485452ull;

struct FMockHandle
{
	uint64_t Magic = HandleMagic;
	uint64_t Pipeline = 0;
	uint32_t Group = 0;
	uint32_t Check = 0; ///< so that record data read as a handle is not taken for one
};
static_assert(sizeof(FMockHandle) == 24, "must fit into the smallest handle, 32 bytes");

uint32_t GetCheck(const FMockHandle& Handle)
{
	return static_cast<uint32_t>(Handle.Pipeline * 2654435761u) ^ (Handle.Group * 40503u + 17u);
}

} // namespace

FMockShaderTable::FMockShaderTable(std::shared_ptr<FMockState> InState, const FRTShaderTableDesc& InDesc)
    : TMockObject(std::move(InState), "ShaderTable", InDesc.Name),
      Desc(InDesc),
      Pipeline(static_cast<FMockPipeline*>(InDesc.Pipeline))
{
	Desc.Name = Name.c_str();
	Layout();
	Host.resize(Size);
	Device.resize(Size);
}

void FMockShaderTable::Layout()
{
	Size = 0;
	const FRTMockDesc& Limits = State->Desc;
	for (uint32_t Kind = 0; Kind < RecordKinds; ++Kind)
	{
		const bool bHit = Kind == static_cast<uint32_t>(ERTRecordKind::Hit);
		// Each ray generation record is a region of its own when rays are traced, so it starts at the base alignment.
		const bool bRayGen = Kind == static_cast<uint32_t>(ERTRecordKind::RayGen);
		const uint64_t Bytes = Limits.HandleSize + (bHit ? Desc.RecordDataBytes : 0);
		const uint64_t Alignment =
		    bRayGen ? std::max(Limits.BaseAlignment, Limits.HandleAlignment) : Limits.HandleAlignment;
		Strides[Kind] = AlignUp(Bytes, Alignment);
		Starts[Kind] = AlignUp(Size, Limits.BaseAlignment);
		Size = Starts[Kind] + Strides[Kind] * GetCount(static_cast<ERTRecordKind>(Kind));
	}
}

void FMockShaderTable::SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data)
{
	for (uint32_t i = 0; i < Count; ++i)
	{
		const auto* Bytes = static_cast<const uint8_t*>(Data);
		SetRecord(ERTRecordKind::Hit, First + i, Groups[i], Bytes ? Bytes + i * Desc.RecordDataBytes : nullptr,
		          Bytes ? Desc.RecordDataBytes : 0);
	}
}

void FMockShaderTable::SetGroups(ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups)
{
	for (uint32_t i = 0; i < Count; ++i)
	{
		const uint64_t Offset =
		    Starts[static_cast<uint32_t>(Kind)] + (First + i) * Strides[static_cast<uint32_t>(Kind)];
		std::vector<uint8_t> Data(Host.begin() + Offset + State->Desc.HandleSize,
		                          Host.begin() + Offset + Strides[static_cast<uint32_t>(Kind)]);
		Data.resize(Kind == ERTRecordKind::Hit ? Desc.RecordDataBytes : 0);
		SetRecord(Kind, First + i, Groups[i], Data.data(), static_cast<uint32_t>(Data.size()));
	}
}

void FMockShaderTable::SetPipeline(IRTPipeline* InPipeline)
{
	Pipeline = TRTRef<FMockPipeline>(static_cast<FMockPipeline*>(InPipeline));
	Desc.Pipeline = InPipeline;
}

FRTStatus FMockShaderTable::Reserve(const uint32_t Counts[4])
{
	const auto OldStarts = Starts;
	const uint32_t Old[] = {Desc.RayGenCount, Desc.MissCount, Desc.HitCount, Desc.CallableCount};
	Desc.RayGenCount = std::max(Old[0], Counts[0]);
	Desc.MissCount = std::max(Old[1], Counts[1]);
	Desc.HitCount = std::max(Old[2], Counts[2]);
	Desc.CallableCount = std::max(Old[3], Counts[3]);
	Layout();
	for (std::vector<uint8_t>* Copy : {&Host, &Device})
	{
		std::vector<uint8_t> Grown(Size);
		for (uint32_t Kind = 0; Kind < RecordKinds; ++Kind)
		{
			std::copy_n(Copy->begin() + OldStarts[Kind], Old[Kind] * Strides[Kind], Grown.begin() + Starts[Kind]);
		}
		*Copy = std::move(Grown);
	}
	Invalidate();
	return FRTStatus::Success();
}

uint32_t FMockShaderTable::GetCount(ERTRecordKind Kind) const
{
	switch (Kind)
	{
	case ERTRecordKind::RayGen: return Desc.RayGenCount;
	case ERTRecordKind::Miss: return Desc.MissCount;
	case ERTRecordKind::Hit: return Desc.HitCount;
	case ERTRecordKind::Callable: return Desc.CallableCount;
	}
	return 0;
}

void FMockShaderTable::SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data,
                                 uint32_t DataBytes)
{
	assert(Index < GetCount(Kind) && Group < Pipeline->GetGroupCount());
	assert(DataBytes <= (Kind == ERTRecordKind::Hit ? Desc.RecordDataBytes : 0));
	std::lock_guard Lock(TableMutex);
	const uint64_t Stride = Strides[static_cast<uint32_t>(Kind)];
	const uint64_t Offset = Starts[static_cast<uint32_t>(Kind)] + Index * Stride;
	FMockHandle Handle;
	Handle.Pipeline = Pipeline->Id;
	Handle.Group = Group;
	Handle.Check = GetCheck(Handle);
	std::memset(Host.data() + Offset, 0, Stride);
	std::memcpy(Host.data() + Offset, &Handle, sizeof(Handle));
	if (Data && DataBytes)
	{
		std::memcpy(Host.data() + Offset + State->Desc.HandleSize, Data, DataBytes);
	}
	Dirty.emplace_back(Offset, Stride);
}

std::vector<FMockShaderTable::FUpdate> FMockShaderTable::TakeUpdates()
{
	std::lock_guard Lock(TableMutex);
	std::sort(Dirty.begin(), Dirty.end());
	std::vector<FUpdate> Updates;
	uint64_t End = 0;
	for (const auto& [Offset, Bytes] : Dirty)
	{
		if (Updates.empty() || Offset > End)
		{
			Updates.emplace_back();
			Updates.back().Offset = Offset;
			End = Offset;
		}
		if (Offset + Bytes <= End)
		{
			continue;
		}
		Updates.back().Bytes.insert(Updates.back().Bytes.end(), Host.begin() + End, Host.begin() + Offset + Bytes);
		End = Offset + Bytes;
	}
	Dirty.clear();
	UpdatedBytes = 0;
	for (const FUpdate& Update : Updates)
	{
		UpdatedBytes += Update.Bytes.size();
	}
	return Updates;
}

void FMockShaderTable::Apply(const std::vector<FUpdate>& Updates)
{
	std::lock_guard Lock(TableMutex);
	bUpdated = true;
	for (const FUpdate& Update : Updates)
	{
		std::memcpy(Device.data() + Update.Offset, Update.Bytes.data(), Update.Bytes.size());
	}
}

bool FMockShaderTable::IsUpdated() const
{
	std::lock_guard Lock(TableMutex);
	return bUpdated;
}

FRTMockRecord FMockShaderTable::Resolve(ERTRecordKind Kind, uint32_t Index) const
{
	FRTMockRecord Record;
	Record.Index = Index;
	Record.bInRange = Index < GetCount(Kind);
	if (!Record.bInRange)
	{
		Record.Error = Name + ": record " + std::to_string(Index) + " of " + std::to_string(GetCount(Kind));
		return Record;
	}
	FMockHandle Handle;
	{
		std::lock_guard Lock(TableMutex);
		const uint64_t Stride = Strides[static_cast<uint32_t>(Kind)];
		const uint8_t* At = Device.data() + Starts[static_cast<uint32_t>(Kind)] + Index * Stride;
		std::memcpy(&Handle, At, sizeof(Handle));
		if (Kind == ERTRecordKind::Hit)
		{
			const uint8_t* Data = At + State->Desc.HandleSize;
			Record.Data.assign(Data, Data + Desc.RecordDataBytes);
		}
	}
	if (Handle.Magic != HandleMagic || Handle.Check != GetCheck(Handle))
	{
		Record.bNull = true;
		Record.Error = Name + ": record " + std::to_string(Index) + " has no handle on the device";
		return Record;
	}
	Record.Group = Handle.Group;
	std::lock_guard Lock(State->Mutex);
	const auto Found = State->Pipelines.find(Handle.Pipeline);
	Record.Pipeline = Found == State->Pipelines.end() ? "?" : Found->second;
	Record.bStale = Handle.Pipeline != Pipeline->Id;
	if (Record.bStale)
	{
		Record.Error = Name + ": record " + std::to_string(Index) + " has a handle of pipeline " + Record.Pipeline;
		return Record;
	}
	const FMockGroup& Group = Pipeline->Groups[Handle.Group];
	Record.General = Group.General;
	Record.ClosestHit = Group.ClosestHit;
	Record.AnyHit = Group.AnyHit;
	Record.Intersection = Group.Intersection;
	return Record;
}

} // namespace Lantern
