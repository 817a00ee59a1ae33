// The engine's Vulkan: its own instance, device, queue and objects. It is plain on purpose, like an engine that has never heard
// of Lantern. The plugin has its say in FForkEngine::CreateDevice alone.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include <vulkan/vulkan.h>

#include "Example/ForkError.h"

namespace Fork
{

struct FForkInstance
{
	static constexpr uint32_t Version = VK_API_VERSION_1_3;
	VkInstance Instance = VK_NULL_HANDLE;
	VkDebugUtilsMessengerEXT Messenger = VK_NULL_HANDLE;
	bool bValidation = false;        ///< the validation layer is installed and enabled
	uint32_t ValidationMessages = 0; ///< number of warnings and errors so far

	FForkInstance() = default;
	FForkInstance(const FForkInstance&) = delete;
	~FForkInstance();
	FError Create();
	std::vector<VkPhysicalDevice> ListDevices() const;
};

/// What the engine itself needs from a device, as it did before it knew the plugin.
struct FForkFeatures
{
	FForkFeatures();
	FForkFeatures(const FForkFeatures&) = delete;
	static constexpr const char* Extensions[] = {VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME};
	VkPhysicalDeviceDepthClipEnableFeaturesEXT DepthClip{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_ENABLE_FEATURES_EXT};
	VkPhysicalDeviceVulkan12Features Vulkan12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
	VkPhysicalDeviceVulkan13Features Vulkan13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
	VkPhysicalDeviceFeatures2 Core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
};

/// For vkCreateDevice.
struct FForkDeviceLists
{
	std::vector<const char*> Extensions;
	const void* Features = nullptr; ///< VkDeviceCreateInfo::pNext
};

struct FForkDevice
{
	VkPhysicalDevice Physical = VK_NULL_HANDLE;
	VkDevice Device = VK_NULL_HANDLE;
	VkQueue Queue = VK_NULL_HANDLE;
	mutable std::mutex QueueMutex; ///< of Queue
	uint32_t QueueFamily = 0;
	VkCommandPool Pool = VK_NULL_HANDLE;
	VkCommandBuffer Commands = VK_NULL_HANDLE;
	VkFence Fence = VK_NULL_HANDLE;

	FForkDevice() = default;
	FForkDevice(const FForkDevice&) = delete;
	~FForkDevice();
	FError Create(VkPhysicalDevice InPhysical, const FForkDeviceLists& Lists);
	FError BeginCommands();
	FError Submit(); ///< ends and submits Commands
	FError WaitForSubmit();
	/// Index of a memory type that is in Allowed and has all of Wanted; ~0u if there is none.
	uint32_t FindMemory(uint32_t Allowed, VkMemoryPropertyFlags Wanted) const;
};

struct FForkImage
{
	VkDevice Device = VK_NULL_HANDLE;
	VkImage Image = VK_NULL_HANDLE;
	VkImageView View = VK_NULL_HANDLE;
	VkImageView ReadView = VK_NULL_HANDLE; ///< what shaders read: of depth and stencil the depth, else View
	VkDeviceMemory Memory = VK_NULL_HANDLE;

	FForkImage() = default;
	FForkImage(const FForkImage&) = delete;
	~FForkImage();
	FError Create(const FForkDevice& Owner, VkExtent2D Size, VkFormat Format, VkImageUsageFlags Usage, VkImageAspectFlags Aspect);
};

/// A buffer that the CPU can see.
struct FForkBuffer
{
	VkDevice Device = VK_NULL_HANDLE;
	VkBuffer Buffer = VK_NULL_HANDLE;
	VkDeviceMemory Memory = VK_NULL_HANDLE;
	void* Mapped = nullptr;

	FForkBuffer() = default;
	FForkBuffer(const FForkBuffer&) = delete;
	~FForkBuffer();
	FError Create(const FForkDevice& Owner, VkDeviceSize Size, VkBufferUsageFlags Usage);
	/// Usage must have had VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT.
	VkDeviceAddress GetAddress() const;
};

struct FForkShader
{
	const uint32_t* Words = nullptr;
	size_t Bytes = 0;
};

FError CreateComputePipeline(VkDevice Device, const FForkShader& Shader, VkPipelineLayout Layout, VkPipeline& Out);

/// Moves one image from one layout to another. All commands before it finish first, which is simple and slow.
void Transition(VkCommandBuffer Commands, VkImage Image, VkImageAspectFlags Aspect, VkImageLayout From, VkImageLayout To);

} // namespace Fork
