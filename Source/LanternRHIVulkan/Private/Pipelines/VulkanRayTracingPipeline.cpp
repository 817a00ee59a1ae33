// Ray-tracing pipelines: monolithic, libraries, and linked from libraries.
#include "Pipelines/VulkanPipeline.h"

#include "Device/VulkanQuirks.h"
#include "Pipelines/VulkanShaderModules.h"

#include "LanternRHI/RTText.h"

#include <algorithm>
#include <iterator>

namespace Lantern
{

namespace
{

VkRayTracingShaderGroupTypeKHR GroupTypeOf(ERTGroupKind Kind)
{
	switch (Kind)
	{
	case ERTGroupKind::General: return VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR;
	case ERTGroupKind::Triangles: return VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR;
	case ERTGroupKind::Procedural: return VK_RAY_TRACING_SHADER_GROUP_TYPE_PROCEDURAL_HIT_GROUP_KHR;
	}
	return VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR;
}

/// The closest-hit shader `void main() {}`, compiled by glslang.
constexpr uint32_t EmptyClosestHit[] = {0x07230203, 0x00010500, 0x0008000b, 0x00000006, 0x00000000, 0x00020011, 0x0000117f, 0x0006000a,
    0x5f565053, 0x5f52484b, 0x5f796172, 0x63617274, 0x00676e69, 0x0006000b, 0x00000001, 0x4c534c47, 0x6474732e, 0x3035342e, 0x00000000,
    0x0003000e, 0x00000000, 0x00000001, 0x0005000f, 0x000014c4, 0x00000004, 0x6e69616d, 0x00000000, 0x00020013, 0x00000002, 0x00030021,
    0x00000003, 0x00000002, 0x00050036, 0x00000002, 0x00000004, 0x00000000, 0x00000003, 0x000200f8, 0x00000005, 0x000100fd, 0x00010038};

using FGroups = std::vector<VkRayTracingShaderGroupCreateInfoKHR>;

FGroups MakeGroups(const FRTRayTracingPipelineDesc& Desc)
{
	static_assert(NoShader == VK_SHADER_UNUSED_KHR, "indices are passed on as they are");
	FGroups Groups(Desc.GroupCount);
	for (uint32_t Index = 0; Index < Desc.GroupCount; ++Index)
	{
		const FRTShaderGroup& Group = Desc.Groups[Index];
		Groups[Index] = {VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR};
		Groups[Index].type = GroupTypeOf(Group.Kind);
		Groups[Index].generalShader = Group.General;
		Groups[Index].closestHitShader = Group.ClosestHit;
		Groups[Index].anyHitShader = Group.AnyHit;
		Groups[Index].intersectionShader = Group.Intersection;
	}
	return Groups;
}

bool HasHitShader(const FGroups& Groups)
{
	return std::any_of(Groups.begin(), Groups.end(), [](const VkRayTracingShaderGroupCreateInfoKHR& Group) {
		return Group.closestHitShader != NoShader || Group.anyHitShader != NoShader;
	});
}

/// Adds a group behind those asked for, which no shader table knows of (EVulkanQuirk::CrashWithoutHitShaders).
FRTStatus AddUnusedHitShader(FVulkanModules& Modules, FGroups& Groups)
{
	VkRayTracingShaderGroupCreateInfoKHR Group{VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR};
	Group.type = VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR;
	Group.generalShader = Group.anyHitShader = Group.intersectionShader = VK_SHADER_UNUSED_KHR;
	Group.closestHitShader = static_cast<uint32_t>(Modules.Stages.size());
	Groups.push_back(Group);
	return Modules.Add({EmptyClosestHit, std::size(EmptyClosestHit), ERTShaderStage::ClosestHit, "EmptyClosestHit"});
}

FRTStatus CheckSupport(const FVulkanDevice& Device, const FRTRayTracingPipelineDesc& Desc)
{
	const FRTCapabilities& Caps = Device.GetCapabilities();
	if (!Caps.bRayTracingPipeline)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "'%s': the device has no ray-tracing pipelines", FRTShown(Desc.Name).Text);
	}
	if (Desc.MaxRecursion > Caps.MaxRayRecursionDepth)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "'%s' needs recursion %u; the device's limit is %u", FRTShown(Desc.Name).Text,
		    Desc.MaxRecursion, Caps.MaxRayRecursionDepth);
	}
	if (Desc.LibraryCount == 0 && !Desc.bLibrary) { return {}; }
	if (!Caps.bPipelineLibraries)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "'%s': the device has no pipeline libraries", FRTShown(Desc.Name).Text);
	}
	if (!Desc.bLibrary && Desc.GroupCount == 0 && !Caps.bLibraryOnlyPipelines)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "'%s': this driver needs ray generation and miss groups among the link's own",
		    FRTShown(Desc.Name).Text);
	}
	return {};
}

/// What the creation of a pipeline points at. It points into itself: do not copy it.
struct FRayTracingState
{
	explicit FRayTracingState(const FRTRayTracingPipelineDesc& Desc)
	{
		for (uint32_t Index = 0; Index < Desc.LibraryCount; ++Index)
		{
			const FVulkanPipeline* Library = static_cast<const FVulkanPipeline*>(Desc.Libraries[Index]);
			assert(Library->IsLibrary());
			Libraries.push_back(Library->Handle);
		}
		LibraryInfo.libraryCount = Desc.LibraryCount;
		LibraryInfo.pLibraries = Libraries.data();
		Interface.maxPipelineRayPayloadSize = Desc.MaxPayloadBytes;
		Interface.maxPipelineRayHitAttributeSize = Desc.MaxAttributeBytes;
		Info.maxPipelineRayRecursionDepth = Desc.MaxRecursion;
		Info.flags = Desc.bLibrary ? VK_PIPELINE_CREATE_LIBRARY_BIT_KHR : 0;
		if (Desc.LibraryCount > 0) { Info.pLibraryInfo = &LibraryInfo; }
		if (Desc.LibraryCount > 0 || Desc.bLibrary) { Info.pLibraryInterface = &Interface; }
	}
	FRayTracingState(const FRayTracingState&) = delete;
	FRayTracingState& operator=(const FRayTracingState&) = delete;

	std::vector<VkPipeline> Libraries;
	VkPipelineLibraryCreateInfoKHR LibraryInfo{VK_STRUCTURE_TYPE_PIPELINE_LIBRARY_CREATE_INFO_KHR};
	VkRayTracingPipelineInterfaceCreateInfoKHR Interface{VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_INTERFACE_CREATE_INFO_KHR};
	VkRayTracingPipelineCreateInfoKHR Info{VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR};
};

} // namespace

FRTStatus FVulkanPipeline::InitialiseRayTracing(const FRTRayTracingPipelineDesc& Desc)
{
	FRTStatus Status = CheckSupport(Device, Desc);
	FVulkanModules Modules(Device);
	for (uint32_t Index = 0; Status && Index < Desc.ShaderCount; ++Index) { Status = Modules.Add(Desc.Shaders[Index]); }
	if (!Status) { return Status; }
	FGroups Groups = MakeGroups(Desc);
	bHasHitShader = HasHitShader(Groups);
	GroupCount = Desc.GroupCount;
	for (uint32_t Index = 0; Index < Desc.LibraryCount; ++Index)
	{
		// Vulkan does not say that a library may be destroyed before what was linked from it.
		Libraries.emplace_back(static_cast<FVulkanPipeline*>(Desc.Libraries[Index]));
		bHasHitShader = bHasHitShader || Libraries.back()->bHasHitShader;
		GroupCount += Libraries.back()->GroupCount;
	}
	bLibrary = Desc.bLibrary;
	if (!bLibrary && !bHasHitShader && HasQuirk(Device.Probe.Quirks, EVulkanQuirk::CrashWithoutHitShaders))
	{
		Status = AddUnusedHitShader(Modules, Groups);
		if (!Status) { return Status; }
	}
	BindPoint = VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR;
	FRayTracingState State(Desc);
	State.Info.stageCount = static_cast<uint32_t>(Modules.Stages.size());
	State.Info.pStages = Modules.Stages.data();
	State.Info.groupCount = static_cast<uint32_t>(Groups.size());
	State.Info.pGroups = Groups.data();
	State.Info.layout = Device.Bindless.PipelineLayout;
	const VkPipelineCache Cache = bLibrary && !Device.bCacheLibraries ? VK_NULL_HANDLE : Device.Cache.Handle;
	Status = Finish(Device.Api.CreateRayTracingPipelinesKHR(Device.Handle, VK_NULL_HANDLE, Cache, 1, &State.Info, nullptr, &Handle),
	    "Creating ray-tracing pipeline", Desc.Name);
	if (!Status || bLibrary) { return Status; }
	return ReadGroupHandles(Desc.GroupCount, static_cast<uint32_t>(Groups.size()), Desc.Name);
}

FRTStatus FVulkanPipeline::ReadGroupHandles(uint32_t OwnCount, uint32_t NativeOwnCount, const char* Name)
{
	const size_t HandleSize = Device.GetCapabilities().ShaderGroupHandleSize;
	GroupHandles.resize(GroupCount * HandleSize);
	const auto Read = [&](uint32_t NativeFirst, uint32_t First, uint32_t Count) {
		return Count == 0 ? VK_SUCCESS
		                  : Device.Check(Device.Api.GetRayTracingShaderGroupHandlesKHR(
		                        Device.Handle, Handle, NativeFirst, Count, Count * HandleSize, GroupHandles.data() + First * HandleSize));
	};
	VkResult Result = Read(0, 0, OwnCount);
	Result = Result ? Result : Read(NativeOwnCount, OwnCount, GroupCount - OwnCount);
	return MakeStatus(Result, "Reading the group handles of", Name);
}

} // namespace Lantern
