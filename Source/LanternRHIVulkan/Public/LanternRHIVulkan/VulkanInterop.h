// Take-over of an engine's Vulkan device.
//
// Order: call GetVulkanRequirements for the engine's VkPhysicalDevice with the engine's own extensions and features, give what
// it returns to vkCreateDevice, and call AdoptVulkanDevice. Lantern then allocates from the device and submits to the queue. It destroys nothing that it did not
// create. All RHI objects, the device included, must be released before the engine destroys its VkDevice.
//
// Queue: Vulkan wants submissions to a VkQueue synchronised. Lantern calls LockQueue before every use of the queue and
// UnlockQueue after it. Without them, the engine must not use the queue during Submit, NotifyExternalSubmit and WaitIdle.
//
// Layouts: an imported texture's layout is that of the access named Before in its next barrier (GetVulkanLayout). A texture in
// combinations of ShaderRead, StorageRead and StorageWrite is in VK_IMAGE_LAYOUT_GENERAL. Read it through its storage index
// then: its sampled descriptor expects ShaderRead alone.
#pragma once

#include "LanternRHIVulkan/VulkanDevice.h"

#include <vulkan/vulkan_core.h>

namespace Lantern
{

/// What vkCreateDevice must enable on one physical device, the engine's own wishes included. The object owns all that it adds.
class IRTVulkanRequirements : public IRTRefCounted
{
public:
	/// Extensions for vkCreateDevice: the engine's in their order, then those that Lantern adds. No name comes twice.
	virtual uint32_t GetExtensionCount() const = 0;
	virtual const char* const* GetExtensions() const = 0;
	/// Switches features on in FRTVulkanRequirementsDesc::FeatureChain and EnabledFeatures, and appends the structures that they
	/// lack. Returns the head of the chain for VkDeviceCreateInfo::pNext. Call it for the device that is about to be created, and
	/// for no other with the same chain. This object and the engine's lists must live until vkCreateDevice returns.
	virtual const void* MergeFeatures() = 0;
	/// Returns what the device will be able to do.
	virtual const FRTCapabilities& GetCapabilities() const = 0;
};

struct FRTVulkanRequirementsDesc
{
	VkInstance Instance = VK_NULL_HANDLE;
	VkPhysicalDevice PhysicalDevice = VK_NULL_HANDLE;
	/// VkApplicationInfo::apiVersion of Instance, which Vulkan does not tell. As there, 0 means Vulkan 1.0.
	uint32_t InstanceVersion = 0;
	/// Null means the system loader's.
	PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
	/// Extensions that the engine enables on the device by itself.
	const char* const* Extensions = nullptr;
	uint32_t ExtensionCount = 0;
	/// The engine's VkDeviceCreateInfo::pNext, or null. It must not contain a structure that was promoted into
	/// VkPhysicalDeviceVulkan11/12/13Features, because Vulkan allows no chain with both.
	void* FeatureChain = nullptr;
	/// The engine's VkDeviceCreateInfo::pEnabledFeatures, or null. With it, FeatureChain has no VkPhysicalDeviceFeatures2.
	VkPhysicalDeviceFeatures* EnabledFeatures = nullptr;
	ERTRung MaxRung = ERTRung::Micromap;
	bool bDisableRayQuery = false;
	bool bDisablePipeline = false;
	bool bAllowNoRayTracing = false;
};

/// Changes none of the engine's lists. Unsupported names what instance or device lack. InvalidArgument names the part of the
/// engine's lists that excludes what Lantern needs.
FRTStatus GetVulkanRequirements(const FRTVulkanRequirementsDesc& Desc, IRTVulkanRequirements** Out);

struct FRTVulkanExternalDesc
{
	VkInstance Instance = VK_NULL_HANDLE; ///< created for Vulkan 1.3 or newer
	VkPhysicalDevice PhysicalDevice = VK_NULL_HANDLE;
	VkDevice Device = VK_NULL_HANDLE;
	VkQueue Queue = VK_NULL_HANDLE; ///< graphics and compute
	uint32_t QueueFamily = 0;
	/// For copies beside the frame; nobody else may submit to it. Null: copies run on Queue, within the engine's frame.
	VkQueue TransferQueue = VK_NULL_HANDLE;
	uint32_t TransferQueueFamily = 0;
	/// For compute beside the frame (ERTQueue::AsyncCompute), with compute and copies; nobody else may submit to it. Null: one
	/// queue does all. Textures that the engine imports are used on Queue alone.
	VkQueue ComputeQueue = VK_NULL_HANDLE;
	uint32_t ComputeQueueFamily = 0;
	/// The one through which the instance was created. Null means the system loader's.
	PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
	/// Everything in it must have been enabled on Device.
	const IRTVulkanRequirements* Requirements = nullptr;
	void (*LockQueue)(void* User) = nullptr;
	void (*UnlockQueue)(void* User) = nullptr;
	void* QueueUser = nullptr;
	/// Counts and prints the validation messages of the engine's instance, which needs VK_EXT_debug_utils enabled.
	bool bCountValidation = false;
	const char* PipelineCacheFile = nullptr; ///< as in FRTVulkanDeviceDesc
	FRTVulkanMessageCallback MessageCallback = nullptr;
	void* MessageUser = nullptr;
};

/// Returns Unsupported if a function of a required extension is absent: the extension was not enabled. InvalidArgument names a
/// handle that is null.
FRTStatus AdoptVulkanDevice(const FRTVulkanExternalDesc& Desc, IRTDevice** Out);

/// Returns the layout of a texture between barriers to and from Access.
VkImageLayout GetVulkanLayout(ERTAccess Access);
/// Returns VK_FORMAT_UNDEFINED for Unknown.
VkFormat GetVulkanFormat(ERTFormat Format);

} // namespace Lantern
