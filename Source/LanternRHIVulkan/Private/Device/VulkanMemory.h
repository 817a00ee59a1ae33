// Device memory. Only VulkanMemory.cpp sees VMA, whose code is compiled into a namespace of its own, so that an engine may link
// another version.
#pragma once

#include "Device/VulkanApi.h"

namespace Lantern
{

struct FVulkanAllocation
{
	void* Block = nullptr; ///< VmaAllocation
	void* Mapped = nullptr;
	uint64_t Bytes = 0;
};

class FVulkanMemory
{
public:
	FVulkanMemory() = default;
	FVulkanMemory(const FVulkanMemory&) = delete;
	FVulkanMemory& operator=(const FVulkanMemory&) = delete;
	~FVulkanMemory();

	VkResult Create(VkInstance Instance, VkPhysicalDevice Physical, VkDevice Device, const FVulkanInstanceApi& Api,
	    PFN_vkGetDeviceProcAddr GetDeviceProcAddr);
	void Destroy();
	VkResult CreateBuffer(const VkBufferCreateInfo& Info, ERTMemory Kind, uint64_t Alignment, VkBuffer* OutBuffer, FVulkanAllocation* Out);
	VkResult CreateImage(const VkImageCreateInfo& Info, VkImage* OutImage, FVulkanAllocation* Out);
	void DestroyBuffer(VkBuffer Buffer, const FVulkanAllocation& Allocation);
	void DestroyImage(VkImage Image, const FVulkanAllocation& Allocation);
	void SetName(const FVulkanAllocation& Allocation, const char* Name);

private:
	void* Allocator = nullptr;
};

} // namespace Lantern
