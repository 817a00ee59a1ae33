// Handing an engine's VkDevice to the plugin. Apart from Module.h, so that an engine on another API, or one that
// lets Lantern make its own device, needs no Vulkan header.
//
// Order and rules are those of LanternRHIVulkan/VulkanInterop.h, whose types these are: GetRequirements for the
// VkPhysicalDevice, enable what it lists in vkCreateDevice, AdoptDevice.
#pragma once

#include "LanternModule/Module.h"
#include "LanternRHIVulkan/VulkanInterop.h"

namespace Lantern
{

class IRTModuleVulkan
{
public:
	virtual FRTStatus GetRequirements(const FRTVulkanRequirementsDesc& Desc, IRTVulkanRequirements** Out) = 0;
	virtual FRTStatus AdoptDevice(const FRTVulkanExternalDesc& Desc, IRTDevice** Out) = 0;

protected:
	~IRTModuleVulkan() = default;
};

} // namespace Lantern
