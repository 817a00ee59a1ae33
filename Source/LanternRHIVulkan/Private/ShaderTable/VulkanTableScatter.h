// A compute pass that writes shader records all over a table. Copy regions cost the GPU some 1.4 µs each (NVIDIA H200, driver
// 580). 1,000 of them take 1.39 ms, twenty times as long as a copy of the whole table of 400,000 records. This pass takes 7 µs.
#pragma once

#include "Device/VulkanApi.h"

#include <mutex>

namespace Lantern
{

class FVulkanDevice;

class FVulkanTableScatter
{
public:
	struct FPush
	{
		VkDeviceAddress Dest = 0;
		VkDeviceAddress Source = 0;
		VkDeviceAddress Indices = 0;
		uint32_t WordsPerRecord = 0; ///< that are moved
		uint32_t Count = 0;
		uint32_t DestWords = 0; ///< from one record of Dest to the next
		uint32_t bGather = 0;   ///< Indices are of Source, which has handles, each for many records
	};
	static_assert(sizeof(FPush) == 40, "scalar layout of Push in Shaders/ScatterRecords.comp");

	/// Makes the pipeline if there is none yet. From any thread.
	FRTStatus Prepare(FVulkanDevice& Device);
	void Destroy(FVulkanDevice& Device);
	/// Binds pipeline and constants for compute, and dispatches. Prepare must have succeeded.
	void Record(FVulkanDevice& Device, VkCommandBuffer List, const FPush& Push) const;

private:
	std::mutex Mutex;
	VkPipeline Pipeline = VK_NULL_HANDLE;
};

} // namespace Lantern
