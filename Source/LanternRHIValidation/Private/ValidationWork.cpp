// FValidatedCommandList: the work of the GPU: dispatches, rays, draws, and builds of acceleration structures.
#include "ValidationCommandList.h"

#include <cstring>

namespace Lantern
{
namespace
{

constexpr uint64_t BoxBytes = 24;

} // namespace

void FValidatedCommandList::SetPipeline(IRTPipeline* InPipeline)
{
	if (!CanRecord("SetPipeline")) { return; }
	auto* Mine = State->Require<FValidatedPipeline>(InPipeline, Where("SetPipeline") + ": Pipeline");
	if (!Mine) { return; }
	if (Mine->bLibrary) { return Report("SetPipeline", Mine->Label + " is a library: link it first"); }
	Pipeline = TRTRef<FValidatedPipeline>(Mine);
	Inner->SetPipeline(Mine->Inner.Get());
}

void FValidatedCommandList::PushConstants(const void* Data, uint32_t Size)
{
	if (!CanRecord("PushConstants")) { return; }
	const uint32_t Most = State->Inner->GetCapabilities().MaxPushConstantBytes;
	if (!Pipeline) { return Report("PushConstants", "no pipeline has been set"); }
	if (!Data || Size == 0 || Size % 4 || Size > Most)
	{
		return Report("PushConstants", Print("%u bytes: must be a multiple of 4, above 0 and at most %u, and not null", Size, Most));
	}
	Inner->PushConstants(Data, Size);
}

bool FValidatedCommandList::HasPipeline(const char* Call, EPipelineKind Kind)
{
	static constexpr const char* Names[] = {"compute", "raster", "ray-tracing"};
	if (Pipeline && Pipeline->PipelineKind == Kind) { return true; }
	Report(Call,
	    std::string("no ") + Names[static_cast<size_t>(Kind)] + " pipeline has been set" + (Pipeline ? ", but " + Pipeline->Label : ""));
	return false;
}

void FValidatedCommandList::Dispatch(uint32_t GroupsX, uint32_t GroupsY, uint32_t GroupsZ)
{
	if (!CanRecordOutside("Dispatch") || !HasPipeline("Dispatch", EPipelineKind::Compute)) { return; }
	if (!GroupsX || !GroupsY || !GroupsZ)
	{
		return Report("Dispatch", Print("%u x %u x %u groups with %s", GroupsX, GroupsY, GroupsZ, Pipeline->Label.c_str()));
	}
	Inner->Dispatch(GroupsX, GroupsY, GroupsZ);
}

FValidatedBuffer* FValidatedCommandList::RequireArguments(const char* Call, IRTBuffer* Arguments, uint64_t Offset)
{
	FValidatedBuffer* const Buffer = RequireBuffer(Call, "Arguments", Arguments, ERTBufferUsage::Indirect);
	if (!Buffer || !CheckRange(Call, *Buffer, Offset, 3 * sizeof(uint32_t))) { return nullptr; }
	if (Offset % 4 != 0)
	{
		Report(Call, Buffer->Label + Print(": offset %llu is no multiple of 4", static_cast<unsigned long long>(Offset)));
		return nullptr;
	}
	AddUse(Call, Buffer->Track, ERTAccess::IndirectRead);
	return Buffer;
}

void FValidatedCommandList::DispatchIndirect(IRTBuffer* Arguments, uint64_t Offset)
{
	const char* Call = "DispatchIndirect";
	if (!CanRecordOutside(Call) || !HasPipeline(Call, EPipelineKind::Compute)) { return; }
	if (FValidatedBuffer* const Buffer = RequireArguments(Call, Arguments, Offset))
	{
		Inner->DispatchIndirect(Buffer->Inner.Get(), Offset);
	}
}

void FValidatedCommandList::TraceRaysIndirect(IRTShaderTable* Table, uint32_t RayGen, IRTBuffer* Arguments, uint64_t Offset)
{
	const char* Call = "TraceRaysIndirect";
	if (!CanRecordOutside(Call) || !HasPipeline(Call, EPipelineKind::RayTracing)) { return; }
	if (!State->Inner->GetCapabilities().bIndirectTrace) { return Report(Call, "the device has no bIndirectTrace"); }
	auto* Mine = State->Require<FValidatedShaderTable>(Table, Where(Call) + ": Table");
	if (!Mine || !CheckTrace(*Mine, RayGen, 1, 1, 1)) { return; }
	FValidatedBuffer* const Buffer = RequireArguments(Call, Arguments, Offset);
	if (!Buffer) { return; }
	FValidationStep& Step = AddStep(EKind::TraceRays, Call);
	Step.Table = Mine->Track;
	Step.Count = Mine->Track->Generation;
	Inner->TraceRaysIndirect(Mine->Inner.Get(), RayGen, Buffer->Inner.Get(), Offset);
}

bool FValidatedCommandList::CheckTrace(FValidatedShaderTable& Table, uint32_t RayGen, uint32_t Width, uint32_t Height, uint32_t Depth)
{
	const char* Call = "TraceRays";
	if (Table.Pipeline.Get() != Pipeline.Get() && Table.Pipeline->Groups != Pipeline->Groups)
	{
		Report(Call, Table.Label + " is of " + Table.Pipeline->Label + ", but " + Pipeline->Label + " is set");
		return false;
	}
	if (!Width || !Height || !Depth)
	{
		Report(Call, Print("%u x %u x %u rays", Width, Height, Depth));
		return false;
	}
	if (bUnflushedGeometry || bUnflushedScene)
	{
		Report(Call, "acceleration structures were built, with no memory barrier from BuildWrite since");
		return false;
	}
	std::lock_guard Lock(State->Mutex);
	const std::vector<ERecordState>& Records = Table.Track->RayGen;
	if (RayGen >= Records.size())
	{
		Report(Call, Table.Label + Print(": ray generation record %u of %zu", RayGen, Records.size()));
		return false;
	}
	const FRecordTracks& Generations = Table.Track->Records[static_cast<size_t>(ERTRecordKind::RayGen)];
	if (Generations.IsStale(RayGen, Table.Track->Generation))
	{
		Report(Call, Table.Label + Print(": ray generation record %u was not set again after SetPipeline", RayGen));
		return false;
	}
	if (Records[RayGen] == ERecordState::Updated) { return true; }
	Report(Call, Table.Label + Print(": ray generation record %u %s", RayGen,
	                               Records[RayGen] == ERecordState::Never ? "was never set" : "was set after the last UpdateShaderTable"));
	return false;
}

void FValidatedCommandList::TraceRays(IRTShaderTable* Table, uint32_t RayGen, uint32_t Width, uint32_t Height, uint32_t Depth)
{
	if (!CanRecordOutside("TraceRays") || !HasPipeline("TraceRays", EPipelineKind::RayTracing)) { return; }
	auto* Mine = State->Require<FValidatedShaderTable>(Table, Where("TraceRays") + ": Table");
	if (!Mine || !CheckTrace(*Mine, RayGen, Width, Height, Depth)) { return; }
	FValidationStep& Step = AddStep(EKind::TraceRays, "TraceRays");
	Step.Table = Mine->Track;
	Step.Count = Mine->Track->Generation;
	Inner->TraceRays(Mine->Inner.Get(), RayGen, Width, Height, Depth);
}

void FValidatedCommandList::UpdateShaderTable(IRTShaderTable* Table)
{
	if (!CanRecordOutside("UpdateShaderTable")) { return; }
	auto* Mine = State->Require<FValidatedShaderTable>(Table, Where("UpdateShaderTable") + ": Table");
	if (!Mine) { return; }
	const FValidatedShaderTable::FUse Use(*Mine, "UpdateShaderTable", false);
	FValidationStep& Step = AddStep(EKind::UpdateTable, "UpdateShaderTable");
	Step.Table = Mine->Track;
	Step.Count = Mine->Track->Generation;
	Inner->UpdateShaderTable(Mine->Inner.Get());
	std::lock_guard Lock(State->Mutex);
	for (ERecordState& Record : Mine->Track->RayGen) { Record = Record == ERecordState::Set ? ERecordState::Updated : Record; }
}

FValidatedTexture* FValidatedCommandList::CheckTarget(IRTTexture* Texture, const FRTRasterPassDesc& Desc, bool bDepth)
{
	const char* Call = "BeginRasterPass";
	FValidatedTexture* Target =
	    RequireTexture(Call, bDepth ? "Depth" : "Colors", Texture, bDepth ? ERTTextureUsage::Depth : ERTTextureUsage::RenderTarget);
	if (!Target) { return nullptr; }
	if (Target->GetDesc().Width < Desc.Width || Target->GetDesc().Height < Desc.Height)
	{
		Report(Call, Target->Label + Print(" has %u x %u texels, the pass %u x %u", Target->GetDesc().Width, Target->GetDesc().Height,
		                                 Desc.Width, Desc.Height));
		return nullptr;
	}
	return Target;
}

void FValidatedCommandList::BeginRasterPass(const FRTRasterPassDesc& Desc)
{
	const char* Call = "BeginRasterPass";
	if (!CanRecordOutside(Call)) { return; }
	if (!Desc.Width || !Desc.Height) { return Report(Call, Print("a size of %u x %u", Desc.Width, Desc.Height)); }
	if ((Desc.ColorCount && !Desc.Colors) || (!Desc.ColorCount && !Desc.Depth)) { return Report(Call, "no targets"); }
	FRTRasterPassDesc Mine = Desc;
	std::vector<FRTColorTarget> Colors(Desc.Colors, Desc.Colors + Desc.ColorCount);
	std::vector<FValidatedTexture*> Targets;
	PassColors.clear();
	PassDepth = ERTFormat::Unknown;
	for (FRTColorTarget& Color : Colors)
	{
		FValidatedTexture* Target = CheckTarget(Color.Texture, Desc, false);
		if (!Target) { return; }
		Targets.push_back(Target);
		PassColors.push_back(Target->GetDesc().Format);
		Color.Texture = Target->Inner.Get();
	}
	Mine.Colors = Colors.data();
	FValidatedTexture* Depth = Desc.Depth ? CheckTarget(Desc.Depth, Desc, true) : nullptr;
	if (Desc.Depth && !Depth) { return; }
	for (FValidatedTexture* Target : Targets) { AddUse(Call, Target->Track, ERTAccess::RenderTarget); }
	if (Depth)
	{
		AddUse(Call, Depth->Track, ERTAccess::DepthWrite);
		PassDepth = Depth->GetDesc().Format;
		Mine.Depth = Depth->Inner.Get();
	}
	bInPass = true;
	Inner->BeginRasterPass(Mine);
}

void FValidatedCommandList::EndRasterPass()
{
	if (!CanRecord("EndRasterPass")) { return; }
	if (!bInPass) { return Report("EndRasterPass", "no raster pass is open"); }
	bInPass = false;
	Inner->EndRasterPass();
}

void FValidatedCommandList::SetIndexBuffer(IRTBuffer* Buffer, uint64_t Offset, ERTIndexType Type)
{
	const char* Call = "SetIndexBuffer";
	if (!CanRecord(Call)) { return; }
	FValidatedBuffer* Mine = RequireBuffer(Call, "Buffer", Buffer, ERTBufferUsage::Index);
	if (!Mine) { return; }
	if (Type == ERTIndexType::None) { return Report(Call, Mine->Label + ": the index type is None"); }
	const uint32_t Size = Type == ERTIndexType::UInt16 ? 2 : 4;
	if (Offset % Size) { return Report(Call, Mine->Label + ": the offset is not a multiple of the index size"); }
	if (!CheckRange(Call, *Mine, Offset, Size)) { return; }
	IndexSize = Size;
	IndexBytes = Mine->GetDesc().Size - Offset;
	AddUse(Call, Mine->Track, ERTAccess::IndexRead);
	Inner->SetIndexBuffer(Mine->Inner.Get(), Offset, Type);
}

bool FValidatedCommandList::CanDraw(const char* Call)
{
	if (!CanRecord(Call)) { return false; }
	if (!bInPass)
	{
		Report(Call, "outside a raster pass");
		return false;
	}
	if (!HasPipeline(Call, EPipelineKind::Raster)) { return false; }
	if (Pipeline->ColorFormats == PassColors && Pipeline->DepthFormat == PassDepth) { return true; }
	Report(Call, Pipeline->Label + ": its target formats are not those of the raster pass");
	return false;
}

void FValidatedCommandList::Draw(uint32_t VertexCount, uint32_t InstanceCount)
{
	if (!CanDraw("Draw")) { return; }
	if (!VertexCount || !InstanceCount) { return Report("Draw", Print("%u vertices, %u instances", VertexCount, InstanceCount)); }
	Inner->Draw(VertexCount, InstanceCount);
}

void FValidatedCommandList::DrawIndexed(uint32_t IndexCount, uint32_t InstanceCount, uint32_t FirstIndex, int32_t VertexOffset)
{
	const char* Call = "DrawIndexed";
	if (!CanDraw(Call)) { return; }
	if (!IndexSize) { return Report(Call, "no index buffer has been set"); }
	if (!IndexCount || !InstanceCount) { return Report(Call, Print("%u indices, %u instances", IndexCount, InstanceCount)); }
	if (!IsInside(FirstIndex, IndexCount, IndexBytes / IndexSize))
	{
		return Report(Call, Print("indices %u + %u, the buffer holds %llu", FirstIndex, IndexCount,
		                        static_cast<unsigned long long>(IndexBytes / IndexSize)));
	}
	Inner->DrawIndexed(IndexCount, InstanceCount, FirstIndex, VertexOffset);
}

// ------------------------------------------------------------------------------------------------ builds of acceleration structures

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
	    Section.bProcedural != Made.bProcedural || Section.VertexFormat != Made.VertexFormat ||
	    (!Section.bProcedural && (Section.TriangleCount != Made.TriangleCount || Section.IndexType != Made.IndexType)))
	{
		Report(Call, Which + ": counts, stride, formats or flags are not those of its creation");
		return false;
	}
	FValidatedBuffer* Vertices = RequireBuffer(Call, "Vertices", Section.Vertices, ERTBufferUsage::GeometryInput);
	if (!Vertices) { return false; }
	const uint64_t Last = Section.bProcedural ? BoxBytes : GetPositionBytes(Section.VertexFormat);
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
	const FValidationTracker Tracker(*State, Queue);
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
