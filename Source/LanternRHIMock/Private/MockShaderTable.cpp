// FMockShaderTable: the host's side: records, growth and staging.

#include "MockShaderTable.h"
#include "LanternRHI/RTText.h"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace Lantern
{
FMockTableMemory::~FMockTableMemory()
{
	std::free(Bytes);
	if (Bytes) { State->FreeMemory(EMockMemory::ShaderTable, Size); }
}

FRTStatus FMockTableMemory::Allocate(uint64_t InSize, const std::string& Name, bool bCount)
{
	FRTStatus Status = State->Allocate(EMockMemory::ShaderTable, InSize, Name.c_str(), bCount);
	if (!Status) { return Status; }
	// calloc: pages that no record reaches cost nothing.
	Bytes = static_cast<uint8_t*>(std::calloc(1, std::max<uint64_t>(InSize, 1)));
	Size = InSize;
	if (!Bytes)
	{
		State->FreeMemory(EMockMemory::ShaderTable, InSize);
		return FRTStatus::Error(ERTResult::OutOfHostMemory, "%s: no host memory for %llu bytes", FRTShown(Name.c_str()).Text,
		    static_cast<unsigned long long>(InSize));
	}
	return Status;
}

FMockShaderTable::FMockShaderTable(std::shared_ptr<FMockState> InState, const FRTShaderTableDesc& InDesc)
    : TMockObject(std::move(InState), "ShaderTable", InDesc.Name),
      Desc(InDesc),
      Pipeline(static_cast<FMockPipeline*>(InDesc.Pipeline))
{
	Desc.Name = Name.c_str();
	Records.Initialise(State->Capabilities, Desc, EHandleUpdates::WithRecords);
	Records.SetPipeline(Pipeline->Handles.data(), Pipeline->GetGroupCount());
}

FRTStatus FMockShaderTable::Allocate()
{
	Current = Executed = std::make_shared<FMockDeviceCopy>(State);
	Current->Layout = Records.GetLayout();
	FRTStatus Status = Current->Allocate(Current->Layout.Size, Name);
	std::shared_ptr<FMockHostCopy> Copy;
	for (uint32_t i = 0; Status && i < std::max(1u, Desc.Copies); ++i) { Status = AddHostCopy(Copy, false); }
	return Status;
}

void FMockShaderTable::SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data, uint32_t DataBytes)
{
	Records.SetRecord(Kind, Index, Group, Data, DataBytes);
}

void FMockShaderTable::SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data)
{
	Records.SetHitRecords(First, Count, Groups, Data);
}

void FMockShaderTable::SetGroups(ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups)
{
	Records.SetGroups(Kind, First, Count, Groups);
}

void FMockShaderTable::SetPipeline(IRTPipeline* InPipeline)
{
	auto* Mine = static_cast<FMockPipeline*>(InPipeline);
	assert(Mine && Mine->Kind == EMockPipeline::RayTracing);
	(void)State->Log(ERTMockCall::SetTablePipeline, Name); // a lost device is seen at the next call that can say so
	if (Mine->bLibrary) { State->AddError(Name + ": SetPipeline of the library " + Mine->Name); }
	Pipeline = TRTRef<FMockPipeline>(Mine);
	Desc.Pipeline = InPipeline;
	Records.SetPipeline(Mine->Handles.data(), Mine->GetGroupCount());
}

FRTStatus FMockShaderTable::Reserve(const uint32_t Counts[4])
{
	const FRecordCounts Grown = GrowRecordCounts(Records.GetLayout().Counts, Counts);
	if (Grown == Records.GetLayout().Counts) { return FRTStatus::Success(); }
	FRTStatus Status = State->Log(ERTMockCall::ReserveShaderTable, Name, {Grown[0], Grown[1], Grown[2], Grown[3]});
	if (!Status) { return Status; }
	auto Copy = std::make_shared<FMockDeviceCopy>(State);
	Copy->Layout = Records.GetLayout();
	Copy->Layout.SetCounts(Grown);
	Status = Copy->Allocate(Copy->Layout.Size, Name);
	if (!Status) { return Status; }
	Unstage();
	Records.Grow(Grown);
	SetRecordCounts(Desc, Grown);
	Next = std::move(Copy);
	return Status;
}

FRTStatus FMockShaderTable::AddHostCopy(std::shared_ptr<FMockHostCopy>& Out, bool bCount)
{
	auto Copy = std::make_shared<FMockHostCopy>(State);
	FRTStatus Status = Copy->Allocate(GetSizeBytes(), Name, bCount);
	if (Status)
	{
		++CopiesMade;
		Ring.push_back(Copy);
		Out = std::move(Copy);
	}
	return Status;
}

FRTStatus FMockShaderTable::AcquireHostCopy(std::shared_ptr<FMockHostCopy>& OutUse)
{
	const auto IsFree = [](const auto& Copy) { return Copy->Users.load(std::memory_order_acquire) == 0; };
	// Copies from before a growth are too small. Those in use go later.
	std::erase_if(Ring, [&](const auto& Copy) { return IsFree(Copy) && Copy->Size < GetSizeBytes(); });
	const auto Found =
	    std::find_if(Ring.begin(), Ring.end(), [&](const auto& Copy) { return IsFree(Copy) && Copy->Size >= GetSizeBytes(); });
	std::shared_ptr<FMockHostCopy> Copy;
	FRTStatus Status;
	if (Found != Ring.end()) { Copy = *Found; }
	else
	{
		Status = State->Log(ERTMockCall::MakeHostCopy, Name, {GetSizeBytes()});
		Status = Status ? AddHostCopy(Copy, true) : Status;
	}
	if (Status)
	{
		++Copy->Users;
		OutUse = {Copy.get(), [Copy](FMockHostCopy* Used) { Used->Users.fetch_sub(1, std::memory_order_release); }};
	}
	return Status;
}

FRTStatus FMockShaderTable::Stage()
{
	if (!Records.IsDirty()) { return FRTStatus::Success(); }
	FRTStatus Status;
	if (!Staged) { Status = AcquireHostCopy(Staged); }
	if (!Status) { return Status; }
	Gather();
	MergeStaged();
	uint64_t Bytes = 0;
	for (const FRange& Range : StagedRanges) { Bytes += Range.Count * Records.GetLayout().Strides[Range.Kind]; }
	return State->Log(ERTMockCall::StageShaderTable, Name, {Bytes});
}

void FMockShaderTable::Gather()
{
	for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind)
	{
		std::vector<FTableRecords::FRun> Runs;
		Records[Kind].TakeDirty(Runs);
		for (const FTableRecords::FRun& Run : Runs)
		{
			Records.CopyTo(Staged->Bytes + Records.GetLayout().GetOffset(Kind, Run.First), Kind, Run);
			StagedRanges.push_back({Kind, Run.First, Run.Count});
		}
	}
}

void FMockShaderTable::MergeStaged()
{
	std::sort(StagedRanges.begin(), StagedRanges.end(),
	    [](const FRange& A, const FRange& B) { return std::tie(A.Kind, A.First) < std::tie(B.Kind, B.First); });
	size_t Kept = 0;
	for (const FRange Range : StagedRanges)
	{
		FRange* Last = Kept ? &StagedRanges[Kept - 1] : nullptr;
		if (Last && Last->Kind == Range.Kind && Range.First <= Last->First + Last->Count)
		{
			Last->Count = std::max(Last->First + Last->Count, Range.First + Range.Count) - Last->First;
			continue;
		}
		StagedRanges[Kept++] = Range;
	}
	StagedRanges.resize(Kept);
}

void FMockShaderTable::Unstage()
{
	for (const FRange& Range : StagedRanges) { Records[Range.Kind].MarkDirty({Range.First, Range.Count}); }
	StagedRanges.clear();
	Staged.reset();
}

void FMockShaderTable::Invalidate()
{
	Unstage();
	Records.MarkAllDirty();
}

} // namespace Lantern
