// VkPipelineCache, kept in a file between runs.
#pragma once

#include "Device/VulkanCapabilities.h"

#include <mutex>
#include <string>

namespace Lantern
{

class FVulkanPipelineCache
{
public:
	/// If File is null, the cache lives with the device only.
	explicit FVulkanPipelineCache(const char* InFile) : File(InFile ? InFile : "") {}

	/// OutMessage: why the file was discarded; empty if it was used or there was none.
	VkResult Create(VkDevice InDevice, const FVulkanDeviceApi& InApi, const FVulkanProbe& Probe, char* OutMessage, size_t MessageSize);
	void Destroy();
	/// Writes beside the file and renames over it, so that a reader never sees half of it.
	FRTStatus Save();

	VkPipelineCache Handle = VK_NULL_HANDLE;

private:
	std::string File;
	std::vector<char> Prefix; ///< the header of our files, but for size and checksum
	VkDevice Device = VK_NULL_HANDLE;
	const FVulkanDeviceApi* Api = nullptr;
	std::mutex Mutex;
};

} // namespace Lantern
