// Take-over of an engine's Vulkan device.
//
// Order: GetVulkanRequirements for the engine's VkPhysicalDevice; enable what it lists in the engine's
// vkCreateDevice; AdoptVulkanDevice. Lantern then allocates from the device and submits to the queue, and
// destroys nothing that it did not create. All RHI objects, the device included, must be released before the
// engine destroys its VkDevice.
//
// Queue: Vulkan wants submissions to a VkQueue synchronised. Lantern takes LockQueue around every use of the
// queue; without it the engine must not use the queue while a call of Submit, NotifyExternalSubmit or WaitIdle
// is under way.
//
// Layouts: an imported texture's layout is that of the access named Before in its next barrier (GetVulkanLayout).
// A texture in ShaderRead|StorageRead|StorageWrite combinations is in VK_IMAGE_LAYOUT_GENERAL and is to be read
// through its storage index; its sampled descriptor expects ShaderRead alone.
#pragma once

#include "LanternRHIVulkan/VulkanDevice.h"

#include <vulkan/vulkan_core.h>

namespace Lantern
{

/// What vkCreateDevice must enable. Owns all it points to. Made for one physical device.
class IRTVulkanRequirements : public IRTRefCounted
{
public:
	virtual uint32_t GetExtensionCount() const = 0;
	virtual const char* const* GetExtensions() const = 0;
	/// Head of the chain for VkDeviceCreateInfo::pNext, for an engine without features of its own.
	virtual const VkPhysicalDeviceFeatures2* GetFeatures() const = 0;
	/// For an engine with its own chain: features of structures that are in it are switched on there, the others
	/// appended at its end. The chain must use VkPhysicalDeviceVulkan11/12/13Features rather than the
	/// structures promoted into them, and this object must live until vkCreateDevice returns.
	virtual void MergeInto(VkPhysicalDeviceFeatures2* EngineChain) = 0;
	/// What the device will be able to do.
	virtual const FRTCapabilities& GetCapabilities() const = 0;
};

struct FRTVulkanRequirementsDesc
{
	VkInstance Instance = VK_NULL_HANDLE;
	VkPhysicalDevice PhysicalDevice = VK_NULL_HANDLE;
	/// Null: the system loader's.
	PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
	ERTRung MaxRung = ERTRung::Micromap;
	bool bDisableRayQuery = false;
	bool bDisablePipeline = false;
	bool bAllowNoRayTracing = false;
};

/// Unsupported, naming what is missing, when Lantern cannot run on the device.
FRTStatus GetVulkanRequirements(const FRTVulkanRequirementsDesc& Desc, IRTVulkanRequirements** Out);

struct FRTVulkanExternalDesc
{
	VkInstance Instance = VK_NULL_HANDLE; ///< created for Vulkan 1.3 or newer
	VkPhysicalDevice PhysicalDevice = VK_NULL_HANDLE;
	VkDevice Device = VK_NULL_HANDLE;
	VkQueue Queue = VK_NULL_HANDLE; ///< graphics and compute
	uint32_t QueueFamily = 0;
	/// Null: the system loader's. Must be the one the instance was created through.
	PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
	/// All of it must have been enabled on Device.
	const IRTVulkanRequirements* Requirements = nullptr;
	void (*LockQueue)(void* User) = nullptr;
	void (*UnlockQueue)(void* User) = nullptr;
	void* QueueUser = nullptr;
	/// Count (and print) the validation messages of the engine's instance; needs VK_EXT_debug_utils enabled on it.
	bool bCountValidation = false;
	const char* PipelineCacheFile = nullptr; ///< as in FRTVulkanDeviceDesc
	FRTVulkanMessageCallback MessageCallback = nullptr;
	void* MessageUser = nullptr;
};

/// Unsupported when a function of a required extension is absent, i.e. it was not enabled.
FRTStatus AdoptVulkanDevice(const FRTVulkanExternalDesc& Desc, IRTDevice** Out);

/// The layout a texture is in between barriers to and from Access.
VkImageLayout GetVulkanLayout(ERTAccess Access);
/// VK_FORMAT_UNDEFINED for Unknown.
VkFormat GetVulkanFormat(ERTFormat Format);

} // namespace Lantern
