// Function tables of the Vulkan API, one for each instance and one for each device. They are our own rather than volk's globals,
// because the plugin is linked into engines that may carry volk or link the loader themselves.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>

#include "LanternRHI/RTTypes.h"

namespace Lantern
{

#define LANTERN_VK_INSTANCE_FUNCTIONS(X)                                                                                                   \
	X(DestroyInstance)                                                                                                                     \
	X(EnumeratePhysicalDevices)                                                                                                            \
	X(GetPhysicalDeviceProperties2)                                                                                                        \
	X(GetPhysicalDeviceProperties)                                                                                                         \
	X(GetPhysicalDeviceFeatures2)                                                                                                          \
	X(GetPhysicalDeviceQueueFamilyProperties)                                                                                              \
	X(GetPhysicalDeviceMemoryProperties)                                                                                                   \
	X(GetPhysicalDeviceFormatProperties)                                                                                                   \
	X(GetPhysicalDeviceImageFormatProperties)                                                                                              \
	X(EnumerateDeviceExtensionProperties)                                                                                                  \
	X(CreateDevice)                                                                                                                        \
	X(GetDeviceProcAddr)

/// Null without VK_EXT_debug_utils: check before use.
#define LANTERN_VK_DEBUG_FUNCTIONS(X)                                                                                                      \
	X(CreateDebugUtilsMessengerEXT)                                                                                                        \
	X(DestroyDebugUtilsMessengerEXT)                                                                                                       \
	X(SetDebugUtilsObjectNameEXT)                                                                                                          \
	X(CmdBeginDebugUtilsLabelEXT)                                                                                                          \
	X(CmdEndDebugUtilsLabelEXT)

#define LANTERN_VK_DEVICE_FUNCTIONS(X)                                                                                                     \
	X(DestroyDevice)                                                                                                                       \
	X(GetDeviceQueue)                                                                                                                      \
	X(DeviceWaitIdle)                                                                                                                      \
	X(QueueWaitIdle)                                                                                                                       \
	X(QueueSubmit2)                                                                                                                        \
	X(CreateSemaphore)                                                                                                                     \
	X(DestroySemaphore)                                                                                                                    \
	X(GetSemaphoreCounterValue)                                                                                                            \
	X(WaitSemaphores)                                                                                                                      \
	X(CreateCommandPool)                                                                                                                   \
	X(DestroyCommandPool)                                                                                                                  \
	X(ResetCommandPool)                                                                                                                    \
	X(AllocateCommandBuffers)                                                                                                              \
	X(BeginCommandBuffer)                                                                                                                  \
	X(EndCommandBuffer)                                                                                                                    \
	X(CreateQueryPool)                                                                                                                     \
	X(DestroyQueryPool)                                                                                                                    \
	X(ResetQueryPool)                                                                                                                      \
	X(GetQueryPoolResults)                                                                                                                 \
	X(GetBufferDeviceAddress)                                                                                                              \
	X(GetBufferMemoryRequirements)                                                                                                         \
	X(GetImageMemoryRequirements)                                                                                                          \
	X(GetDeviceImageMemoryRequirements)                                                                                                    \
	X(CreateImageView)                                                                                                                     \
	X(DestroyImageView)                                                                                                                    \
	X(CreateSampler)                                                                                                                       \
	X(DestroySampler)                                                                                                                      \
	X(CreateDescriptorSetLayout)                                                                                                           \
	X(DestroyDescriptorSetLayout)                                                                                                          \
	X(CreateDescriptorPool)                                                                                                                \
	X(DestroyDescriptorPool)                                                                                                               \
	X(AllocateDescriptorSets)                                                                                                              \
	X(UpdateDescriptorSets)                                                                                                                \
	X(CreatePipelineLayout)                                                                                                                \
	X(DestroyPipelineLayout)                                                                                                               \
	X(CreateShaderModule)                                                                                                                  \
	X(DestroyShaderModule)                                                                                                                 \
	X(CreatePipelineCache)                                                                                                                 \
	X(DestroyPipelineCache)                                                                                                                \
	X(GetPipelineCacheData)                                                                                                                \
	X(CreateComputePipelines)                                                                                                              \
	X(CreateGraphicsPipelines)                                                                                                             \
	X(DestroyPipeline)                                                                                                                     \
	X(CmdPipelineBarrier2)                                                                                                                 \
	X(CmdCopyBuffer)                                                                                                                       \
	X(CmdCopyBufferToImage)                                                                                                                \
	X(CmdCopyImageToBuffer)                                                                                                                \
	X(CmdFillBuffer)                                                                                                                       \
	X(CmdClearColorImage)                                                                                                                  \
	X(CmdBlitImage)                                                                                                                        \
	X(CmdBindPipeline)                                                                                                                     \
	X(CmdBindDescriptorSets)                                                                                                               \
	X(CmdPushConstants)                                                                                                                    \
	X(CmdDispatch)                                                                                                                         \
	X(CmdDispatchIndirect)                                                                                                                 \
	X(CmdBeginRendering)                                                                                                                   \
	X(CmdEndRendering)                                                                                                                     \
	X(CmdSetViewport)                                                                                                                      \
	X(CmdSetScissor)                                                                                                                       \
	X(CmdBindIndexBuffer)                                                                                                                  \
	X(CmdDraw)                                                                                                                             \
	X(CmdDrawIndexed)                                                                                                                      \
	X(CmdResetQueryPool)                                                                                                                   \
	X(CmdWriteTimestamp2)

#define LANTERN_VK_ACCEL_FUNCTIONS(X)                                                                                                      \
	X(CreateAccelerationStructureKHR)                                                                                                      \
	X(DestroyAccelerationStructureKHR)                                                                                                     \
	X(GetAccelerationStructureBuildSizesKHR)                                                                                               \
	X(GetAccelerationStructureDeviceAddressKHR)                                                                                            \
	X(CmdBuildAccelerationStructuresKHR)                                                                                                   \
	X(CmdCopyAccelerationStructureKHR)                                                                                                     \
	X(CmdWriteAccelerationStructuresPropertiesKHR)

#define LANTERN_VK_PIPELINE_FUNCTIONS(X)                                                                                                   \
	X(CreateRayTracingPipelinesKHR)                                                                                                        \
	X(GetRayTracingShaderGroupHandlesKHR)                                                                                                  \
	X(CmdTraceRaysKHR)                                                                                                                     \
	X(CmdTraceRaysIndirectKHR)

#define LANTERN_VK_DECLARE(Name) PFN_vk##Name Name = nullptr;

/// Functions that need no instance.
struct FVulkanLoader
{
	PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
	PFN_vkCreateInstance CreateInstance = nullptr;
	PFN_vkEnumerateInstanceVersion EnumerateInstanceVersion = nullptr;
	PFN_vkEnumerateInstanceExtensionProperties EnumerateInstanceExtensionProperties = nullptr;
	PFN_vkEnumerateInstanceLayerProperties EnumerateInstanceLayerProperties = nullptr;
};

struct FVulkanInstanceApi
{
	PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
	LANTERN_VK_INSTANCE_FUNCTIONS(LANTERN_VK_DECLARE)
	LANTERN_VK_DEBUG_FUNCTIONS(LANTERN_VK_DECLARE)
};

struct FVulkanDeviceApi
{
	LANTERN_VK_DEVICE_FUNCTIONS(LANTERN_VK_DECLARE)
	LANTERN_VK_ACCEL_FUNCTIONS(LANTERN_VK_DECLARE)
	LANTERN_VK_PIPELINE_FUNCTIONS(LANTERN_VK_DECLARE)
};

/// Opens the system's Vulkan loader, once in a process. Returns Unsupported, with the system's message, if there is none.
FRTStatus OpenVulkanLoader(FVulkanLoader* Out);
/// GetInstanceProcAddr: the loader's, or the engine's own. Returns Unsupported if a core function is absent.
FRTStatus LoadInstanceApi(PFN_vkGetInstanceProcAddr GetInstanceProcAddr, VkInstance Instance, FVulkanInstanceApi* Out);
/// Returns Unsupported if a function of an extension asked for is absent: it was not enabled.
FRTStatus LoadDeviceApi(const FVulkanInstanceApi& Instance, VkDevice Device, bool bAccel, bool bPipeline, FVulkanDeviceApi* Out);

} // namespace Lantern
