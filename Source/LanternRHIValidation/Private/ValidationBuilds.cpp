// FValidatedCommandList: builds of acceleration structures.
#include "ValidationCommandList.h"

#include <cstring>

namespace Lantern
{
namespace
{

constexpr uint64_t PositionBytes = 12, BoxBytes = 24;

unsigned long long Wide(uint64_t Value) { return Value; }

} // namespace

bool FValidatedCommandList::CheckScratch(const char* Call, const std::string& Which, IRTBuffer* Scratch, uint64_t Offset, uint64_t Bytes)
{
	FValidatedBuffer* Mine = RequireBuffer(Call, "Scratch", Scratch, ERTBufferUsage::Scratch);
	if (!Mine) { return false; }
	const uint32_t Alignment = State->Inner->GetCapabilities().ScratchAlignment;
	if (Alignment && Offset % Alignment)
	{
		Report(Call, Which + Print(": scratch offset %llu is not a multiple of %u", Wide(Offset), Alignment));
		return false;
	}
	if (!IsInside(Offset, Bytes, Mine->GetDesc().Size))
	{
		Report(Call, Which + Print(": needs %llu bytes of scratch at %llu, %s has %llu", Wide(Bytes), Wide(Offset), Mine->Label.c_str(),
		                         Wide(Mine->GetDesc().Size)));
		return false;
	}
	for (const FScratchRange& Range : ScratchRanges)
	{
		if (Range.Buffer == Mine->Track.get() && Offset < Range.End && Range.Begin < Offset + Bytes)
		{
			Report(Call, Which + ": its scratch overlaps that of another build, with no barrier between them");
			return false;
		}
	}
	ScratchRanges.push_back({Mine->Track.get(), Offset, Offset + Bytes});
	AddUse(Call, Mine->Track, ERTAccess::BuildWrite);
	return true;
}

bool FValidatedCommandList::CheckTriangles(const std::string& Which, const FRTGeometrySection& Section, FRTGeometrySection& OutInner)
{
	const char* Call = "BuildGeometries";
	if (Section.IndexType == ERTIndexType::None)
	{
		if (Section.TriangleCount * 3ull <= Section.VertexCount) { return true; }
		Report(Call, Which + Print(": %u triangles of %u vertices", Section.TriangleCount, Section.VertexCount));
		return false;
	}
	FValidatedBuffer* Indices = RequireBuffer(Call, "Indices", Section.Indices, ERTBufferUsage::GeometryInput);
	const uint32_t Size = Section.IndexType == ERTIndexType::UInt16 ? 2 : 4;
	if (!Indices || !CheckRange(Call, *Indices, Section.IndexOffset, Section.TriangleCount * 3ull * Size)) { return false; }
	if (Section.IndexOffset % Size)
	{
		Report(Call, Which + ": the index offset is not a multiple of the index size");
		return false;
	}
	AddUse(Call, Indices->Track, ERTAccess::GeometryInput);
	OutInner.Indices = Indices->Inner.Get();
	if (Indices->GetMapped() && Indices->GetDesc().Memory == ERTMemory::Upload)
	{
		FValidationStep& Step = AddStep(EKind::CheckIndices, Call);
		Step.What += ": " + Which;
		Step.Memory = Indices->Inner;
		Step.Offset = Section.IndexOffset;
		Step.Count = Section.TriangleCount * 3;
		Step.Limit = Section.VertexCount;
		Step.IndexType = Section.IndexType;
	}
	return true;
}

bool FValidatedCommandList::CheckSection(
    const FValidatedGeometry& Geometry, uint32_t Index, const FRTGeometrySection& Section, FRTGeometrySection& OutInner)
{
	const char* Call = "BuildGeometries";
	const FRTGeometrySection& Made = Geometry.Track->Sections[Index];
	const std::string Which = Geometry.Label + Print(", section %u", Index);
	OutInner = Section;
	if (Section.VertexCount != Made.VertexCount || Section.VertexStride != Made.VertexStride || Section.bOpaque != Made.bOpaque ||
	    Section.bProcedural != Made.bProcedural ||
	    (!Section.bProcedural && (Section.TriangleCount != Made.TriangleCount || Section.IndexType != Made.IndexType)))
	{
		Report(Call, Which + ": counts, stride, index type or flags are not those of its creation");
		return false;
	}
	FValidatedBuffer* Vertices = RequireBuffer(Call, "Vertices", Section.Vertices, ERTBufferUsage::GeometryInput);
	if (!Vertices) { return false; }
	const uint64_t Last = Section.bProcedural ? BoxBytes : PositionBytes;
	const uint64_t Bytes = (Section.VertexCount - 1ull) * Section.VertexStride + Last;
	if (!CheckRange(Call, *Vertices, Section.VertexOffset, Bytes)) { return false; }
	const uint32_t Alignment = Section.bProcedural ? 8 : 4;
	if (Section.VertexOffset % Alignment)
	{
		Report(Call, Which + Print(": the vertex offset is not a multiple of %u", Alignment));
		return false;
	}
	AddUse(Call, Vertices->Track, ERTAccess::GeometryInput);
	OutInner.Vertices = Vertices->Inner.Get();
	return Section.bProcedural || CheckTriangles(Which, Section, OutInner);
}

bool FValidatedCommandList::CheckBuild(
    const FRTGeometryBuild& Build, FRTGeometryBuild& OutInner, std::vector<FRTGeometrySection>& OutSections)
{
	const char* Call = "BuildGeometries";
	auto* Geometry = State->Require<FValidatedGeometry>(Build.Geometry, Where(Call) + ": Geometry");
	if (!Geometry) { return false; }
	const size_t Wanted = Geometry->Track->Sections.size();
	if (Build.SectionCount != Wanted || !Build.Sections)
	{
		Report(Call, Geometry->Label + Print(": %u sections, it was created with %zu", Build.SectionCount, Wanted));
		return false;
	}
	if (Build.bUpdate && !Geometry->Track->bAllowUpdate)
	{
		Report(Call, Geometry->Label + ": update, but it was created without bAllowUpdate");
		return false;
	}
	if (!Build.bUpdate && Geometry->Track->CompactedBytes)
	{
		Report(Call, Geometry->Label + " was created for a compacted copy: only CompactGeometry fills it");
		return false;
	}
	OutSections.resize(Build.SectionCount);
	for (uint32_t i = 0; i < Build.SectionCount; ++i)
	{
		if (!CheckSection(*Geometry, i, Build.Sections[i], OutSections[i])) { return false; }
	}
	const FRTBuildSizes Sizes = Geometry->GetBuildSizes();
	const uint64_t Scratch = Build.bUpdate ? Sizes.UpdateScratchBytes : Sizes.BuildScratchBytes;
	if (!CheckScratch(Call, Geometry->Label, Build.Scratch, Build.ScratchOffset, Scratch)) { return false; }
	OutInner = Build;
	OutInner.Geometry = Geometry->Inner.Get();
	OutInner.Sections = OutSections.data();
	OutInner.Scratch = State->Find<FValidatedBuffer>(Build.Scratch)->Inner.Get();
	FValidationStep& Step = AddStep(Build.bUpdate ? EKind::UpdateGeometry : EKind::BuildGeometry, Call);
	Step.Geometry = Geometry->Track;
	// What the list builds lives as long as the list's submission.
	KeptGeometries.emplace_back(Geometry->Track);
	std::lock_guard Lock(State->Mutex);
	Geometry->Track->bBuildRecorded = true;
	return true;
}

void FValidatedCommandList::BuildGeometries(const FRTGeometryBuild* Builds, uint32_t Count)
{
	const char* Call = "BuildGeometries";
	if (!CanRecordOutside(Call)) { return; }
	if (!Builds || !Count) { return Report(Call, "no builds"); }
	std::vector<FRTGeometryBuild> Inners;
	std::vector<std::vector<FRTGeometrySection>> Sections(Count);
	for (uint32_t i = 0; i < Count; ++i)
	{
		FRTGeometryBuild Mine;
		bool bTwice = false;
		for (uint32_t Before = 0; Before < i; ++Before) { bTwice |= Builds[Before].Geometry == Builds[i].Geometry; }
		if (bTwice)
		{
			Report(Call, Print("build %u is of the same geometry as an earlier one of the call", i));
			continue;
		}
		if (CheckBuild(Builds[i], Mine, Sections[i])) { Inners.push_back(Mine); }
	}
	if (Inners.empty()) { return; }
	bUnflushedGeometry = bUnflushedBuild = true;
	Inner->BuildGeometries(Inners.data(), static_cast<uint32_t>(Inners.size()));
}

bool FValidatedCommandList::CheckInstances(FValidatedScene& Scene, IRTBuffer* Instances, uint64_t Offset, uint32_t Count)
{
	const char* Call = "BuildScene";
	if (Count > Scene.GetMaxInstances())
	{
		Report(Call, Scene.Label + Print(": %u instances, it was created for %u", Count, Scene.GetMaxInstances()));
		return false;
	}
	if (Count == 0) { return true; }
	FValidatedBuffer* Buffer = RequireBuffer(Call, "Instances", Instances, ERTBufferUsage::GeometryInput);
	if (!Buffer || !CheckRange(Call, *Buffer, Offset, Count * sizeof(FRTInstance))) { return false; }
	if (Offset % 16)
	{
		Report(Call, Buffer->Label + Print(": instance offset %llu is not a multiple of 16", Wide(Offset)));
		return false;
	}
	AddUse(Call, Buffer->Track, ERTAccess::GeometryInput);
	return true;
}

bool FValidatedCommandList::CheckAddresses(const FValidatedScene& Scene, FValidatedBuffer& Buffer, uint64_t Offset, uint32_t Count)
{
	const FValidationTracker Tracker(*State);
	const auto* Bytes = static_cast<const uint8_t*>(Buffer.GetMapped()) + Offset;
	std::string Wrong;
	uint32_t Index = 0;
	{
		std::lock_guard Lock(State->Mutex);
		uint64_t LastGood = 0; // address 0 is an inactive instance
		for (; Index < Count && Wrong.empty(); ++Index)
		{
			FRTInstance Instance;
			std::memcpy(&Instance, Bytes + Index * sizeof(Instance), sizeof(Instance));
			if (Instance.GeometryAddress != LastGood && Instance.GeometryAddress != 0)
			{
				LastGood = Instance.GeometryAddress;
				Wrong = Tracker.CheckAddress(LastGood, true);
			}
		}
	}
	if (!Wrong.empty()) { Report("BuildScene", Scene.Label + Print(": instance %u ", Index - 1) + Wrong); }
	return Wrong.empty();
}

void FValidatedCommandList::BuildScene(
    IRTScene* Scene, IRTBuffer* Instances, uint64_t InstanceOffset, uint32_t Count, IRTBuffer* Scratch, uint64_t ScratchOffset)
{
	const char* Call = "BuildScene";
	if (!CanRecordOutside(Call)) { return; }
	auto* Mine = State->Require<FValidatedScene>(Scene, Where(Call) + ": Scene");
	if (!Mine || !CheckInstances(*Mine, Instances, InstanceOffset, Count)) { return; }
	if (bUnflushedGeometry) { return Report(Call, Mine->Label + ": geometries were built, with no memory barrier from BuildWrite since"); }
	auto* Buffer = State->Find<FValidatedBuffer>(Instances);
	const bool bReadable = Buffer && Buffer->GetMapped() && Buffer->GetDesc().Memory == ERTMemory::Upload;
	if (bReadable && !CheckAddresses(*Mine, *Buffer, InstanceOffset, Count)) { return; }
	if (!CheckScratch(Call, Mine->Label, Scratch, ScratchOffset, Mine->GetBuildSizes().BuildScratchBytes)) { return; }
	FValidationStep& Step = AddStep(EKind::BuildScene, Call);
	Step.What += ": " + Mine->Label;
	Step.Scene = Mine->Track;
	Step.Offset = InstanceOffset;
	Step.Count = Count;
	if (bReadable) { Step.Memory = Buffer->Inner; }
	bUnflushedScene = true;
	Inner->BuildScene(Mine->Inner.Get(), Buffer ? Buffer->Inner.Get() : nullptr, InstanceOffset, Count,
	    State->Find<FValidatedBuffer>(Scratch)->Inner.Get(), ScratchOffset);
}

} // namespace Lantern
