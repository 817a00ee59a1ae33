// Pipelines of all kinds, and the handles of their shader groups.
#pragma once

#include "Device/VulkanDeviceImpl.h"

#include <string>
#include <vector>

namespace Lantern
{

class FVulkanPipeline final : public TVulkanObject<IRTPipeline>
{
public:
	using TVulkanObject::TVulkanObject;
	FRTStatus InitialiseCompute(const FRTComputePipelineDesc& Desc);
	FRTStatus InitialiseRaster(const FRTRasterPipelineDesc& Desc);
	/// Cache: null for the device's own, or none, as FRTVulkanDeviceDesc says.
	FRTStatus InitialiseRayTracing(const FRTRayTracingPipelineDesc& Desc);

	uint32_t GetGroupCount() const override { return GroupCount; }
	uint64_t GetNative(ERTNative Kind) const override;

	bool IsLibrary() const { return bLibrary; }
	/// Returns GetGroupCount() handles of ShaderGroupHandleSize bytes each; null for a library.
	const uint8_t* GetGroupHandles() const { return GroupHandles.empty() ? nullptr : GroupHandles.data(); }

	VkPipeline Handle = VK_NULL_HANDLE;
	VkPipelineBindPoint BindPoint = VK_PIPELINE_BIND_POINT_COMPUTE;

private:
	~FVulkanPipeline() override { Device.Api.DestroyPipeline(Device.Handle, Handle, nullptr); }
	FRTStatus Finish(VkResult Result, const char* What, const char* Name);
	/// NativeOwnCount: OwnCount, and the groups behind them that we added and the caller does not know.
	FRTStatus ReadGroupHandles(uint32_t OwnCount, uint32_t NativeOwnCount, const char* Name);

	uint32_t GroupCount = 0;
	std::vector<uint8_t> GroupHandles;
	bool bLibrary = false;
	bool bHasHitShader = false; ///< its own or a library's
	std::vector<TRTRef<FVulkanPipeline>> Libraries;
};

} // namespace Lantern
