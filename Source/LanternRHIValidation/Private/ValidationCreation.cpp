// FValidatedDevice: creation of everything but pipelines.
#include "ValidationDeviceImpl.h"

#include <algorithm>
#include <bit>

namespace Lantern
{
namespace
{

const char* NameOf(const char* Name) { return Name ? Name : ""; }

} // namespace

FRTStatus FValidatedDevice::CreateBuffer(const FRTBufferDesc& Desc, IRTBuffer** Out)
{
	const std::string What = "CreateBuffer: " + MakeLabel("buffer", Desc.Name);
	if (!Out) { return State->Fail(What + ": Out is null"); }
	if (!Desc.Size) { return State->Fail(What + ": its size is 0"); }
	if (Desc.Usage == ERTBufferUsage::None) { return State->Fail(What + ": it has no usage"); }
	TRTRef<IRTBuffer> Inner;
	FRTStatus Status = State->Inner->CreateBuffer(Desc, Inner.ReleaseAndGetAddress());
	if (Status) { *Out = new FValidatedBuffer(State, std::move(Inner)); }
	return Status;
}

std::string FValidatedDevice::CheckTexture(const FRTTextureDesc& Desc) const
{
	if (!Desc.Width || !Desc.Height || !Desc.ArraySize || !Desc.MipCount)
	{
		return Print("%u x %u, %u mips, %u layers", Desc.Width, Desc.Height, Desc.MipCount, Desc.ArraySize);
	}
	if (Desc.Format == ERTFormat::Unknown) { return "its format is Unknown"; }
	if (Desc.Usage == ERTTextureUsage::None) { return "it has no usage"; }
	const uint32_t Most = std::bit_width(std::max(Desc.Width, Desc.Height));
	if (Desc.MipCount > Most) { return Print("%u mips, at most %u", Desc.MipCount, Most); }
	const bool bDepth = Desc.Format == ERTFormat::D32_FLOAT;
	if (HasAny(Desc.Usage, ERTTextureUsage::Depth) && !bDepth) { return "usage Depth, but not a depth format"; }
	if (bDepth && HasAny(Desc.Usage, ERTTextureUsage::RenderTarget | ERTTextureUsage::Storage))
	{
		return "a depth format cannot have the usage RenderTarget or Storage";
	}
	if (Desc.Format == ERTFormat::RGBA8_SRGB && HasAny(Desc.Usage, ERTTextureUsage::Storage))
	{
		return "an sRGB format cannot have the usage Storage";
	}
	return {};
}

FRTStatus FValidatedDevice::CreateTexture(const FRTTextureDesc& Desc, IRTTexture** Out)
{
	const std::string What = "CreateTexture: " + MakeLabel("texture", Desc.Name);
	if (!Out) { return State->Fail(What + ": Out is null"); }
	const std::string Wrong = CheckTexture(Desc);
	if (!Wrong.empty()) { return State->Fail(What + ": " + Wrong); }
	TRTRef<IRTTexture> Inner;
	FRTStatus Status = State->Inner->CreateTexture(Desc, Inner.ReleaseAndGetAddress());
	if (Status) { *Out = new FValidatedTexture(State, std::move(Inner), false); }
	return Status;
}

FRTStatus FValidatedDevice::ImportTexture(const FRTTextureDesc& Desc, uint64_t NativeImage, IRTTexture** Out)
{
	const std::string What = "ImportTexture: " + MakeLabel("texture", Desc.Name);
	if (!Out) { return State->Fail(What + ": Out is null"); }
	if (!NativeImage) { return State->Fail(What + ": NativeImage is 0"); }
	const std::string Wrong = CheckTexture(Desc);
	if (!Wrong.empty()) { return State->Fail(What + ": " + Wrong); }
	TRTRef<IRTTexture> Inner;
	FRTStatus Status = State->Inner->ImportTexture(Desc, NativeImage, Inner.ReleaseAndGetAddress());
	if (Status) { *Out = new FValidatedTexture(State, std::move(Inner), true); }
	return Status;
}

FRTStatus FValidatedDevice::CreateSampler(const FRTSamplerDesc& Desc, IRTSampler** Out)
{
	const std::string Named = MakeLabel("sampler", Desc.Name);
	if (!Out) { return State->Fail("CreateSampler: " + Named + ": Out is null"); }
	if (!(Desc.MaxAnisotropy >= 1.0f)) { return State->Fail("CreateSampler: " + Named + ": MaxAnisotropy is below 1"); }
	TRTRef<IRTSampler> Inner;
	FRTStatus Status = State->Inner->CreateSampler(Desc, Inner.ReleaseAndGetAddress());
	if (Status) { *Out = new FValidatedSampler(State, Named, std::move(Inner)); }
	return Status;
}

std::string FValidatedDevice::CheckSections(const FRTGeometryDesc& Desc) const
{
	if (!Desc.Sections || !Desc.SectionCount) { return "it has no sections"; }
	for (uint32_t i = 0; i < Desc.SectionCount; ++i)
	{
		const FRTGeometrySection& Section = Desc.Sections[i];
		const std::string Which = Print("section %u ", i);
		if (Section.bProcedural != Desc.Sections[0].bProcedural) { return Which + "mixes triangles with AABBs"; }
		if (Section.bProcedural)
		{
			if (!Section.VertexCount) { return Which + "has no AABBs"; }
			if (Section.VertexStride < 24 || Section.VertexStride % 8)
			{
				return Which + Print("has an AABB stride of %u, not a multiple of 8 from 24", Section.VertexStride);
			}
			continue;
		}
		if (!Section.TriangleCount) { return Which + "has no triangles"; }
		if (!Section.VertexCount) { return Which + "has no vertices"; }
		if (Section.VertexStride < 12 || Section.VertexStride % 4)
		{
			return Which + Print("has a vertex stride of %u, not a multiple of 4 from 12", Section.VertexStride);
		}
		if (Section.IndexType == ERTIndexType::None && Section.TriangleCount * 3ull > Section.VertexCount)
		{
			return Which + Print("has %u triangles of %u vertices", Section.TriangleCount, Section.VertexCount);
		}
	}
	return {};
}

std::vector<FRTGeometrySection> FValidatedDevice::UnwrapSections(const FRTGeometryDesc& Desc) const
{
	// Only counts, strides and flags matter; the buffers would be wrappers.
	std::vector<FRTGeometrySection> Sections(Desc.Sections, Desc.Sections + Desc.SectionCount);
	for (FRTGeometrySection& Section : Sections)
	{
		auto* Vertices = State->Find<FValidatedBuffer>(Section.Vertices);
		auto* Indices = State->Find<FValidatedBuffer>(Section.Indices);
		Section.Vertices = Vertices ? Vertices->Inner.Get() : nullptr;
		Section.Indices = Indices ? Indices->Inner.Get() : nullptr;
	}
	return Sections;
}

FRTBuildSizes FValidatedDevice::GetGeometrySizes(const FRTGeometryDesc& Desc)
{
	const std::string Wrong = CheckSections(Desc);
	if (!Wrong.empty())
	{
		State->Report("GetGeometrySizes: " + MakeLabel("geometry", Desc.Name) + ": " + Wrong);
		return {};
	}
	const std::vector<FRTGeometrySection> Sections = UnwrapSections(Desc);
	FRTGeometryDesc Mine = Desc;
	Mine.Sections = Sections.data();
	return State->Inner->GetGeometrySizes(Mine);
}

FRTStatus FValidatedDevice::CreateGeometry(const FRTGeometryDesc& Desc, IRTGeometry** Out)
{
	const std::string What = "CreateGeometry: " + MakeLabel("geometry", Desc.Name);
	if (!Out) { return State->Fail(What + ": Out is null"); }
	const std::string Wrong = CheckSections(Desc);
	if (!Wrong.empty()) { return State->Fail(What + ": " + Wrong); }
	std::vector<FRTGeometrySection> Sections = UnwrapSections(Desc);
	FRTGeometryDesc Mine = Desc;
	Mine.Sections = Sections.data();
	TRTRef<IRTGeometry> Inner;
	FRTStatus Status = State->Inner->CreateGeometry(Mine, Inner.ReleaseAndGetAddress());
	if (Status) { *Out = new FValidatedGeometry(State, std::move(Inner), Desc); }
	return Status;
}

FRTStatus FValidatedDevice::CreateScene(const FRTSceneDesc& Desc, IRTScene** Out)
{
	const std::string What = "CreateScene: " + MakeLabel("scene", Desc.Name);
	if (!Out) { return State->Fail(What + ": Out is null"); }
	TRTRef<IRTScene> Inner;
	FRTStatus Status = State->Inner->CreateScene(Desc, Inner.ReleaseAndGetAddress());
	if (Status) { *Out = new FValidatedScene(State, std::move(Inner), Desc.Name); }
	return Status;
}

FRTStatus FValidatedDevice::CreateShaderTable(const FRTShaderTableDesc& Desc, IRTShaderTable** Out)
{
	const std::string What = "CreateShaderTable: " + MakeLabel("shader table", Desc.Name);
	if (!Out) { return State->Fail(What + ": Out is null"); }
	auto* Pipeline = State->Require<FValidatedPipeline>(Desc.Pipeline, What + ": Pipeline");
	if (!Pipeline) { return FRTStatus::Error(ERTResult::InvalidArgument, "%s: no pipeline", What.c_str()); }
	if (Pipeline->PipelineKind != EPipelineKind::RayTracing)
	{
		return State->Fail(What + ": " + Pipeline->Label + " is not for ray tracing");
	}
	if (Pipeline->bLibrary) { return State->Fail(What + ": " + Pipeline->Label + " is a library: link it first"); }
	if (!Desc.RayGenCount) { return State->Fail(What + ": it has no ray generation record"); }
	if (!Desc.Copies) { return State->Fail(What + ": it has no host copy"); }
	if (Desc.RecordDataBytes > MaxRecordDataBytes)
	{
		return State->Fail(What + Print(": %u bytes of record data, at most %u", Desc.RecordDataBytes, MaxRecordDataBytes));
	}
	FRTShaderTableDesc Mine = Desc;
	Mine.Pipeline = Pipeline->Inner.Get();
	TRTRef<IRTShaderTable> Inner;
	FRTStatus Status = State->Inner->CreateShaderTable(Mine, Inner.ReleaseAndGetAddress());
	if (Status) { *Out = new FValidatedShaderTable(State, std::move(Inner), Desc, Pipeline); }
	return Status;
}

FRTStatus FValidatedDevice::CreateQueryPool(ERTQuery Kind, uint32_t Count, IRTQueryPool** Out)
{
	if (!Out || !Count) { return State->Fail("CreateQueryPool: no queries, or Out is null"); }
	TRTRef<IRTQueryPool> Inner;
	FRTStatus Status = State->Inner->CreateQueryPool(Kind, Count, Inner.ReleaseAndGetAddress());
	if (Status) { *Out = new FValidatedQueryPool(State, std::move(Inner)); }
	return Status;
}

FRTStatus FValidatedDevice::CreateCommandList(const char* Name, IRTCommandList** Out)
{
	if (!Out) { return State->Fail("CreateCommandList: Out is null"); }
	TRTRef<IRTCommandList> Inner;
	FRTStatus Status = State->Inner->CreateCommandList(NameOf(Name), Inner.ReleaseAndGetAddress());
	if (Status) { *Out = new FValidatedCommandList(State, std::move(Inner), Name, false); }
	return Status;
}

FRTStatus FValidatedDevice::ImportCommandList(uint64_t NativeCommandBuffer, IRTCommandList** Out)
{
	if (!Out || !NativeCommandBuffer) { return State->Fail("ImportCommandList: a null argument"); }
	TRTRef<IRTCommandList> Inner;
	FRTStatus Status = State->Inner->ImportCommandList(NativeCommandBuffer, Inner.ReleaseAndGetAddress());
	if (Status) { *Out = new FValidatedCommandList(State, std::move(Inner), "imported", true); }
	return Status;
}

} // namespace Lantern
