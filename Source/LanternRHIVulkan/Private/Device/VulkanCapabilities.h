// What a physical device can do, and what must be enabled for it. Devices of our own, an engine's, and the list of devices all
// ask here.
#pragma once

#include "Device/VulkanApi.h"

#include <string>
#include <vector>

namespace Lantern
{

/// The feature structures in use, linked in one chain. Structures of absent extensions are left out.
struct FVulkanFeatures
{
	VkPhysicalDeviceFeatures2 Core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
	VkPhysicalDeviceVulkan11Features Vulkan11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES};
	VkPhysicalDeviceVulkan12Features Vulkan12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
	VkPhysicalDeviceVulkan13Features Vulkan13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
	VkPhysicalDeviceAccelerationStructureFeaturesKHR Accel{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
	VkPhysicalDeviceRayTracingPipelineFeaturesKHR Pipeline{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR};
	VkPhysicalDeviceRayQueryFeaturesKHR Query{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};
	VkPhysicalDeviceRayTracingMaintenance1FeaturesKHR Maintenance1{
	    VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_MAINTENANCE_1_FEATURES_KHR};
	VkPhysicalDeviceRayTracingInvocationReorderFeaturesNV Reorder{
	    VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_INVOCATION_REORDER_FEATURES_NV};
	VkPhysicalDeviceOpacityMicromapFeaturesEXT Micromap{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_OPACITY_MICROMAP_FEATURES_EXT};
#ifdef VK_KHR_ray_tracing_position_fetch
	VkPhysicalDeviceRayTracingPositionFetchFeaturesKHR PositionFetch{
	    VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_POSITION_FETCH_FEATURES_KHR};
#endif

	/// Rebuilds the pNext pointers for the extensions named. Core structures are always in the chain.
	void Link(const std::vector<const char*>& Extensions);
};

struct FVulkanProbeDesc
{
	ERTRung MaxRung = ERTRung::Micromap;
	bool bDisableRayQuery = false;
	bool bDisablePipeline = false;
};

struct FVulkanProbe
{
	static constexpr uint32_t NoQueueFamily = ~0u;

	FRTCapabilities Capabilities;
	bool bUsable = false;
	bool bAccel = false; ///< acceleration structures: with ray query or pipelines
	bool bMaintenance1 = false;
	bool bAnisotropy = false;
	float MaxAnisotropy = 1.0f;
	uint64_t MaxBufferBytes = 0;
	uint32_t MaxBindlessSamplers = 0;
	uint32_t MaxBindlessScenes = 0;
	uint32_t QueueFamily = NoQueueFamily;    ///< first with graphics and compute
	uint32_t TransferFamily = NoQueueFamily; ///< first with copies and neither graphics nor compute
	/// First with compute and no graphics. Else QueueFamily, if it has a second queue.
	uint32_t ComputeFamily = NoQueueFamily;
	uint32_t Quirks = 0;
	VkPhysicalDeviceType Type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
	uint32_t ApiVersion = 0;
	uint8_t PipelineCacheUuid[VK_UUID_SIZE] = {};
	uint32_t VendorId = 0, DeviceId = 0, DriverVersion = 0;
	std::string Missing;                 ///< one line for each thing, and what that costs
	std::string QuirkText;               ///< one line for each quirk
	std::vector<const char*> Extensions; ///< to enable; string literals
	FVulkanFeatures Features;            ///< to enable; call Link after a copy
};

void ProbeVulkanDevice(const FVulkanInstanceApi& Api, VkPhysicalDevice Physical, const FVulkanProbeDesc& Desc, FVulkanProbe* Out);

} // namespace Lantern
