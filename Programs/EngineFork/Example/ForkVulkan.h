// The engine's Vulkan: its own instance, device, queue and objects. It is plain on purpose, like an engine that has never heard
// of Lantern. Only FForkDevice::Create lets the plugin have a say.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <vulkan/vulkan.h>

#include "Example/ForkError.h"

namespace Fork
{

struct FForkInstance
{
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

/// What the plugin needs from the device that the engine is about to create.
struct FDeviceWishes
{
	std::vector<const char*> Extensions;
	/// Adds the plugin's features to the engine's own chain.
	std::function<void(VkPhysicalDeviceFeatures2*)> MergeFeatures;
};

struct FForkDevice
{
	VkPhysicalDevice Physical = VK_NULL_HANDLE;
	VkDevice Device = VK_NULL_HANDLE;
	VkQueue Queue = VK_NULL_HANDLE;
	uint32_t QueueFamily = 0;
	VkCommandPool Pool = VK_NULL_HANDLE;
	VkCommandBuffer Commands = VK_NULL_HANDLE;
	VkFence Fence = VK_NULL_HANDLE;

	FForkDevice() = default;
	FForkDevice(const FForkDevice&) = delete;
	~FForkDevice();
	FError Create(VkPhysicalDevice InPhysical, const FDeviceWishes& Wishes);
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
};

/// Moves one image from one layout to another. All commands before it finish first, which is simple and slow.
void Transition(VkCommandBuffer Commands, VkImage Image, VkImageAspectFlags Aspect, VkImageLayout From, VkImageLayout To);

} // namespace Fork
