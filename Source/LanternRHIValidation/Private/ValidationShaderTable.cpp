// FValidatedShaderTable: records, groups, growth and the swap of the pipeline.
#include "ValidationObjects.h"

#include <algorithm>

namespace Lantern
{
namespace
{

constexpr const char* KindNames[] = {"ray generation", "miss", "hit", "callable"};

/// Returns why the group may not stand behind a record of this kind; empty if it may.
std::string CheckGroupKind(ERTRecordKind Kind, const FValidatedGroup& Group)
{
	const bool bHit = Kind == ERTRecordKind::Hit;
	if (bHit) { return Group.Kind == ERTGroupKind::General ? "is a general group, not a hit group" : ""; }
	if (Group.Kind != ERTGroupKind::General) { return "is a hit group"; }
	const ERTShaderStage Wanted = Kind == ERTRecordKind::RayGen ? ERTShaderStage::RayGen
	                              : Kind == ERTRecordKind::Miss ? ERTShaderStage::Miss
	                                                            : ERTShaderStage::Callable;
	return Group.GeneralStage == Wanted ? "" : "has a shader of another stage";
}

constexpr uint32_t Exclusive = 65536;

} // namespace

FValidatedShaderTable::FUse::FUse(FValidatedShaderTable& InTable, const char* Call, bool bSets)
    : Table(InTable),
      Count(bSets ? 1 : Exclusive)
{
	const uint32_t Before = Table.Users.fetch_add(Count);
	if (Before && (!bSets || Before >= Exclusive))
	{
		Table.State->Report(std::string(Call) + ": " + Table.Label + " is in use by another thread");
	}
}

FValidatedShaderTable::FValidatedShaderTable(std::shared_ptr<FValidationState> InState, TRTRef<IRTShaderTable> InInner,
    const FRTShaderTableDesc& InDesc, FValidatedPipeline* InPipeline)
    : TValidated(std::move(InState), MakeLabel("shader table", InDesc.Name), InInner),
      Pipeline(InPipeline),
      Track(std::make_shared<FTableTrack>())
{
	Track->Label = Label;
	ResizeTracks();
}

void FValidatedShaderTable::ResizeTracks()
{
	Desc = Inner->GetDesc();
	Desc.Pipeline = Pipeline.Get();
	const FRecordCounts Counts = GetRecordCounts(Desc);
	std::lock_guard Lock(State->Mutex);
	for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind)
	{
		if (Track->Records[Kind].GetCount() != Counts[Kind]) { Track->Records[Kind].Resize(Counts[Kind]); }
	}
	Track->RayGen.resize(Desc.RayGenCount);
}

std::string FValidatedShaderTable::Describe(const char* Call, ERTRecordKind Kind, uint32_t Index) const
{
	return std::string(Call) + ": " + Label + Print(": %s record %u", KindNames[static_cast<size_t>(Kind)], Index);
}

bool FValidatedShaderTable::CheckRecords(const char* Call, ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups) const
{
	const uint32_t Most = Track->Records[static_cast<size_t>(Kind)].GetCount();
	if (!IsInside(First, Count, Most))
	{
		State->Report(Describe(Call, Kind, Count ? First + Count - 1 : First) + Print(" is out of range, the table has %u", Most));
		return false;
	}
	if (Count && !Groups)
	{
		State->Report(Describe(Call, Kind, First) + ": Groups is null");
		return false;
	}
	for (uint32_t i = 0; i < Count; ++i)
	{
		const uint32_t Group = Groups[i];
		if (Group >= Pipeline->Groups.size())
		{
			State->Report(Describe(Call, Kind, First + i) +
			              Print(": group %u, but %s has %zu", Group, Pipeline->Label.c_str(), Pipeline->Groups.size()));
			return false;
		}
		const std::string Mismatch = CheckGroupKind(Kind, Pipeline->Groups[Group]);
		if (!Mismatch.empty())
		{
			State->Report(Describe(Call, Kind, First + i) + Print(": group %u of %s %s", Group, Pipeline->Label.c_str(), Mismatch.c_str()));
			return false;
		}
	}
	return true;
}

void FValidatedShaderTable::MarkSet(ERTRecordKind Kind, uint32_t First, uint32_t Count)
{
	const uint32_t Generation = Track->Generation;
	for (uint32_t i = First; i < First + Count; ++i) { Track->Records[static_cast<size_t>(Kind)].Set(i, Generation); }
	if (Kind == ERTRecordKind::RayGen)
	{
		std::lock_guard Lock(State->Mutex);
		std::fill_n(Track->RayGen.begin() + First, Count, ERecordState::Set);
	}
}

void FValidatedShaderTable::SetRecord(ERTRecordKind Kind, uint32_t Index, uint32_t Group, const void* Data, uint32_t DataBytes)
{
	const FUse Use(*this, "SetRecord", true);
	if (!CheckRecords("SetRecord", Kind, Index, 1, &Group)) { return; }
	const uint32_t Most = Kind == ERTRecordKind::Hit ? Desc.RecordDataBytes : 0;
	if (DataBytes > Most)
	{
		return State->Report(Describe("SetRecord", Kind, Index) + Print(": %u bytes of data, at most %u", DataBytes, Most));
	}
	Inner->SetRecord(Kind, Index, Group, Data, DataBytes);
	MarkSet(Kind, Index, 1);
}

void FValidatedShaderTable::SetHitRecords(uint32_t First, uint32_t Count, const uint32_t* Groups, const void* Data)
{
	const FUse Use(*this, "SetHitRecords", true);
	if (CheckRecords("SetHitRecords", ERTRecordKind::Hit, First, Count, Groups))
	{
		Inner->SetHitRecords(First, Count, Groups, Data);
		MarkSet(ERTRecordKind::Hit, First, Count);
	}
}

void FValidatedShaderTable::SetGroups(ERTRecordKind Kind, uint32_t First, uint32_t Count, const uint32_t* Groups)
{
	const FUse Use(*this, "SetGroups", true);
	if (CheckRecords("SetGroups", Kind, First, Count, Groups))
	{
		Inner->SetGroups(Kind, First, Count, Groups);
		MarkSet(Kind, First, Count);
	}
}

void FValidatedShaderTable::SetPipeline(IRTPipeline* InPipeline)
{
	const FUse Use(*this, "SetPipeline", false);
	const std::string What = "SetPipeline: " + Label;
	auto* Mine = State->Require<FValidatedPipeline>(InPipeline, What + ": Pipeline");
	if (!Mine) { return; }
	if (Mine->PipelineKind != EPipelineKind::RayTracing) { return State->Report(What + ": " + Mine->Label + " is not for ray tracing"); }
	if (Mine->bLibrary) { return State->Report(What + ": " + Mine->Label + " is a library: link it first"); }
	Inner->SetPipeline(Mine->Inner.Get());
	if (Mine != Pipeline.Get()) { ++Track->Generation; }
	Pipeline = TRTRef<FValidatedPipeline>(Mine);
	Desc.Pipeline = Mine;
}

FRTStatus FValidatedShaderTable::Reserve(const uint32_t Counts[4])
{
	const FUse Use(*this, "Reserve", false);
	if (!Counts) { return State->Fail("Reserve: " + Label + ": Counts is null"); }
	FRTStatus Status = Inner->Reserve(Counts);
	if (Status) { ResizeTracks(); }
	return Status;
}

FRTStatus FValidatedShaderTable::Stage()
{
	const FUse Use(*this, "Stage", false);
	return Inner->Stage();
}

void FValidatedShaderTable::Invalidate()
{
	const FUse Use(*this, "Invalidate", false);
	Inner->Invalidate();
}

} // namespace Lantern
