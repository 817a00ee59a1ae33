// FValidatedDevice: creation of objects.
#include "ValidationDeviceImpl.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace Lantern
{
namespace
{

const char* NameOf(const char* Name) { return Name ? Name : ""; }

constexpr const char* StageNames[] = {
    "vertex", "fragment", "compute", "ray generation", "miss", "closest-hit", "any-hit", "intersection", "callable"};

std::string CheckShader(const FRTShaderCode& Shader, ERTShaderStage Stage)
{
	const std::string Which = MakeLabel("shader", Shader.Name);
	if (!Shader.Words || !Shader.WordCount) { return Which + " has no code"; }
	if (Shader.Stage == Stage) { return {}; }
	return Which + " is a " + StageNames[static_cast<size_t>(Shader.Stage)] + " shader, not a " + StageNames[static_cast<size_t>(Stage)] +
	       " shader";
}

/// Checks one member of a group: the shader at Index must be of Stage. If bRequired, NoShader is wrong.
std::string CheckSlot(const FRTRayTracingPipelineDesc& Desc, uint32_t Index, ERTShaderStage Stage, bool bAllowed, bool bRequired)
{
	const std::string Name = StageNames[static_cast<size_t>(Stage)];
	if (Index == NoShader) { return bRequired ? "has no " + Name + " shader" : ""; }
	if (!bAllowed) { return "may have no " + Name + " shader"; }
	if (Index >= Desc.ShaderCount) { return Print("has shader %u of %u", Index, Desc.ShaderCount); }
	if (Desc.Shaders[Index].Stage == Stage) { return {}; }
	return "has as " + Name + " shader one of another stage";
}

std::string CheckGroup(const FRTRayTracingPipelineDesc& Desc, const FRTShaderGroup& Group)
{
	const bool bGeneral = Group.Kind == ERTGroupKind::General;
	const bool bProcedural = Group.Kind == ERTGroupKind::Procedural;
	std::string Wrong = CheckSlot(Desc, Group.ClosestHit, ERTShaderStage::ClosestHit, !bGeneral, false);
	if (Wrong.empty()) { Wrong = CheckSlot(Desc, Group.AnyHit, ERTShaderStage::AnyHit, !bGeneral, false); }
	if (Wrong.empty()) { Wrong = CheckSlot(Desc, Group.Intersection, ERTShaderStage::Intersection, bProcedural, bProcedural); }
	if (!Wrong.empty()) { return Wrong; }
	if (!bGeneral) { return Group.General == NoShader ? "" : "is a hit group with a general shader"; }
	if (Group.General == NoShader) { return "has no shader"; }
	if (Group.General >= Desc.ShaderCount) { return Print("has shader %u of %u", Group.General, Desc.ShaderCount); }
	const ERTShaderStage Stage = Desc.Shaders[Group.General].Stage;
	const bool bFits = Stage == ERTShaderStage::RayGen || Stage == ERTShaderStage::Miss || Stage == ERTShaderStage::Callable;
	return bFits ? "" : std::string("is general, but has a ") + StageNames[static_cast<size_t>(Stage)] + " shader";
}

std::string CheckShaders(const FRTRayTracingPipelineDesc& Desc)
{
	for (uint32_t i = 0; i < Desc.ShaderCount; ++i)
	{
		const FRTShaderCode& Shader = Desc.Shaders[i];
		std::string Wrong = CheckShader(Shader, Shader.Stage);
		if (!Wrong.empty()) { return Wrong; }
		if (Shader.Stage < ERTShaderStage::RayGen) { return MakeLabel("shader", Shader.Name) + " is of no ray-tracing stage"; }
	}
	return {};
}

/// Checks everything but the libraries.
std::string CheckRayTracing(const FRTRayTracingPipelineDesc& Desc)
{
	if ((Desc.ShaderCount && !Desc.Shaders) || (Desc.GroupCount && !Desc.Groups) || (Desc.LibraryCount && !Desc.Libraries))
	{
		return "Shaders, Groups or Libraries is null";
	}
	if (Desc.bLibrary && Desc.LibraryCount) { return "a library is not linked from libraries"; }
	if (!Desc.LibraryCount && (!Desc.ShaderCount || !Desc.GroupCount)) { return "no shaders or no groups"; }
	std::string Wrong = CheckShaders(Desc);
	if (!Wrong.empty()) { return Wrong; }
	for (uint32_t i = 0; i < Desc.GroupCount; ++i)
	{
		const std::string WrongGroup = CheckGroup(Desc, Desc.Groups[i]);
		if (!WrongGroup.empty()) { return Print("group %u ", i) + WrongGroup; }
	}
	return {};
}

bool IsRayGen(const FValidatedGroup& Group) { return Group.Kind == ERTGroupKind::General && Group.GeneralStage == ERTShaderStage::RayGen; }

bool IsRayGenOrMiss(const FValidatedGroup& Group)
{
	return Group.Kind == ERTGroupKind::General && Group.GeneralStage != ERTShaderStage::Callable;
}

std::string CheckRaster(const FRTRasterPipelineDesc& Desc)
{
	std::string Wrong = CheckShader(Desc.Vertex, ERTShaderStage::Vertex);
	if (Wrong.empty() && Desc.Fragment.Words) { Wrong = CheckShader(Desc.Fragment, ERTShaderStage::Fragment); }
	if (!Wrong.empty()) { return Wrong; }
	if (Desc.ColorCount && (!Desc.ColorFormats || !Desc.Fragment.Words)) { return "colour targets, but no formats or no fragment shader"; }
	for (uint32_t i = 0; i < Desc.ColorCount; ++i)
	{
		const ERTFormat Format = Desc.ColorFormats[i];
		if (Format == ERTFormat::Unknown || IsDepth(Format) || IsCompressed(Format))
		{
			return Print("colour target %u has no colour format", i);
		}
	}
	if (Desc.DepthFormat != ERTFormat::Unknown && !IsDepth(Desc.DepthFormat)) { return "DepthFormat is no depth format"; }
	return Desc.ColorCount || Desc.DepthFormat != ERTFormat::Unknown ? "" : "neither colour nor depth targets";
}

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

FRTStatus FValidatedDevice::ImportBuffer(const FRTBufferDesc& Desc, const FRTNativeBuffer& Native, IRTBuffer** Out)
{
	const std::string What = "ImportBuffer: " + MakeLabel("buffer", Desc.Name);
	if (!Out) { return State->Fail(What + ": Out is null"); }
	if (!Desc.Size) { return State->Fail(What + ": its size is 0"); }
	if (Desc.Usage == ERTBufferUsage::None) { return State->Fail(What + ": it has no usage"); }
	if (!Native.Handle && !Native.Address) { return State->Fail(What + ": Handle and Address are 0"); }
	if (Native.Address % 16) { return State->Fail(What + ": Address is not a multiple of 16"); }
	TRTRef<IRTBuffer> Inner;
	FRTStatus Status = State->Inner->ImportBuffer(Desc, Native, Inner.ReleaseAndGetAddress());
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
	if (Desc.bCube && (Desc.ArraySize != 6 || Desc.Width != Desc.Height)) { return "a cube has six layers, as wide as high"; }
	const bool bDepth = IsDepth(Desc.Format);
	if (HasAny(Desc.Usage, ERTTextureUsage::Depth) && !bDepth) { return "usage Depth, but not a depth format"; }
	if (bDepth && HasAny(Desc.Usage, ERTTextureUsage::RenderTarget | ERTTextureUsage::Storage))
	{
		return "a depth format cannot have the usage RenderTarget or Storage";
	}
	if (IsSrgb(Desc.Format) && HasAny(Desc.Usage, ERTTextureUsage::Storage)) { return "an sRGB format cannot have the usage Storage"; }
	if (IsCompressed(Desc.Format) && Desc.Usage != ERTTextureUsage::Sampled) { return "a format of blocks has no usage but Sampled"; }
	return {};
}

FRTStatus FValidatedDevice::CreateTexture(const FRTTextureDesc& Desc, IRTTexture** Out)
{
	const std::string What = "CreateTexture: " + MakeLabel("texture", Desc.Name);
	if (!Out) { return State->Fail(What + ": Out is null"); }
	std::string Wrong = Desc.NativeView != 0 ? "NativeView is for imported textures" : CheckTexture(Desc);
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
	std::string Wrong = CheckTexture(Desc);
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
		const uint32_t Least = GetPositionBytes(Section.VertexFormat);
		if (Section.VertexStride < Least || Section.VertexStride % 4)
		{
			return Which + Print("has a vertex stride of %u, not a multiple of 4 from %u", Section.VertexStride, Least);
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
	std::string Wrong = CheckSections(Desc);
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
	std::string Wrong = CheckSections(Desc);
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

FRTStatus FValidatedDevice::CreateCommandList(const char* Name, IRTCommandList** Out, ERTQueue Queue)
{
	if (!Out) { return State->Fail("CreateCommandList: Out is null"); }
	TRTRef<IRTCommandList> Inner;
	FRTStatus Status = State->Inner->CreateCommandList(NameOf(Name), Inner.ReleaseAndGetAddress(), Queue);
	if (Status) { *Out = new FValidatedCommandList(State, std::move(Inner), Name, false, Queue); }
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

// ------------------------------------------------------------------------------------------------ pipelines

FRTStatus FValidatedDevice::CreateComputePipeline(const FRTComputePipelineDesc& Desc, IRTPipeline** Out)
{
	const std::string Named = MakeLabel("pipeline", Desc.Name);
	const std::string Wrong = Out ? CheckShader(Desc.Shader, ERTShaderStage::Compute) : "Out is null";
	if (!Wrong.empty()) { return State->Fail("CreateComputePipeline: " + Named + ": " + Wrong); }
	TRTRef<IRTPipeline> Inner;
	FRTStatus Status = State->Inner->CreateComputePipeline(Desc, Inner.ReleaseAndGetAddress());
	if (Status) { *Out = new FValidatedPipeline(State, Named, std::move(Inner)); }
	return Status;
}

FRTStatus FValidatedDevice::CreateRasterPipeline(const FRTRasterPipelineDesc& Desc, IRTPipeline** Out)
{
	const std::string Named = MakeLabel("pipeline", Desc.Name);
	const std::string Wrong = Out ? CheckRaster(Desc) : "Out is null";
	if (!Wrong.empty()) { return State->Fail("CreateRasterPipeline: " + Named + ": " + Wrong); }
	TRTRef<IRTPipeline> Inner;
	FRTStatus Status = State->Inner->CreateRasterPipeline(Desc, Inner.ReleaseAndGetAddress());
	if (!Status) { return Status; }
	auto* Pipeline = new FValidatedPipeline(State, Named, std::move(Inner));
	Pipeline->PipelineKind = EPipelineKind::Raster;
	Pipeline->ColorFormats.assign(Desc.ColorFormats, Desc.ColorFormats + Desc.ColorCount);
	Pipeline->DepthFormat = Desc.DepthFormat;
	*Out = Pipeline;
	return Status;
}

std::string FValidatedDevice::CheckLibraries(const FRTRayTracingPipelineDesc& Desc, std::vector<FValidatedPipeline*>& OutLibraries) const
{
	for (uint32_t i = 0; i < Desc.LibraryCount; ++i)
	{
		auto* Library = State->Find<FValidatedPipeline>(Desc.Libraries[i]);
		if (!Library) { return Print("library %u is null, released, or not of this device", i); }
		if (!Library->bLibrary) { return Library->Label + " is no library (bLibrary)"; }
		const std::pair<const char*, std::pair<uint32_t, uint32_t>> Sizes[] = {
		    {"MaxRecursion", {Desc.MaxRecursion, Library->MaxRecursion}},
		    {"MaxPayloadBytes", {Desc.MaxPayloadBytes, Library->MaxPayloadBytes}},
		    {"MaxAttributeBytes", {Desc.MaxAttributeBytes, Library->MaxAttributeBytes}},
		};
		for (const auto& [Name, Values] : Sizes)
		{
			if (Values.first != Values.second)
			{
				return Library->Label + Print(" was made with %s %u, the link has %u", Name, Values.second, Values.first);
			}
		}
		// A device without any libraries says so itself.
		if (State->Inner->GetCapabilities().bPipelineLibraries && !State->Inner->GetCapabilities().bLibraryOnlyPipelines &&
		    std::any_of(Library->Groups.begin(), Library->Groups.end(), IsRayGenOrMiss))
		{
			return Library->Label + " has ray generation or miss groups, which must be the link's own on this device";
		}
		OutLibraries.push_back(Library);
	}
	return {};
}

FRTStatus FValidatedDevice::CreateRayTracingPipeline(const FRTRayTracingPipelineDesc& Desc, IRTPipeline** Out)
{
	const std::string Named = MakeLabel("pipeline", Desc.Name);
	std::string Wrong = Out ? CheckRayTracing(Desc) : "Out is null";
	std::vector<FValidatedPipeline*> Libraries;
	if (Wrong.empty()) { Wrong = CheckLibraries(Desc, Libraries); }
	std::vector<FValidatedGroup> Groups;
	for (uint32_t i = 0; Wrong.empty() && i < Desc.GroupCount; ++i)
	{
		const FRTShaderGroup& Group = Desc.Groups[i];
		const bool bGeneral = Group.Kind == ERTGroupKind::General;
		Groups.push_back({Group.Kind, bGeneral ? Desc.Shaders[Group.General].Stage : ERTShaderStage::RayGen});
	}
	std::vector<IRTPipeline*> Inners;
	for (const FValidatedPipeline* Library : Libraries)
	{
		Groups.insert(Groups.end(), Library->Groups.begin(), Library->Groups.end());
		Inners.push_back(Library->Inner.Get());
	}
	if (Wrong.empty() && !Desc.bLibrary && std::none_of(Groups.begin(), Groups.end(), IsRayGen))
	{
		Wrong = "no group has a ray generation shader";
	}
	const uint32_t Depth = GetCapabilities().MaxRayRecursionDepth;
	// A device without ray-tracing pipelines says so itself: that is no wrong use.
	if (Wrong.empty() && GetCapabilities().bRayTracingPipeline && Desc.MaxRecursion > Depth)
	{
		Wrong = Print("MaxRecursion %u, the device allows %u", Desc.MaxRecursion, Depth);
	}
	if (!Wrong.empty()) { return State->Fail("CreateRayTracingPipeline: " + Named + ": " + Wrong); }
	FRTRayTracingPipelineDesc Mine = Desc;
	Mine.Libraries = Inners.data();
	TRTRef<IRTPipeline> Inner;
	FRTStatus Status = State->Inner->CreateRayTracingPipeline(Mine, Inner.ReleaseAndGetAddress());
	if (!Status) { return Status; }
	auto* Pipeline = new FValidatedPipeline(State, Named, std::move(Inner));
	Pipeline->PipelineKind = EPipelineKind::RayTracing;
	Pipeline->bLibrary = Desc.bLibrary;
	Pipeline->MaxRecursion = Desc.MaxRecursion;
	Pipeline->MaxPayloadBytes = Desc.MaxPayloadBytes;
	Pipeline->MaxAttributeBytes = Desc.MaxAttributeBytes;
	Pipeline->Groups = std::move(Groups);
	*Out = Pipeline;
	return Status;
}

} // namespace Lantern
