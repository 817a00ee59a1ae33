#pragma once

#include "VulkanDeviceImpl.h"

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
	FRTStatus InitialiseRayTracing(const FRTRayTracingPipelineDesc& Desc);

	uint32_t GetGroupCount() const override { return GroupCount; }
	uint64_t GetNative(ERTNative Kind) const override;

	/// ShaderGroupHandleSize bytes.
	const uint8_t* GetGroupHandle(uint32_t Group) const;

	VkPipeline Handle = VK_NULL_HANDLE;
	VkPipelineBindPoint BindPoint = VK_PIPELINE_BIND_POINT_COMPUTE;

private:
	~FVulkanPipeline() override { Device.Api.DestroyPipeline(Device.Handle, Handle, nullptr); }
	FRTStatus Finish(VkResult Result, const char* What, const char* Name);

	uint32_t GroupCount = 0;
	std::vector<uint8_t> GroupHandles;
};

} // namespace Lantern
