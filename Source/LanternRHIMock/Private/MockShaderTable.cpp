// Records, their layout and the host's side of an update.

#include "MockShaderTable.h"
#include "LanternRHI/RTText.h"

#include "MockTableHandle.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <tuple>

namespace Lantern
{
namespace
{

constexpr uint32_t HitKind = static_cast<uint32_t>(ERTRecordKind::Hit);
constexpr uint32_t WordBits = 64;

constexpr uint32_t CountWords(uint32_t Records) { return (Records + WordBits - 1) / WordBits; }

} // namespace

void FMockTableLayout::Arrange(uint32_t BaseAlignment)
{
	Size = 0;
	for (uint32_t Kind = 0; Kind < RecordKinds; ++Kind)
	{
		Starts[Kind] = AlignUp(Size, BaseAlignment);
		Size = Starts[Kind] + Strides[Kind] * Counts[Kind];
	}
}

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
	const FRTMockDesc& Limits = State->Desc;
	const uint64_t Plain = AlignUp(Limits.HandleSize, Limits.HandleAlignment);
	// Each ray generation record is a region of its own when rays are traced, so it starts at the base alignment.
	Layout.Strides = {AlignUp(Limits.HandleSize, std::max(Limits.BaseAlignment, Limits.HandleAlignment)), Plain,
	    AlignUp(Limits.HandleSize + Desc.RecordDataBytes, Limits.HandleAlignment), Plain};
	SetCounts({Desc.RayGenCount, Desc.MissCount, Desc.HitCount, Desc.CallableCount});
}

FRTStatus FMockShaderTable::Allocate()
{
	Current = Executed = std::make_shared<FMockDeviceCopy>(State);
	Current->Layout = Layout;
	FRTStatus Status = Current->Allocate(Layout.Size, Name);
	std::shared_ptr<FMockHostCopy> Copy;
	for (uint32_t i = 0; Status && i < std::max(1u, Desc.Copies); ++i) { Status = AddHostCopy(Copy, false); }
	return Status;
}

void FMockShaderTable::SetCounts(const std::array<uint32_t, RecordKinds>& Counts)
{
	for (uint32_t Kind = 0; Kind < RecordKinds; ++Kind)
	{
		const uint32_t Old = CountWords(Layout.Counts[Kind]), New = CountWords(Counts[Kind]);
		Records[Kind].resize(Layout.Strides[Kind] * Counts[Kind]);
		if (New == Old) { continue; }
		FDirtyWords Words = std::make_unique<std::atomic<uint64_t>[]>(New);
		for (uint32_t Word = 0; Word < Old; ++Word) { Words[Word] = Dirty[Kind][Word].load(); }
		Dirty[Kind] = std::move(Words);
	}
	Layout.Counts = Counts;
	Layout.Arrange(State->Desc.BaseAlignment);
	std::tie(Desc.RayGenCount, Desc.MissCount, Desc.HitCount, Desc.CallableCount) = std::tie(Counts[0], Counts[1], Counts[2], Counts[3]);
}

void FMockShaderTable::WriteHandle(uint8_t* Record, uint32_t Group) const
{
	assert(Group < Pipeline->GetGroupCount());
	const FMockHandle Handle(Pipeline->Id, Group);
	std::memset(Record, 0, State->Desc.HandleSize);
	std::memcpy(Record, &Handle, sizeof(Handle));
}

void FMockShaderTable::MarkDirty(uint32_t Kind, uint32_t First, uint32_t Count)
{
	for (uint32_t At = First; At < First + Count;)
	{
		const uint32_t Bit = At % WordBits;
		const uint32_t Run = std::min(WordBits - Bit, First + Count - At);
		const uint64_t Mask = (Run == WordBits ? ~uint64_t(0) : (uint64_t(1) << Run) - 1) << Bit;
		std::atomic<uint64_t>& Word = Dirty[Kind][At / WordBits];
		if ((Word.load(std::memory_order_relaxed) & Mask) != Mask) { Word.fetch_or(Mask, std::memory_order_relaxed); }
		At += Run;
	}
	if (Count && !bDirty[Kind].load(std::memory_order_relaxed)) { bDirty[Kind].store(true, std::memory_order_relaxed); }
}

void FMockShaderTable::SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data, uint32_t DataBytes)
{
	const auto Which = static_cast<uint32_t>(Kind);
	assert(Index < Layout.Counts[Which]);
	assert(DataBytes <= (Kind == ERTRecordKind::Hit ? Desc.RecordDataBytes : 0));
	uint8_t* Record = GetRecord(Which, Index);
	WriteHandle(Record, Group);
	std::memset(Record + State->Desc.HandleSize, 0, Layout.Strides[Which] - State->Desc.HandleSize);
	if (Data && DataBytes) { std::memcpy(Record + State->Desc.HandleSize, Data, DataBytes); }
	MarkDirty(Which, Index, 1);
}

void FMockShaderTable::SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data)
{
	assert(First <= Desc.HitCount && Count <= Desc.HitCount - First);
	const uint32_t DataBytes = Desc.RecordDataBytes;
	for (uint32_t i = 0; i < Count; ++i)
	{
		uint8_t* Record = GetRecord(HitKind, First + i);
		WriteHandle(Record, Groups[i]);
		if (Data && DataBytes)
		{
			std::memcpy(
			    Record + State->Desc.HandleSize, static_cast<const uint8_t*>(Data) + static_cast<uint64_t>(i) * DataBytes, DataBytes);
		}
		else { std::memset(Record + State->Desc.HandleSize, 0, DataBytes); }
	}
	MarkDirty(HitKind, First, Count);
}

void FMockShaderTable::SetGroups(ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups)
{
	const auto Which = static_cast<uint32_t>(Kind);
	assert(First <= Layout.Counts[Which] && Count <= Layout.Counts[Which] - First);
	for (uint32_t i = 0; i < Count; ++i) { WriteHandle(GetRecord(Which, First + i), Groups[i]); }
	MarkDirty(Which, First, Count);
}

void FMockShaderTable::SetPipeline(IRTPipeline* InPipeline)
{
	auto* Mine = static_cast<FMockPipeline*>(InPipeline);
	assert(Mine && Mine->Kind == EMockPipeline::RayTracing);
	(void)State->Log(ERTMockCall::SetTablePipeline, Name); // a lost device is seen at the next call that can say so
	if (Mine->bLibrary) { State->AddError(Name + ": SetPipeline of the library " + Mine->Name); }
	Pipeline = TRTRef<FMockPipeline>(Mine);
	Desc.Pipeline = InPipeline;
}

FRTStatus FMockShaderTable::Reserve(const uint32_t Counts[4])
{
	std::array<uint32_t, RecordKinds> Grown = Layout.Counts;
	for (uint32_t Kind = 0; Kind < RecordKinds; ++Kind) { Grown[Kind] = std::max(Grown[Kind], Counts[Kind]); }
	if (Grown == Layout.Counts) { return FRTStatus::Success(); }
	FRTStatus Status = State->Log(ERTMockCall::ReserveShaderTable, Name, {Grown[0], Grown[1], Grown[2], Grown[3]});
	if (!Status) { return Status; }
	auto Copy = std::make_shared<FMockDeviceCopy>(State);
	Copy->Layout = Layout;
	Copy->Layout.Counts = Grown;
	Copy->Layout.Arrange(State->Desc.BaseAlignment);
	Status = Copy->Allocate(Copy->Layout.Size, Name);
	if (!Status) { return Status; }
	Unstage();
	SetCounts(Grown);
	Next = std::move(Copy);
	return Status;
}

FRTStatus FMockShaderTable::AddHostCopy(std::shared_ptr<FMockHostCopy>& Out, bool bCount)
{
	auto Copy = std::make_shared<FMockHostCopy>(State);
	FRTStatus Status = Copy->Allocate(Layout.Size, Name, bCount);
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
	// Too small since the table grew; those in use go once they are not.
	std::erase_if(Ring, [&](const auto& Copy) { return IsFree(Copy) && Copy->Size < Layout.Size; });
	const auto Found = std::find_if(Ring.begin(), Ring.end(), [&](const auto& Copy) { return IsFree(Copy) && Copy->Size >= Layout.Size; });
	std::shared_ptr<FMockHostCopy> Copy;
	FRTStatus Status;
	if (Found != Ring.end()) { Copy = *Found; }
	else
	{
		Status = State->Log(ERTMockCall::MakeHostCopy, Name, {Layout.Size});
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
	if (std::none_of(bDirty.begin(), bDirty.end(), [](const std::atomic<bool>& Kind) { return Kind.load(); }))
	{
		return FRTStatus::Success();
	}
	FRTStatus Status;
	if (!Staged) { Status = AcquireHostCopy(Staged); }
	if (!Status) { return Status; }
	Gather();
	MergeStaged();
	uint64_t Bytes = 0;
	for (const FRange& Range : StagedRanges) { Bytes += Range.Count * Layout.Strides[Range.Kind]; }
	return State->Log(ERTMockCall::StageShaderTable, Name, {Bytes});
}

void FMockShaderTable::Gather()
{
	for (uint32_t Kind = 0; Kind < RecordKinds; ++Kind)
	{
		if (!bDirty[Kind].exchange(false)) { continue; }
		const uint64_t Stride = Layout.Strides[Kind];
		for (uint32_t At = 0; At < CountWords(Layout.Counts[Kind]); ++At)
		{
			uint64_t Word = Dirty[Kind][At].exchange(0, std::memory_order_relaxed);
			while (Word)
			{
				const auto Bit = static_cast<uint32_t>(std::countr_zero(Word));
				const auto Run = static_cast<uint32_t>(std::countr_one(Word >> Bit));
				const uint32_t First = At * WordBits + Bit;
				std::memcpy(Staged->Bytes + Layout.GetOffset(Kind, First), GetRecord(Kind, First), Run * Stride);
				StagedRanges.push_back({Kind, First, Run});
				Word = Bit + Run >= WordBits ? 0 : Word >> (Bit + Run) << (Bit + Run);
			}
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
	for (const FRange& Range : StagedRanges) { MarkDirty(Range.Kind, Range.First, Range.Count); }
	StagedRanges.clear();
	Staged.reset();
}

void FMockShaderTable::Invalidate()
{
	Unstage();
	for (uint32_t Kind = 0; Kind < RecordKinds; ++Kind) { MarkDirty(Kind, 0, Layout.Counts[Kind]); }
}

} // namespace Lantern
