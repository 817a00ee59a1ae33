// Take-over of an engine's Vulkan device.
//
// Order: call GetVulkanRequirements for the engine's VkPhysicalDevice, enable what it lists in the engine's vkCreateDevice, and
// call AdoptVulkanDevice. Lantern then allocates from the device and submits to the queue. It destroys nothing that it did not
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

/// What vkCreateDevice must enable on one physical device. The object owns all that it points to.
class IRTVulkanRequirements : public IRTRefCounted
{
public:
	virtual uint32_t GetExtensionCount() const = 0;
	virtual const char* const* GetExtensions() const = 0;
	/// Returns the head of a chain for VkDeviceCreateInfo::pNext, for an engine without features of its own.
	virtual const VkPhysicalDeviceFeatures2* GetFeatures() const = 0;
	/// Switches features on in the structures of an engine's own chain, and appends the structures that it lacks. The chain must
	/// use VkPhysicalDeviceVulkan11/12/13Features rather than the structures promoted into them. This object must live until
	/// vkCreateDevice returns.
	virtual void MergeInto(VkPhysicalDeviceFeatures2* EngineChain) = 0;
	/// Returns what the device will be able to do.
	virtual const FRTCapabilities& GetCapabilities() const = 0;
};

struct FRTVulkanRequirementsDesc
{
	VkInstance Instance = VK_NULL_HANDLE;
	VkPhysicalDevice PhysicalDevice = VK_NULL_HANDLE;
	/// Null means the system loader's.
	PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
	ERTRung MaxRung = ERTRung::Micromap;
	bool bDisableRayQuery = false;
	bool bDisablePipeline = false;
	bool bAllowNoRayTracing = false;
};

/// Returns Unsupported, with a message that names what is missing, if Lantern cannot run on the device.
FRTStatus GetVulkanRequirements(const FRTVulkanRequirementsDesc& Desc, IRTVulkanRequirements** Out);

struct FRTVulkanExternalDesc
{
	VkInstance Instance = VK_NULL_HANDLE; ///< created for Vulkan 1.3 or newer
	VkPhysicalDevice PhysicalDevice = VK_NULL_HANDLE;
	VkDevice Device = VK_NULL_HANDLE;
	VkQueue Queue = VK_NULL_HANDLE; ///< graphics and compute
	uint32_t QueueFamily = 0;
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

/// Returns Unsupported if a function of a required extension is absent: the extension was not enabled.
FRTStatus AdoptVulkanDevice(const FRTVulkanExternalDesc& Desc, IRTDevice** Out);

/// Returns the layout of a texture between barriers to and from Access.
VkImageLayout GetVulkanLayout(ERTAccess Access);
/// Returns VK_FORMAT_UNDEFINED for Unknown.
VkFormat GetVulkanFormat(ERTFormat Format);

} // namespace Lantern
