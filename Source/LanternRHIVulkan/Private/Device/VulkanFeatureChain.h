// An engine's lists for vkCreateDevice, checked and joined with what Lantern needs.
#pragma once

#include "Device/VulkanCapabilities.h"
#include "LanternRHIVulkan/VulkanInterop.h"

namespace Lantern
{

/// InvalidArgument names what cannot stand beside the structures that Lantern adds. Changes nothing.
FRTStatus CheckEngineLists(const FRTVulkanRequirementsDesc& Desc);

/// Adds what an engine's extension demands of the structures that Lantern adds (VkDeviceCreateInfo, "Valid Usage").
void EnableFeaturesOfExtension(const char* Extension, FVulkanFeatures& Features);

/// Moves Ours into the engine's lists: flags are switched on in structures that the engine has, others are appended. Returns the
/// head for VkDeviceCreateInfo::pNext. Ours must be linked and must live until vkCreateDevice has returned.
const void* JoinFeatures(FVulkanFeatures& Ours, void* EngineChain, VkPhysicalDeviceFeatures* EngineFeatures);

} // namespace Lantern
