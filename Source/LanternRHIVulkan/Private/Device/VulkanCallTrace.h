// Times each call of Vulkan, to find which one makes a frame wait.
#pragma once

#include "Device/VulkanApi.h"
#include "LanternRHIVulkan/VulkanDevice.h"

namespace Lantern
{

/// Replaces the functions of a device's table by ones that tell Sink, which all devices of the process share from now on. A device
/// whose table was left alone pays nothing.
void TraceVulkanCalls(const FVulkanInstanceApi& Instance, VkInstance Handle, const FRTVulkanCallSink& Sink, FVulkanDeviceApi& Api);

/// Finds functions as vkGetDeviceProcAddr does. Those that allocate memory, and what belongs to it, tell the sink. After
/// TraceVulkanCalls.
PFN_vkVoidFunction VKAPI_CALL GetTracedDeviceProcAddr(VkDevice Device, const char* Name);

} // namespace Lantern
