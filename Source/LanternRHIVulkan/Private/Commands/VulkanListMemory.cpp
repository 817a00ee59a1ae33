// FVulkanListMemory: growth, and the return of what is no longer needed.
#include "Commands/VulkanListMemory.h"

#include <algorithm>
#include <cassert>

namespace Lantern
{

namespace
{
constexpr uint64_t LeastBytes = 16 * 1024;
/// Recordings through which a block may be four times too large.
constexpr uint32_t MostIdleBegins = 64;
} // namespace

void FVulkanListMemory::Begin()
{
	const bool bTooLarge = Block && Block->Size > LeastBytes && UsedSinceBegin < Block->Size / 4;
	IdleBegins = bTooLarge ? IdleBegins + 1 : 0;
	if (IdleBegins > MostIdleBegins) { Release(); }
	Used = UsedSinceBegin = 0;
}

void FVulkanListMemory::Release()
{
	Block.Reset();
	Used = UsedSinceBegin = 0;
	IdleBegins = 0;
}

FRTStatus FVulkanListMemory::Allocate(FVulkanDevice& Device, uint64_t Bytes, FSlice& Out)
{
	assert(Bytes > 0 && Bytes % 4 == 0);
	if (!Block || Block->Size - Used < Bytes)
	{
		TRTRef<FVulkanKeptBlock> Made = MakeVulkanObject<FVulkanKeptBlock>(Device);
		Made->Size = std::max({LeastBytes, Bytes, Block ? 2 * Block->Size : 0});
		const FRTStatus Status = Made->Block.Create(
		    Device, Made->Size, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, ERTMemory::Upload, 16, EVulkanMemoryKind::Buffer, "Regions (host)");
		if (!Status) { return Status; }
		Block = std::move(Made);
		Used = 0;
	}
	Out = {static_cast<uint8_t*>(Block->Block.Allocation.Mapped) + Used, Block->Block.Address + Used};
	Used += Bytes;
	UsedSinceBegin += Bytes;
	return {};
}

} // namespace Lantern
