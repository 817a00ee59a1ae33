#include "VulkanQueryPool.h"

#include <cassert>

namespace Lantern
{

FRTStatus FVulkanQueryPool::Initialise(uint32_t InCount)
{
	assert(InCount > 0);
	Count = InCount;
	VkQueryPoolCreateInfo Info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
	Info.queryType = VK_QUERY_TYPE_TIMESTAMP;
	Info.queryCount = Count;
	const VkResult Result = Device.Check(Device.Api.CreateQueryPool(Device.Handle, &Info, nullptr, &Handle));
	if (Result != VK_SUCCESS)
	{
		Handle = VK_NULL_HANDLE;
		return MakeStatus(Result, "Creating query pool", "timestamps");
	}
	// A query that was never reset may not even be asked for its availability.
	Device.Api.ResetQueryPool(Device.Handle, Handle, 0, Count);
	return {};
}

bool FVulkanQueryPool::GetTimestamps(uint32_t First, uint32_t InCount, uint64_t* OutNanoseconds)
{
	assert(First + InCount <= Count);
	if (Device.IsLost() || !Device.GetCapabilities().bTimestamps)
	{
		return false;
	}
	struct FResult
	{
		uint64_t Ticks;
		uint64_t bAvailable;
	};
	std::vector<FResult> Results(InCount);
	const VkResult Code = Device.Check(Device.Api.GetQueryPoolResults(
	    Device.Handle, Handle, First, InCount, Results.size() * sizeof(FResult), Results.data(), sizeof(FResult),
	    VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WITH_AVAILABILITY_BIT));
	if (Code != VK_SUCCESS && Code != VK_NOT_READY)
	{
		return false;
	}
	const uint64_t Mask = Device.TimestampBits >= 64 ? ~uint64_t(0) : (uint64_t(1) << Device.TimestampBits) - 1;
	bool bAll = true;
	for (uint32_t Index = 0; Index < InCount; ++Index)
	{
		bAll = bAll && Results[Index].bAvailable != 0;
		const double Nanoseconds =
		    static_cast<double>(Results[Index].Ticks & Mask) * Device.GetCapabilities().TimestampPeriodNs;
		OutNanoseconds[Index] = static_cast<uint64_t>(Nanoseconds);
	}
	return bAll;
}

} // namespace Lantern
