// Query pools, and what is known of their results on drivers that cannot be asked.
#pragma once

#include "Device/VulkanDeviceImpl.h"

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

	// These calls are for EVulkanQuirk::SizesAlwaysAvailable and TimestampsWait. They do nothing on other drivers.
	void NoteReset(uint32_t First, uint32_t InCount);
	/// Call it when the list that writes the query is submitted.
	void NoteWrite(uint32_t Index, FRTFence Fence);

	VkQueryPool Handle = VK_NULL_HANDLE;

private:
	~FVulkanQueryPool() override { Device.Api.DestroyQueryPool(Device.Handle, Handle, nullptr); }
	/// Converts to the unit of the kind: nanoseconds or bytes.
	uint64_t Convert(uint64_t Value) const;

	static constexpr FRTFence NeverWritten = ~FRTFence(0);
	std::vector<std::atomic<FRTFence>> WrittenBy; ///< empty if the driver can be asked
	ERTQuery Kind = ERTQuery::Timestamp;
	uint32_t Count = 0;
};

} // namespace Lantern
