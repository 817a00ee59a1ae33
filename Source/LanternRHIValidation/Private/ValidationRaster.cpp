// FValidatedCommandList: pipelines, dispatches, rays, raster passes and draws.
#include "ValidationCommandList.h"

namespace Lantern
{

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

} // namespace Lantern
