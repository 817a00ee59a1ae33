// The regions of a copy, parted into those that a scatter copies and those that the driver copies.
#pragma once

#include "Commands/VulkanScatter.h"

#include <vector>

namespace Lantern
{

/// A scatter takes small aligned regions if there are more than FVulkanScatter::MostCopies. Everything else is copied. Regions that
/// are longer than most are cut into several items, so that each thread copies one word and few have none.
class FVulkanRegions
{
public:
	/// Regions must outlive this object. bMayScatter: the two buffers and the queue allow it.
	FVulkanRegions(const FRTBufferRegion* InRegions, uint32_t InCount, bool bMayScatter);
	const std::vector<VkBufferCopy>& GetCopies() const { return Copies; }
	/// At most so many items; 0 if nothing is scattered.
	uint32_t GetMostItems() const { return MostItems; }
	uint32_t GetWordsPerItem() const { return WordsPerItem; }
	/// Writes the items one after another, and returns how many there are.
	uint32_t WriteItems(FVulkanScatter::FRegion* Out) const;

private:
	const FRTBufferRegion* Regions;
	uint32_t Count;
	std::vector<VkBufferCopy> Copies;
	uint32_t MostItems = 0, WordsPerItem = 0;
};

} // namespace Lantern
