// FVulkanQueryPool: timestamps and compacted sizes.
#include "Commands/VulkanQueryPool.h"

#include "Device/VulkanQuirks.h"

#include <algorithm>
#include <cassert>

namespace Lantern
{

FRTStatus FVulkanQueryPool::Initialise(ERTQuery InKind, uint32_t InCount)
{
	assert(InCount > 0);
	const bool bSizes = InKind == ERTQuery::CompactedSize;
	if (bSizes && !Device.Bits.bAccel)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "Queries of sizes: the device has no acceleration structures");
	}
	Kind = InKind;
	Count = InCount;
	VkQueryPoolCreateInfo Info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
	Info.queryType = bSizes ? VK_QUERY_TYPE_ACCELERATION_STRUCTURE_COMPACTED_SIZE_KHR : VK_QUERY_TYPE_TIMESTAMP;
	Info.queryCount = Count;
	const VkResult Result = Device.Check(Device.Api.CreateQueryPool(Device.Handle, &Info, nullptr, &Handle));
	if (Result != VK_SUCCESS)
	{
		Handle = VK_NULL_HANDLE;
		return MakeStatus(Result, "Creating query pool", bSizes ? "compacted sizes" : "timestamps");
	}
	const EVulkanQuirk Quirk = bSizes ? EVulkanQuirk::SizesAlwaysAvailable : EVulkanQuirk::TimestampsWait;
	if (HasQuirk(Device.Probe.Quirks, Quirk))
	{
		WrittenBy = std::vector<std::atomic<FRTFence>>(Count);
		NoteReset(0, Count);
	}
	// A query that was never reset may not even be asked for its availability.
	Device.Api.ResetQueryPool(Device.Handle, Handle, 0, Count);
	return {};
}

void FVulkanQueryPool::NoteReset(uint32_t First, uint32_t InCount)
{
	for (uint32_t Index = First; Index < First + InCount && Index < WrittenBy.size(); ++Index) { WrittenBy[Index].store(NeverWritten); }
}

void FVulkanQueryPool::NoteWrite(uint32_t Index, FRTFence Fence)
{
	if (Index < WrittenBy.size()) { WrittenBy[Index].store(Fence); }
}

uint64_t FVulkanQueryPool::Convert(uint64_t Value) const
{
	if (Kind == ERTQuery::CompactedSize) { return Value; }
	const uint64_t Mask = Device.TimestampBits >= 64 ? ~uint64_t(0) : (uint64_t(1) << Device.TimestampBits) - 1;
	return static_cast<uint64_t>(static_cast<double>(Value & Mask) * Device.GetCapabilities().TimestampPeriodNs);
}

bool FVulkanQueryPool::GetResults(uint32_t First, uint32_t InCount, uint64_t* OutValues)
{
	assert(First + InCount <= Count);
	if (Device.IsLost() || (Kind == ERTQuery::Timestamp && !Device.GetCapabilities().bTimestamps)) { return false; }
	const auto IsWritten = [&](const std::atomic<FRTFence>& Written) {
		const FRTFence Fence = Written.load();
		return Fence != NeverWritten && Fence <= Device.GetCompletedFence(GetFenceQueue(Fence));
	};
	if (!WrittenBy.empty() && !std::all_of(WrittenBy.begin() + First, WrittenBy.begin() + First + InCount, IsWritten)) { return false; }
	struct FResult
	{
		uint64_t Value;
		uint64_t bAvailable;
	};
	std::vector<FResult> Results(InCount);
	const VkResult Code = Device.Check(Device.Api.GetQueryPoolResults(Device.Handle, Handle, First, InCount,
	    Results.size() * sizeof(FResult), Results.data(), sizeof(FResult), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WITH_AVAILABILITY_BIT));
	if (Code != VK_SUCCESS && Code != VK_NOT_READY) { return false; }
	bool bAll = true;
	for (uint32_t Index = 0; Index < InCount; ++Index)
	{
		bAll = bAll && Results[Index].bAvailable != 0;
		OutValues[Index] = Convert(Results[Index].Value);
	}
	return bAll;
}

} // namespace Lantern
