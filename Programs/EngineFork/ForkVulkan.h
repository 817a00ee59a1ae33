// The engine's Vulkan: its own instance, device, queue and objects. Deliberately plain, as an engine that has
// never heard of Lantern would be; the one place where the plugin is asked is FForkDevice::Create.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

namespace Fork
{

/// What the engine could not do, in words; empty means it went well.
using FError = std::string;

struct FForkInstance
{
	VkInstance Instance = VK_NULL_HANDLE;
	VkDebugUtilsMessengerEXT Messenger = VK_NULL_HANDLE;
	bool bValidation = false;        ///< the validation layer is installed and on
	uint32_t ValidationMessages = 0; ///< warnings and errors so far

	FForkInstance() = default;
	FForkInstance(const FForkInstance&) = delete;
	~FForkInstance();
	FError Create();
	std::vector<VkPhysicalDevice> ListDevices() const;
};

/// What the plugin wants of the device that the engine is about to create.
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
	/// Index of a memory type among Allowed with all of Wanted; ~0u when there is none.
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

/// One image from one layout to another, everything before visible to everything after: the engine is simple.
void Transition(VkCommandBuffer Commands, VkImage Image, VkImageAspectFlags Aspect, VkImageLayout From, VkImageLayout To);

} // namespace Fork
