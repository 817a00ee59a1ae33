#pragma once

#include "VulkanDeviceImpl.h"

namespace Lantern
{

class FVulkanQueryPool final : public TVulkanObject<IRTQueryPool>
{
public:
	using TVulkanObject::TVulkanObject;
	FRTStatus Initialise(ERTQuery InKind, uint32_t InCount);

	uint32_t GetCount() const override { return Count; }
	ERTQuery GetKind() const override { return Kind; }
	bool GetResults(uint32_t First, uint32_t InCount, uint64_t* OutValues) override;

	VkQueryPool Handle = VK_NULL_HANDLE;

private:
	~FVulkanQueryPool() override { Device.Api.DestroyQueryPool(Device.Handle, Handle, nullptr); }
	/// In the unit of the kind.
	uint64_t Convert(uint64_t Value) const;

	ERTQuery Kind = ERTQuery::Timestamp;
	uint32_t Count = 0;
};

} // namespace Lantern
