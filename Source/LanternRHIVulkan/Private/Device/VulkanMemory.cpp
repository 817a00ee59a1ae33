// FVulkanMemory: suballocation of device memory by VMA.
#include "Device/VulkanMemory.h"

// All that VMA includes, before its own text goes into a namespace.
#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <shared_mutex>
#include <type_traits>
#include <utility>
#include <vulkan/vulkan.h>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wshadow"
#endif

#define VMA_IMPLEMENTATION
#define VMA_STATIC_VULKAN_FUNCTIONS 0
#define VMA_DYNAMIC_VULKAN_FUNCTIONS 1
#define VMA_VULKAN_VERSION 1003000
#define VMA_EXTERNAL_MEMORY 0
#define VMA_CALL_PRE static
namespace Lantern::Vma
{
#include <vk_mem_alloc.h>
}

#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace Lantern
{

using namespace Vma;

namespace
{

VmaAllocator AsAllocator(void* Allocator) { return static_cast<VmaAllocator>(Allocator); }
VmaAllocation AsBlock(const FVulkanAllocation& Allocation) { return static_cast<VmaAllocation>(Allocation.Block); }

} // namespace

FVulkanMemory::~FVulkanMemory() { Destroy(); }

VkResult FVulkanMemory::Create(VkInstance Instance, VkPhysicalDevice Physical, VkDevice Device, const FVulkanInstanceApi& Api,
    PFN_vkGetDeviceProcAddr GetDeviceProcAddr)
{
	VmaVulkanFunctions Functions{};
	Functions.vkGetInstanceProcAddr = Api.GetInstanceProcAddr;
	Functions.vkGetDeviceProcAddr = GetDeviceProcAddr;
	VmaAllocatorCreateInfo Info{};
	Info.flags = VMA_ALLOCATOR_CREATE_BUFFER_DEVICE_ADDRESS_BIT;
	Info.instance = Instance;
	Info.physicalDevice = Physical;
	Info.device = Device;
	Info.vulkanApiVersion = VK_API_VERSION_1_3;
	Info.pVulkanFunctions = &Functions;
	// A frame that needs a new block waits for it. NVIDIA's driver takes 8 to 12 ms for 256 MiB, which is VMA's own choice, and 0.7
	// for 32. Devices may allow no more than 4,096 allocations, so much smaller blocks would be too many.
	Info.preferredLargeHeapBlockSize = uint64_t(16) << 20;
	VmaAllocator Created = nullptr;
	const VkResult Result = vmaCreateAllocator(&Info, &Created);
	Allocator = Created;
	return Result;
}

void FVulkanMemory::Destroy()
{
	if (Allocator)
	{
		vmaDestroyAllocator(AsAllocator(Allocator));
		Allocator = nullptr;
	}
}

VkResult FVulkanMemory::CreateBuffer(
    const VkBufferCreateInfo& Info, ERTMemory Kind, uint64_t Alignment, VkBuffer* OutBuffer, FVulkanAllocation* Out)
{
	VmaAllocationCreateInfo Wish{};
	Wish.usage = VMA_MEMORY_USAGE_AUTO;
	switch (Kind)
	{
	case ERTMemory::Device: Wish.usage = VMA_MEMORY_USAGE_AUTO_PREFER_DEVICE; break;
	case ERTMemory::Upload:
		// The device's own memory is never used, though a part of it may be mapped. If that mapping is not write-combined,
		// every store crosses the bus by itself: 5 µs for the 64 bytes of an instance (H200, virtual machine). What the
		// GPU reads once is as well read from here, and what it reads often is copied.
		Wish.usage = VMA_MEMORY_USAGE_AUTO_PREFER_HOST;
		Wish.flags = VMA_ALLOCATION_CREATE_MAPPED_BIT | VMA_ALLOCATION_CREATE_HOST_ACCESS_SEQUENTIAL_WRITE_BIT;
		Wish.requiredFlags = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
		break;
	case ERTMemory::Readback:
		Wish.flags = VMA_ALLOCATION_CREATE_MAPPED_BIT | VMA_ALLOCATION_CREATE_HOST_ACCESS_RANDOM_BIT;
		Wish.requiredFlags = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
		Wish.preferredFlags = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
		break;
	}
	VmaAllocation Block = nullptr;
	VmaAllocationInfo Result{};
	const VkResult Code =
	    vmaCreateBufferWithAlignment(AsAllocator(Allocator), &Info, &Wish, std::max<uint64_t>(Alignment, 1), OutBuffer, &Block, &Result);
	*Out = {Block, Result.pMappedData, Result.size};
	return Code;
}

VkResult FVulkanMemory::CreateImage(const VkImageCreateInfo& Info, VkImage* OutImage, FVulkanAllocation* Out)
{
	VmaAllocationCreateInfo Wish{};
	Wish.usage = VMA_MEMORY_USAGE_AUTO_PREFER_DEVICE;
	VmaAllocation Block = nullptr;
	VmaAllocationInfo Result{};
	const VkResult Code = vmaCreateImage(AsAllocator(Allocator), &Info, &Wish, OutImage, &Block, &Result);
	*Out = {Block, nullptr, Result.size};
	return Code;
}

void FVulkanMemory::DestroyBuffer(VkBuffer Buffer, const FVulkanAllocation& Allocation)
{
	vmaDestroyBuffer(AsAllocator(Allocator), Buffer, AsBlock(Allocation));
}

void FVulkanMemory::DestroyImage(VkImage Image, const FVulkanAllocation& Allocation)
{
	vmaDestroyImage(AsAllocator(Allocator), Image, AsBlock(Allocation));
}

void FVulkanMemory::SetName(const FVulkanAllocation& Allocation, const char* Name)
{
	vmaSetAllocationName(AsAllocator(Allocator), AsBlock(Allocation), Name);
}

} // namespace Lantern
