#pragma once

#include "VulkanDeviceImpl.h"

namespace Lantern
{

class FVulkanQueryPool final : public TVulkanObject<IRTQueryPool>
{
public:
	using TVulkanObject::TVulkanObject;
	FRTStatus Initialise(uint32_t InCount);

	uint32_t GetCount() const override { return Count; }
	bool GetTimestamps(uint32_t First, uint32_t InCount, uint64_t* OutNanoseconds) override;

	VkQueryPool Handle = VK_NULL_HANDLE;

private:
	~FVulkanQueryPool() override { Device.Api.DestroyQueryPool(Device.Handle, Handle, nullptr); }
	uint32_t Count = 0;
};

} // namespace Lantern
