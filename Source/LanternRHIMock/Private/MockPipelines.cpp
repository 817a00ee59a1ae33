// FMockDevice: creation of pipelines, libraries and links.

#include "LanternRHI/RTText.h"
#include "MockDeviceImpl.h"
#include "MockTableHandle.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstring>
#include <thread>

namespace Lantern
{
namespace
{

std::string GetShaderName(const FRTRayTracingPipelineDesc& Desc, uint32_t Index)
{
	if (Index == NoShader) { return {}; }
	assert(Index < Desc.ShaderCount);
	return Desc.Shaders[Index].Name ? Desc.Shaders[Index].Name : "";
}

std::vector<FMockGroup> MakeOwnGroups(const FRTRayTracingPipelineDesc& Desc)
{
	std::vector<FMockGroup> Groups;
	for (uint32_t i = 0; i < Desc.GroupCount; ++i)
	{
		const FRTShaderGroup& Group = Desc.Groups[i];
		FMockGroup& Mine = Groups.emplace_back();
		Mine.Kind = Group.Kind;
		Mine.General = GetShaderName(Desc, Group.General);
		Mine.ClosestHit = GetShaderName(Desc, Group.ClosestHit);
		Mine.AnyHit = GetShaderName(Desc, Group.AnyHit);
		Mine.Intersection = GetShaderName(Desc, Group.Intersection);
		if (Group.General != NoShader) { Mine.GeneralStage = Desc.Shaders[Group.General].Stage; }
	}
	return Groups;
}

/// Says whether drivers without bLibraryOnlyPipelines need the group in the link: from a library, it would see no push constants.
bool IsBoundToLink(const FMockGroup& Group)
{
	return Group.Kind == ERTGroupKind::General && Group.GeneralStage != ERTShaderStage::Callable;
}

std::vector<uint8_t> MakeHandles(const FMockPipeline& Pipeline, uint32_t HandleSize)
{
	std::vector<uint8_t> Handles(static_cast<size_t>(Pipeline.GetGroupCount()) * HandleSize);
	for (uint32_t Group = 0; Group < Pipeline.GetGroupCount(); ++Group)
	{
		const FMockHandle Handle(Pipeline.Id, Group);
		std::memcpy(Handles.data() + static_cast<size_t>(Group) * HandleSize, &Handle, sizeof(Handle));
	}
	return Handles;
}

} // namespace

FRTStatus FMockDevice::Compile(const char* Name)
{
	const std::string Whole = Name ? Name : "";
	const auto IsPart = [&](const std::string& Part) { return Whole.find(Part) != std::string::npos; };
	uint32_t Milliseconds = 0;
	std::unique_lock Lock(State->Mutex);
	for (const auto& [Part, Delay] : State->Slow) { Milliseconds += IsPart(Part) ? Delay : 0; }
	const bool bFail = std::any_of(State->Failing.begin(), State->Failing.end(), IsPart);
	const auto IsHeld = [&] { return std::any_of(State->Held.begin(), State->Held.end(), IsPart); };
	if (Milliseconds || IsHeld())
	{
		++State->CompilesInDriver;
		State->HoldEnded.wait(Lock, [&] { return !IsHeld(); });
		Lock.unlock();
		std::this_thread::sleep_for(std::chrono::milliseconds(Milliseconds));
		Lock.lock();
		--State->CompilesInDriver;
	}
	Lock.unlock();
	if (bFail) { return FRTStatus::Error(ERTResult::CompileFailed, "%s: compile failed (mock, injected)", Whole.c_str()); }
	return FRTStatus::Success();
}

FRTStatus FMockDevice::CreateComputePipeline(const FRTComputePipelineDesc& Desc, IRTPipeline** Out)
{
	FRTStatus Status = Start(ERTMockCall::CreateComputePipeline, Desc.Name, {Desc.Shader.WordCount});
	if (Status) { Status = Compile(Desc.Name); }
	if (!Status) { return Status; }
	auto Pipeline = std::make_unique<FMockPipeline>(State, "Pipeline", Desc.Name);
	return Finish(*State, std::move(Pipeline), EMockMemory::None, 0, Out);
}

FRTStatus FMockDevice::CreateRasterPipeline(const FRTRasterPipelineDesc& Desc, IRTPipeline** Out)
{
	FRTStatus Status = Start(ERTMockCall::CreateRasterPipeline, Desc.Name, {Desc.ColorCount});
	if (Status) { Status = Compile(Desc.Name); }
	if (!Status) { return Status; }
	auto Pipeline = std::make_unique<FMockPipeline>(State, "Pipeline", Desc.Name);
	Pipeline->Kind = EMockPipeline::Raster;
	return Finish(*State, std::move(Pipeline), EMockMemory::None, 0, Out);
}

void FMockDevice::CheckLibrary(const FMockPipeline& Link, const FMockPipeline& Library)
{
	const std::string What = Link.Name + ": linked from " + Library.Name;
	if (!Library.bLibrary) { State->AddError(What + ", which is no library"); }
	if (Library.Interface != Link.Interface) { State->AddError(What + " of other recursion, payload or attribute sizes"); }
	const std::vector<FMockGroup>& Groups = *Library.Groups;
	if (!State->Capabilities.bLibraryOnlyPipelines && std::any_of(Groups.begin(), Groups.end(), IsBoundToLink))
	{
		State->AddError(What + " with ray generation or miss groups, which the device needs among the link's own");
	}
}

FRTStatus FMockDevice::CreateRayTracingPipeline(const FRTRayTracingPipelineDesc& Desc, IRTPipeline** Out)
{
	FRTStatus Status = Start(ERTMockCall::CreateRayTracingPipeline, Desc.Name,
	    {Desc.ShaderCount, Desc.GroupCount, Desc.MaxRecursion, Desc.MaxPayloadBytes, Desc.LibraryCount, Desc.bLibrary ? 1u : 0u});
	if (!Status) { return Status; }
	if (!State->Capabilities.bRayTracingPipeline)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "%s: the device has no ray-tracing pipelines", FRTShown(Desc.Name).Text);
	}
	if ((Desc.bLibrary || Desc.LibraryCount) && !State->Capabilities.bPipelineLibraries)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "%s: the device has no pipeline libraries", FRTShown(Desc.Name).Text);
	}
	assert(!Desc.bLibrary || (Desc.ShaderCount && !Desc.LibraryCount));
	Status = Compile(Desc.Name);
	if (!Status) { return Status; }
	auto Pipeline = std::make_unique<FMockPipeline>(State, Desc.bLibrary ? "Library" : "Pipeline", Desc.Name);
	Pipeline->Kind = EMockPipeline::RayTracing;
	Pipeline->bLibrary = Desc.bLibrary;
	Pipeline->Interface = {Desc.MaxRecursion, Desc.MaxPayloadBytes, Desc.MaxAttributeBytes};
	std::vector<FMockGroup> Groups = MakeOwnGroups(Desc);
	for (uint32_t i = 0; i < Desc.LibraryCount; ++i)
	{
		const auto* Library = static_cast<const FMockPipeline*>(Desc.Libraries[i]);
		assert(Library && Library->Kind == EMockPipeline::RayTracing);
		CheckLibrary(*Pipeline, *Library);
		Groups.insert(Groups.end(), Library->Groups->begin(), Library->Groups->end());
	}
	Pipeline->Groups = std::make_shared<const std::vector<FMockGroup>>(std::move(Groups));
	{
		std::lock_guard Lock(State->Mutex);
		Pipeline->Id = State->NextPipeline++;
		State->Pipelines[Pipeline->Id] = Pipeline->Name;
	}
	Pipeline->Handles = MakeHandles(*Pipeline, State->Desc.HandleSize);
	return Finish(*State, std::move(Pipeline), EMockMemory::None, 0, Out);
}

} // namespace Lantern
