// Compiles pipelines on a second device first, so that the device of the frames finds them in a cache.
#pragma once

#include "Device/VulkanDeviceImpl.h"

#include <vector>

namespace Lantern
{

/// A pipeline cache of its own for one pipeline: threads that compile side by side then share nothing.
class FVulkanOwnCache
{
public:
	explicit FVulkanOwnCache(FVulkanDevice& InDevice) : Device(InDevice) {}
	~FVulkanOwnCache();
	FVulkanOwnCache(const FVulkanOwnCache&) = delete;
	FVulkanOwnCache& operator=(const FVulkanOwnCache&) = delete;

	/// Data: as Read returned it for a device of the same kind; empty: an empty cache.
	VkResult Create(const std::vector<char>& Data);
	VkResult Read(std::vector<char>& OutData) const;

	VkPipelineCache Handle = VK_NULL_HANDLE;

private:
	FVulkanDevice& Device;
};

/// Compiles the library on Helper and gives what a cache keeps of it.
FRTStatus CompileAhead(FVulkanDevice& Helper, const FRTRayTracingPipelineDesc& Desc, std::vector<char>& OutData);

} // namespace Lantern
