// FVulkanRegions: which regions are scattered, and how they are cut.
#include "Commands/VulkanRegions.h"

#include <algorithm>

namespace Lantern
{

namespace
{

/// From this size on, the 1.4 µs of a copy region (H200) are less than what its bytes take.
constexpr uint64_t LeastCopiedBytes = 64 * 1024;
/// SPIR-V takes an index for signed.
constexpr uint64_t MostOffset = (uint64_t(1) << 31) * 4;

bool IsForScatter(const FRTBufferRegion& Region)
{
	const bool bAligned = (Region.DestOffset | Region.SourceOffset | Region.Size) % 4 == 0;
	return bAligned && Region.Size < LeastCopiedBytes && std::max(Region.DestOffset, Region.SourceOffset) < MostOffset - LeastCopiedBytes;
}

} // namespace

FVulkanRegions::FVulkanRegions(const FRTBufferRegion* InRegions, uint32_t InCount, bool bMayScatter) : Regions(InRegions), Count(InCount)
{
	uint64_t Words = 0, MostWords = 0;
	uint32_t Small = 0;
	for (uint32_t Index = 0; bMayScatter && Index < Count; ++Index)
	{
		if (Regions[Index].Size == 0 || !IsForScatter(Regions[Index])) { continue; }
		++Small;
		Words += Regions[Index].Size / 4;
		MostWords = std::max(MostWords, Regions[Index].Size / 4);
	}
	const bool bScatter = Small > FVulkanScatter::MostCopies;
	if (bScatter)
	{
		// Twice the mean: at most half as many items again as regions, and three threads at most for a word.
		const uint64_t TwiceMean = 2 * ((Words + Small - 1) / Small);
		WordsPerItem = static_cast<uint32_t>(std::min(MostWords, TwiceMean));
		MostItems = Small + static_cast<uint32_t>(Words / WordsPerItem);
	}
	if (bScatter && Small == Count) { return; }
	Copies.reserve(Count - (bScatter ? Small : 0));
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		const FRTBufferRegion& Region = Regions[Index];
		if (Region.Size == 0 || (bScatter && IsForScatter(Region))) { continue; }
		Copies.push_back({Region.SourceOffset, Region.DestOffset, Region.Size});
	}
}

uint32_t FVulkanRegions::WriteItems(FVulkanScatter::FRegion* Out) const
{
	const FVulkanScatter::FRegion* const Begin = Out;
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		const FRTBufferRegion& Region = Regions[Index];
		if (Region.Size == 0 || !IsForScatter(Region)) { continue; }
		const uint32_t Words = static_cast<uint32_t>(Region.Size / 4);
		const uint32_t To = static_cast<uint32_t>(Region.DestOffset / 4), From = static_cast<uint32_t>(Region.SourceOffset / 4);
		for (uint32_t Word = 0; Word < Words; Word += WordsPerItem)
		{
			*Out++ = {To + Word, From + Word, std::min(WordsPerItem, Words - Word)};
		}
	}
	return static_cast<uint32_t>(Out - Begin);
}

} // namespace Lantern
