// Adopts an engine's VkDevice. It is separate, so that an engine on another API, or one that lets Lantern create
// the device, needs no Vulkan header.
//
// The order of calls: GetRequirements for the VkPhysicalDevice with the engine's own lists, vkCreateDevice, AdoptDevice.
// LanternRHIVulkan/VulkanInterop.h has the types and the rules.
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
