// Mapped memory of a command list: what the GPU reads while the list runs.
#pragma once

#include "Resources/VulkanBuffer.h"

namespace Lantern
{

/// Hands out parts of one block, which the list uses again each time that it begins. If a list needs more, it gets a larger block;
/// what was handed out stays valid as long as the list keeps GetBlock.
class FVulkanListMemory
{
public:
	struct FSlice
	{
		void* Data = nullptr; ///< write once and in order: it may be write-combined
		VkDeviceAddress Address = 0;
	};
	/// Makes all of it free again. The list's last submission has finished.
	void Begin();
	/// Lets go of the block.
	void Release();
	/// Bytes: a multiple of 4.
	FRTStatus Allocate(FVulkanDevice& Device, uint64_t Bytes, FSlice& Out);
	/// Returns the block that the last slice lies in.
	FVulkanKeptBlock* GetBlock() const { return Block.Get(); }

private:
	TRTRef<FVulkanKeptBlock> Block;
	uint64_t Used = 0;           ///< of Block
	uint64_t UsedSinceBegin = 0; ///< of all blocks
	uint32_t IdleBegins = 0;     ///< in a row, after which most of Block was never used
};

} // namespace Lantern
