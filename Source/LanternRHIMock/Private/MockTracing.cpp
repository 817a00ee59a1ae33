// FMockCommandList: rays, shader tables and acceleration structures.

#include "MockCommandList.h"
#include "MockShaderTable.h"

#include <cassert>
#include <cstring>

namespace Lantern
{

void FMockCommandList::TraceRays(IRTShaderTable* Table, uint32_t RayGen, uint32_t Width, uint32_t Height, uint32_t Depth)
{
	Log(ERTMockCall::TraceRays, GetPipelineName(), {RayGen, Width, Height, Depth}, true);
	CheckTrace(Table, RayGen);
}

void FMockCommandList::TraceRaysIndirect(IRTShaderTable* Table, uint32_t RayGen, IRTBuffer* Arguments, uint64_t Offset)
{
	assert(Offset % 4 == 0 && IsInside(Offset, 12, static_cast<FMockBuffer*>(Arguments)->Desc.Size));
	Log(ERTMockCall::TraceRaysIndirect, GetPipelineName(), {RayGen, Offset}, true);
	Keep(Arguments);
	CheckTrace(Table, RayGen);
}

void FMockCommandList::CheckTrace(IRTShaderTable* Table, [[maybe_unused]] uint32_t RayGen)
{
	auto* Mine = static_cast<FMockShaderTable*>(Table);
	assert(!bInPass && Pipeline && Pipeline->Kind == EMockPipeline::RayTracing && RayGen < Mine->Desc.RayGenCount);
	assert(Pipeline->GetGroupCount() == Mine->Pipeline->GetGroupCount());
	Keep(Table);
	Then([Mine, State = State.get(), Copy = Mine->GetDeviceCopy(), Id = Mine->Pipeline->Id] {
		State->ClockNs += State->UsedPipelines.insert(Id).second ? State->FirstUseNs : 0;
		std::string Wrong = Mine->CheckTrace(*Copy, Id);
		if (!Wrong.empty()) { State->AddError(std::move(Wrong)); }
	});
}

void FMockCommandList::UpdateShaderTable(IRTShaderTable* Table)
{
	auto* Mine = static_cast<FMockShaderTable*>(Table);
	FMockShaderTable::FUpdate Update;
	const FRTStatus Status = Mine->TakeUpdate(Update);
	Log(ERTMockCall::UpdateShaderTable, Mine->Name, {Update.Bytes, Update.Ranges.size(), Update.MovedBytes});
	if (!Status)
	{
		Failed = Failed ? Status : Failed;
		return;
	}
	Keep(Table);
	Then([Mine, Update = std::move(Update)] { Mine->Execute(Update); });
}

void FMockCommandList::BuildGeometries(const FRTGeometryBuild* Builds, uint32_t Count)
{
	for (uint32_t i = 0; i < Count; ++i) { BuildGeometry(Builds[i]); }
}

void FMockCommandList::BuildGeometry(const FRTGeometryBuild& Build)
{
	auto* Geometry = static_cast<FMockGeometry*>(Build.Geometry);
	assert(Build.SectionCount == Geometry->SectionCount && (!Build.bUpdate || Geometry->bAllowUpdate));
	assert(Build.ScratchOffset % State->Desc.ScratchAlignment == 0);
	Log(ERTMockCall::BuildGeometry, Geometry->Name, {Build.SectionCount, Build.bUpdate ? 1u : 0u, Build.ScratchOffset});
	Keep(Geometry);
	Keep(Build.Scratch);
	std::vector<FRTGeometrySection> Sections(Build.Sections, Build.Sections + Build.SectionCount);
	for (const FRTGeometrySection& Section : Sections)
	{
		if (Section.Vertices) { Keep(Section.Vertices); }
		if (Section.Indices) { Keep(Section.Indices); }
	}
	Then([this, Geometry, Sections = std::move(Sections), bUpdate = Build.bUpdate] {
		std::lock_guard Lock(State->Mutex);
		if (bUpdate && Geometry->Built.BuildCount == 0) { State->AddErrorLocked(Geometry->Name + ": updated before any build"); }
		if (!bUpdate && Geometry->CompactedBytes) { State->AddErrorLocked(Geometry->Name + ": built, but made for a compacted copy"); }
		++(bUpdate ? Geometry->Built.UpdateCount : Geometry->Built.BuildCount);
		Geometry->Built.Sections = Sections;
		Geometry->Built.CompactedSize = Geometry->GetCompactedSize();
	});
}

void FMockCommandList::WriteCompactedSize(IRTQueryPool* Queries, uint32_t Index, IRTGeometry* Geometry)
{
	auto* Source = static_cast<FMockGeometry*>(Geometry);
	auto* Pool = static_cast<FMockQueryPool*>(Queries);
	assert(Pool->Kind == ERTQuery::CompactedSize && Index < Pool->GetCount());
	Log(ERTMockCall::WriteCompactedSize, Source->Name, {Index});
	Keep(Queries);
	Keep(Geometry);
	Then([=, State = State.get()] {
		std::lock_guard Lock(State->Mutex);
		if (!Source->Built.IsUsable() || !Source->bAllowCompaction)
		{
			State->AddErrorLocked(Source->Name + ": compacted size asked of one that is not built, or made without "
			                                     "bAllowCompaction");
		}
		if (Pool->Values[Index]) { State->AddErrorLocked(Source->Name + ": compacted size written to a query that was not reset"); }
		Pool->Values[Index] = Source->GetCompactedSize();
	});
}

void FMockCommandList::CompactGeometry(IRTGeometry* Dest, IRTGeometry* Source)
{
	auto* To = static_cast<FMockGeometry*>(Dest);
	auto* From = static_cast<FMockGeometry*>(Source);
	assert(To != From);
	Log(ERTMockCall::CompactGeometry, To->Name);
	Keep(Dest);
	Keep(Source);
	Then([=, State = State.get()] {
		std::lock_guard Lock(State->Mutex);
		if (!From->Built.IsUsable() || !From->bAllowCompaction || From->CompactedBytes)
		{
			State->AddErrorLocked(From->Name + ": compacted, but not built, made without bAllowCompaction, or "
			                                   "compacted already");
		}
		if (To->CompactedBytes != From->GetCompactedSize() || To->SectionCount != From->SectionCount)
		{
			State->AddErrorLocked(To->Name + ": not made for the compacted copy of " + From->Name);
		}
		To->Built = From->Built;
		To->Built.CompactedFrom = From->Name;
	});
}

void FMockCommandList::BuildScene(
    IRTScene* Scene, IRTBuffer* Instances, uint64_t InstanceOffset, uint32_t Count, IRTBuffer* Scratch, uint64_t ScratchOffset)
{
	auto* Mine = static_cast<FMockScene*>(Scene);
	auto* From = static_cast<FMockBuffer*>(Instances);
	assert(Count <= Mine->MaxInstances && InstanceOffset % 16 == 0);
	assert(Count == 0 || (From && InstanceOffset + Count * sizeof(FRTInstance) <= From->Desc.Size));
	Log(ERTMockCall::BuildScene, Mine->Name, {Count, InstanceOffset, ScratchOffset});
	Keep(Scene);
	if (Instances) { Keep(Instances); }
	if (Scratch) { Keep(Scratch); }
	Then([=] { Mine->Build(Count ? From->Bytes + InstanceOffset : nullptr, Count); });
}

void FMockScene::Build(const uint8_t* Source, uint32_t Count)
{
	std::lock_guard Lock(State->Mutex);
	State->Traffic.Instances += Count * sizeof(FRTInstance);
	Instances.resize(Count);
	bBuilt.resize(Count);
	if (Count) { std::memcpy(Instances.data(), Source, Count * sizeof(FRTInstance)); }
	// Instances of one geometry tend to follow each other.
	uint64_t LastAddress = 0;
	bool bLast = false;
	for (uint32_t i = 0; i < Count; ++i)
	{
		const uint64_t Address = Instances[i].GeometryAddress;
		if (Address != LastAddress)
		{
			const auto Found = State->Geometries.find(Address);
			bLast = Found != State->Geometries.end() && Found->second->Built.IsUsable();
			LastAddress = Address;
		}
		// Address 0 is an inactive instance (Vulkan specification, "Acceleration Structure Instances").
		bBuilt[i] = bLast && Address ? 1 : 0;
		if (!bBuilt[i] && Address)
		{
			State->AddErrorLocked(Name + ": instance " + std::to_string(i) + " of " + State->DescribeGeometry(Address));
		}
	}
}

} // namespace Lantern
