// What an engine's vkCreateDevice must enable, and how it joins the engine's feature chain.
#include "Device/VulkanRequirements.h"

#include "Device/VulkanStatus.h"

#include <cassert>

namespace Lantern
{

namespace
{

/// A feature structure is sType, pNext, and VkBool32s up to its end.
template <class T>
void MergeBools(void* Into, const void* From)
{
	constexpr size_t First = sizeof(VkBaseOutStructure);
	static_assert((sizeof(T) - First) % sizeof(VkBool32) == 0);
	VkBool32* Dest = reinterpret_cast<VkBool32*>(static_cast<char*>(Into) + First);
	const VkBool32* Source = reinterpret_cast<const VkBool32*>(static_cast<const char*>(From) + First);
	// Padding at the end of an odd number of flags is merged too, which does no harm.
	for (size_t Index = 0; Index < (sizeof(T) - First) / sizeof(VkBool32); ++Index) { Dest[Index] |= Source[Index]; }
}

void MergeStructure(VkBaseOutStructure* Into, const VkBaseOutStructure* From)
{
	switch (From->sType)
	{
	case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES: return MergeBools<VkPhysicalDeviceVulkan11Features>(Into, From);
	case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES: return MergeBools<VkPhysicalDeviceVulkan12Features>(Into, From);
	case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES: return MergeBools<VkPhysicalDeviceVulkan13Features>(Into, From);
	case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR:
		return MergeBools<VkPhysicalDeviceAccelerationStructureFeaturesKHR>(Into, From);
	case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR:
		return MergeBools<VkPhysicalDeviceRayTracingPipelineFeaturesKHR>(Into, From);
	case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_OPACITY_MICROMAP_FEATURES_EXT:
		return MergeBools<VkPhysicalDeviceOpacityMicromapFeaturesEXT>(Into, From);
	default: return MergeBools<VkPhysicalDeviceRayQueryFeaturesKHR>(Into, From); // those of one flag
	}
}

VkBaseOutStructure* FindStructure(VkBaseOutStructure* Chain, VkStructureType Type)
{
	while (Chain && Chain->sType != Type) { Chain = Chain->pNext; }
	return Chain;
}

} // namespace

void FVulkanRequirements::MergeInto(VkPhysicalDeviceFeatures2* EngineChain)
{
	assert(EngineChain && EngineChain != &Probe.Features.Core);
	VkBaseOutStructure* Head = reinterpret_cast<VkBaseOutStructure*>(EngineChain);
	VkBaseOutStructure* Tail = Head;
	while (Tail->pNext) { Tail = Tail->pNext; }
	MergeBools<VkPhysicalDeviceFeatures2>(EngineChain, &Probe.Features.Core);
	VkBaseOutStructure* Next = static_cast<VkBaseOutStructure*>(Probe.Features.Core.pNext);
	Probe.Features.Core.pNext = nullptr; // its structures now belong to the engine's chain
	while (Next)
	{
		VkBaseOutStructure* Ours = Next;
		Next = Next->pNext;
		Ours->pNext = nullptr;
		if (VkBaseOutStructure* Theirs = FindStructure(Head, Ours->sType)) { MergeStructure(Theirs, Ours); }
		else
		{
			Tail->pNext = Ours;
			Tail = Ours;
		}
	}
}

std::string DescribeProbe(const FVulkanProbe& Probe)
{
	std::string Text = Probe.Capabilities.DeviceName;
	Text += " (";
	Text += Probe.Capabilities.DriverName[0] ? Probe.Capabilities.DriverName : "driver older than Vulkan 1.3";
	Text += ") lacks ";
	std::string Missing = Probe.Missing;
	while (!Missing.empty() && Missing.back() == '\n') { Missing.pop_back(); }
	for (size_t At = Missing.find('\n'); At != std::string::npos; At = Missing.find('\n', At)) { Missing.replace(At, 1, "; "); }
	return Text + (Missing.empty() ? "nothing, but ray tracing was switched off by request" : Missing);
}

FRTStatus GetVulkanRequirements(const FRTVulkanRequirementsDesc& Desc, IRTVulkanRequirements** Out)
{
	*Out = nullptr;
	PFN_vkGetInstanceProcAddr GetInstanceProcAddr = Desc.GetInstanceProcAddr;
	if (!GetInstanceProcAddr)
	{
		FVulkanLoader Loader;
		FRTStatus Status = OpenVulkanLoader(&Loader);
		if (!Status) { return Status; }
		GetInstanceProcAddr = Loader.GetInstanceProcAddr;
	}
	FVulkanInstanceApi Api;
	FRTStatus Status = LoadInstanceApi(GetInstanceProcAddr, Desc.Instance, &Api);
	if (!Status) { return Status; }
	FVulkanProbe Probe;
	ProbeVulkanDevice(Api, Desc.PhysicalDevice, {Desc.MaxRung, Desc.bDisableRayQuery, Desc.bDisablePipeline}, &Probe);
	if (!Probe.bUsable || (Probe.Capabilities.Rung == ERTRung::None && !Desc.bAllowNoRayTracing))
	{
		return FRTStatus::Error(ERTResult::Unsupported, "%s", DescribeProbe(Probe).c_str());
	}
	*Out = new FVulkanRequirements(Probe);
	return {};
}

} // namespace Lantern
