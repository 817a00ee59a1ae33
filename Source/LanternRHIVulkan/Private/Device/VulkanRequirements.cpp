// What an engine's vkCreateDevice must enable, with the engine's own lists in it.
#include "Device/VulkanRequirements.h"

#include "Device/VulkanFeatureChain.h"
#include "Device/VulkanStatus.h"

#include <algorithm>

namespace Lantern
{

FVulkanRequirements::FVulkanRequirements(const FVulkanProbe& InProbe, const FRTVulkanRequirementsDesc& Desc)
    : Probe(InProbe),
      EngineChain(Desc.FeatureChain),
      EngineFeatures(Desc.EnabledFeatures)
{
	Names.reserve(Desc.ExtensionCount + Probe.Extensions.size()); // strings must stay where they are
	const auto Add = [&](const char* Name) {
		if (std::find(Names.begin(), Names.end(), Name) == Names.end()) { Names.emplace_back(Name); }
	};
	for (uint32_t Index = 0; Index < Desc.ExtensionCount; ++Index)
	{
		Add(Desc.Extensions[Index]);
		EnableFeaturesOfExtension(Desc.Extensions[Index], Probe.Features);
	}
	for (const char* Name : Probe.Extensions) { Add(Name); }
	for (const std::string& Name : Names) { Extensions.push_back(Name.c_str()); }
}

const void* FVulkanRequirements::MergeFeatures()
{
	if (Head == nullptr)
	{
		Probe.Features.Link(Probe.Extensions);
		Head = JoinFeatures(Probe.Features, EngineChain, EngineFeatures);
	}
	return Head;
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

namespace
{

FRTStatus CheckDesc(const FRTVulkanRequirementsDesc& Desc)
{
	if (!Desc.Instance || !Desc.PhysicalDevice)
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "FRTVulkanRequirementsDesc::%s is null", Desc.Instance ? "PhysicalDevice" : "Instance");
	}
	if (Desc.InstanceVersion < VK_API_VERSION_1_3)
	{
		const uint32_t Version = std::max(Desc.InstanceVersion, VK_API_VERSION_1_0); // 0 is 1.0 (VkApplicationInfo)
		return FRTStatus::Error(ERTResult::Unsupported,
		    "The Vulkan instance was created for Vulkan %u.%u (FRTVulkanRequirementsDesc::InstanceVersion); Lantern needs 1.3 of it, "
		    "whatever the device can do.",
		    VK_API_VERSION_MAJOR(Version), VK_API_VERSION_MINOR(Version));
	}
	return CheckEngineLists(Desc);
}

} // namespace

FRTStatus GetVulkanRequirements(const FRTVulkanRequirementsDesc& Desc, IRTVulkanRequirements** Out)
{
	*Out = nullptr;
	if (const FRTStatus Status = CheckDesc(Desc); !Status) { return Status; }
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
	*Out = new FVulkanRequirements(Probe, Desc);
	return {};
}

} // namespace Lantern
