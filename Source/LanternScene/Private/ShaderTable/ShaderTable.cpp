// FShaderTable: which records a frame writes, in batches and by tasks.
#include "LanternScene/ShaderTable/ShaderTable.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>
#include <utility>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Tasks/Tasks.h"
#include "LanternScene/Pipelines/RTPSO.h"
#include "LanternScene/ShaderTable/SectionTable.h"
#include "ShaderTable/FullRewrite.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarMode("r.RT.SBT.Mode", 1,
    "Selects which records of the shader table are written and copied in a frame. 0: all, a baseline. 1: those that changed.", {0, 1});

static_assert(sizeof(FSectionData) <= MaxRecordDataBytes);

/// Number of sections that is worth a task of its own.
constexpr size_t SectionGrain = 4096;

/// Collects records of consecutive sections, and writes them in batches that stay in the first-level cache.
class FRecordBatch
{
public:
	FRecordBatch(IRTShaderTable& InTable, const FSectionTable& InSections, const uint32_t* InGroups, uint32_t InRayTypes)
	    : Table(InTable),
	      Sections(InSections),
	      Programs(InSections.GetHitProgramIndex()),
	      GroupsOfPrograms(InGroups),
	      RayTypes(InRayTypes)
	{
		assert(RayTypes <= Capacity);
	}
	void Add(uint32_t Section)
	{
		if (Section != Next || Count + RayTypes > Capacity)
		{
			Flush();
			First = Section * RayTypes;
		}
		const uint32_t* const Source = GroupsOfPrograms + Programs.GetIndex(Section) * RayTypes;
		const FSectionData& OfSection = Sections.Get(Section);
		for (uint32_t Type = 0; Type < RayTypes; ++Type, ++Count)
		{
			Groups[Count] = Source[Type];
			Data[Count] = OfSection;
		}
		Next = Section + 1;
	}
	void Flush()
	{
		if (Count > 0) { Table.SetHitRecords(First, Count, Groups.data(), Data.data()); }
		Count = 0;
	}

private:
	static constexpr uint32_t Capacity = 256;
	IRTShaderTable& Table;
	const FSectionTable& Sections;
	const FHitProgramIndex& Programs;
	const uint32_t* GroupsOfPrograms;
	uint32_t RayTypes;
	uint32_t First = 0, Count = 0, Next = ~0u;
	std::array<uint32_t, Capacity> Groups;
	std::array<FSectionData, Capacity> Data;
};

uint32_t WithRoom(uint32_t Has, uint32_t Needed) { return Has >= Needed ? Has : Needed + Needed / 2; }
} // namespace

FRTStatus FShaderTable::Prepare(const FRTPSO& Pipeline, const FSectionTable& Sections)
{
	Stats = {};
	const bool bRewriteEachFrame = CVarMode.GetOnRenderThread() == 0;
	const bool bSameSections = BoundSections == Sections.GetIdentity() && RayTypes == Pipeline.GetRayTypeCount() && !bRewrite;
	const bool bSamePipeline = BoundPipeline == Pipeline.GetPipeline() && Table;
	if (bSameSections && bSamePipeline && !Sections.HasChanged(Seen) && !bRewriteEachFrame)
	{
		return bPending ? Table->Stage() : FRTStatus::Success();
	}
	bRewrite |= !bSameSections;
	if (FRTStatus S = Reserve(Pipeline, Sections); !S) { return S; }
	bPending = true;
	BoundSections = Sections.GetIdentity();
	RayTypes = Pipeline.GetRayTypeCount();
	if (!bSamePipeline)
	{
		Table->SetPipeline(Pipeline.GetPipeline());
		BoundPipeline = Pipeline.GetPipeline();
	}
	if (!bSamePipeline || bRewrite)
	{
		SetGeneralRecords(Pipeline);
		GroupsRevision = ~0ull;
	}
	std::vector<uint32_t> Changed = Sections.TakeChanged(Seen);
	LookUpGroups(Pipeline, Sections);
	if (bRewrite) { WriteAll(Sections); }
	else if (!bSamePipeline) { WriteHandles(Sections); }
	if (bRewrite || !bSamePipeline) { WriteHandlesBehind(Sections); }
	RecordsUsed = std::max(RecordsUsed, Sections.GetCapacity() * RayTypes);
	if (bRewriteEachFrame) { Stats.RecordsWritten += RewriteHitRecords(*Table, Pipeline, Sections); }
	else if (!bRewrite) { WriteChanged(Sections, std::move(Changed)); }
	bRewrite = false;
	return Table->Stage();
}

FRTStatus FShaderTable::Reserve(const FRTPSO& Pipeline, const FSectionTable& Sections)
{
	const uint32_t HitCount = std::max(1u, Sections.GetCapacity() * Pipeline.GetRayTypeCount());
	// A table cannot lose its callable records, and this pipeline has nothing to write to them.
	if (Table && Table->GetDesc().CallableCount > 0 && Pipeline.GetCallableCount() == 0) { Table.Reset(); }
	if (!Table)
	{
		FRTShaderTableDesc Desc;
		Desc.Pipeline = Pipeline.GetPipeline();
		Desc.RayGenCount = Pipeline.GetRayGenCount();
		Desc.MissCount = Pipeline.GetRayTypeCount();
		Desc.HitCount = WithRoom(0, HitCount);
		Desc.CallableCount = Pipeline.GetCallableCount();
		Desc.RecordDataBytes = sizeof(FSectionData);
		Desc.Name = "ShaderTable";
		bRewrite = true;
		RecordsUsed = 0;
		return Device.CreateShaderTable(Desc, Table.ReleaseAndGetAddress());
	}
	const FRTShaderTableDesc& Has = Table->GetDesc();
	const uint32_t Counts[] = {WithRoom(Has.RayGenCount, Pipeline.GetRayGenCount()), WithRoom(Has.MissCount, Pipeline.GetRayTypeCount()),
	    WithRoom(Has.HitCount, HitCount), WithRoom(Has.CallableCount, Pipeline.GetCallableCount())};
	return Table->Reserve(Counts);
}

void FShaderTable::SetGeneralRecords(const FRTPSO& Pipeline)
{
	// Records behind the pipeline's last must not keep handles of an earlier pipeline that used them.
	const auto SetAll = [&](ERTRecordKind Kind, uint32_t Count, uint32_t TableCount, auto GroupOf) {
		for (uint32_t Index = 0; Count > 0 && Index < TableCount; ++Index)
		{
			Table->SetRecord(Kind, Index, GroupOf(std::min(Index, Count - 1)), nullptr, 0);
		}
	};
	const FRTShaderTableDesc& Has = Table->GetDesc();
	SetAll(ERTRecordKind::RayGen, Pipeline.GetRayGenCount(), Has.RayGenCount, [&](uint32_t Index) { return Pipeline.RayGenGroup(Index); });
	SetAll(ERTRecordKind::Miss, Pipeline.GetRayTypeCount(), Has.MissCount, [&](uint32_t Index) { return Pipeline.MissGroup(Index); });
	SetAll(ERTRecordKind::Callable, Pipeline.GetCallableCount(), Has.CallableCount,
	    [&](uint32_t Index) { return Pipeline.CallableGroup(Index); });
}

void FShaderTable::LookUpGroups(const FRTPSO& Pipeline, const FSectionTable& Sections)
{
	const FHitProgramIndex& Programs = Sections.GetHitProgramIndex();
	if (GroupsRevision == Programs.GetIndicesRevision()) { return; }
	GroupsRevision = Programs.GetIndicesRevision();
	Groups.clear();
	for (uint32_t Index = 0; Index < Programs.GetCount(); ++Index)
	{
		for (uint32_t Type = 0; Type < RayTypes; ++Type) { Groups.push_back(Pipeline.HitGroup(Type, Programs.GetProgramAt(Index))); }
	}
}

void FShaderTable::WriteChanged(const FSectionTable& Sections, std::vector<uint32_t> Changed)
{
	std::sort(Changed.begin(), Changed.end());
	ParallelFor(Changed.size(), SectionGrain, [&](size_t Begin, size_t End) {
		FRecordBatch Batch(*Table, Sections, Groups.data(), RayTypes);
		for (size_t Index = Begin; Index < End; ++Index) { Batch.Add(Changed[Index]); }
		Batch.Flush();
	});
	Stats.RecordsWritten += static_cast<uint32_t>(Changed.size()) * RayTypes;
}

void FShaderTable::WriteAll(const FSectionTable& Sections)
{
	ParallelFor(Sections.GetCapacity(), SectionGrain, [&](size_t Begin, size_t End) {
		FRecordBatch Batch(*Table, Sections, Groups.data(), RayTypes);
		for (size_t Section = Begin; Section < End; ++Section) { Batch.Add(static_cast<uint32_t>(Section)); }
		Batch.Flush();
	});
	Stats.RecordsWritten += Sections.GetCapacity() * RayTypes;
}

void FShaderTable::WriteHandles(const FSectionTable& Sections)
{
	const FHitProgramIndex& Programs = Sections.GetHitProgramIndex();
	ParallelFor(Sections.GetCapacity(), SectionGrain, [&](size_t Begin, size_t End) {
		std::array<uint32_t, 1024> OfRecords;
		const size_t Step = OfRecords.size() / RayTypes;
		for (size_t First = Begin; First < End; First += Step)
		{
			uint32_t Count = 0;
			for (size_t Section = First; Section < std::min(First + Step, End); ++Section)
			{
				const uint32_t* const Source = &Groups[Programs.GetIndex(static_cast<uint32_t>(Section)) * RayTypes];
				Count = static_cast<uint32_t>(std::copy_n(Source, RayTypes, OfRecords.begin() + Count) - OfRecords.begin());
			}
			Table->SetGroups(ERTRecordKind::Hit, static_cast<uint32_t>(First) * RayTypes, Count, OfRecords.data());
		}
	});
	Stats.HandlesWritten += Sections.GetCapacity() * RayTypes;
}

void FShaderTable::WriteHandlesBehind(const FSectionTable& Sections)
{
	// Fewer ray types need fewer records. No ray reaches the others, but they must not keep handles of an old pipeline.
	const uint32_t End = Sections.GetCapacity() * RayTypes;
	std::array<uint32_t, 1024> OfRecords;
	OfRecords.fill(Groups[0]);
	for (uint32_t First = End; First < RecordsUsed; First += static_cast<uint32_t>(OfRecords.size()))
	{
		const uint32_t Count = std::min(static_cast<uint32_t>(OfRecords.size()), RecordsUsed - First);
		Table->SetGroups(ERTRecordKind::Hit, First, Count, OfRecords.data());
	}
}

FRTStatus FShaderTable::Record(IRTCommandList& List)
{
	if (!std::exchange(bPending, false)) { return FRTStatus::Success(); }
	List.UpdateShaderTable(Table.Get());
	Stats.BytesCopied = Table->GetUpdatedBytes();
	return FRTStatus::Success();
}

FRTStatus FShaderTable::Sync(IRTCommandList& List, const FRTPSO& Pipeline, const FSectionTable& Sections)
{
	const FRTStatus Status = Prepare(Pipeline, Sections);
	return Status ? Record(List) : Status;
}

void FShaderTable::Invalidate()
{
	if (Table)
	{
		Table->Invalidate();
		bPending = true;
	}
}

} // namespace Lantern
