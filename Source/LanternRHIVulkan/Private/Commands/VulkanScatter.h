// A compute pass that copies words all over a buffer: records of a shader table, and the regions of CopyBufferRegions. Copy
// regions cost the GPU some 1.4 µs each (NVIDIA H200, driver 580). 1,000 of them take 1.39 ms, twenty times as long as a copy of a
// whole table of 400,000 records. This pass takes 7 µs.
#pragma once

#include "Device/VulkanApi.h"

namespace Lantern
{

class FVulkanDevice;

class FVulkanScatter
{
public:
	/// Up to so many runs are copied; more go through the pass.
	static constexpr uint32_t MostCopies = 16;
	enum class EKind : uint32_t
	{
		Records, ///< Items: uint32_t, the record of Dest for each item of Source
		Handles, ///< Items: uint32_t, the handle in Source for each record of Dest
		Regions, ///< Items: FRegion
	};
	/// In words of 4 bytes.
	struct FRegion
	{
		uint32_t To = 0, From = 0;
		uint32_t Words = 0; ///< at most FPush::WordsPerItem
	};
	/// All addresses are multiples of 4.
	struct FPush
	{
		VkDeviceAddress Dest = 0;
		VkDeviceAddress Source = 0;
		VkDeviceAddress Items = 0;
		uint32_t WordsPerItem = 0; ///< a thread for each word of each item; Count · WordsPerItem ≤ MostThreads
		uint32_t Count = 0;
		uint32_t DestWords = 0; ///< from one record of Dest to the next; not for regions
		EKind Kind = EKind::Records;
	};
	static_assert(sizeof(FPush) == 40 && sizeof(FRegion) == 12, "scalar layout in Scatter.comp");
	/// What a thread's index can be without running over as it takes its next step.
	static constexpr uint32_t MostThreads = 1u << 31;

	/// Makes the pipeline.
	FRTStatus Create(FVulkanDevice& Device);
	void Destroy(FVulkanDevice& Device);
	/// Binds pipeline and constants for compute, and dispatches.
	void Record(FVulkanDevice& Device, VkCommandBuffer List, const FPush& Push) const;

private:
	VkPipeline Pipeline = VK_NULL_HANDLE;
};

} // namespace Lantern
