// FValidatedDevice: creation of pipelines.
#include "ValidationDeviceImpl.h"

#include <algorithm>
#include <utility>

namespace Lantern
{
namespace
{

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
		const std::string Wrong = CheckShader(Shader, Shader.Stage);
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
	const std::string Wrong = CheckShaders(Desc);
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
		if (Format == ERTFormat::Unknown || Format == ERTFormat::D32_FLOAT) { return Print("colour target %u has no colour format", i); }
	}
	if (Desc.DepthFormat != ERTFormat::Unknown && Desc.DepthFormat != ERTFormat::D32_FLOAT) { return "DepthFormat is no depth format"; }
	return Desc.ColorCount || Desc.DepthFormat != ERTFormat::Unknown ? "" : "neither colour nor depth targets";
}

} // namespace

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
