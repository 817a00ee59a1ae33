// From the RHI's words to Vulkan's: formats, usages, accesses.
#pragma once

#include "Device/VulkanApi.h"

namespace Lantern
{

struct FVulkanCapabilityBits
{
	bool bAccel = false;
	bool bRayQuery = false;
	bool bPipeline = false;
	bool bMaintenance1 = false;
};

struct FVulkanAccess
{
	VkPipelineStageFlags2 Stages = 0;
	VkAccessFlags2 Access = 0;
};

/// Returns what shaders and copies see of a format.
VkImageAspectFlags AspectOf(ERTFormat Format);
/// Returns what barriers and attachments take.
VkImageAspectFlags AllAspectsOf(ERTFormat Format);
bool IsIntegerFormat(ERTFormat Format);
VkImageUsageFlags ImageUsageOf(const FRTTextureDesc& Desc);
VkBufferUsageFlags BufferUsageOf(ERTBufferUsage Usage, const FVulkanCapabilityBits& Bits);
/// Leaves out stages that the device has not enabled: naming them is an error.
FVulkanAccess AccessOf(ERTAccess Access, const FVulkanCapabilityBits& Bits);
/// Leaves out stages that a queue without graphics has not, and what only they do.
FVulkanAccess ForComputeQueue(FVulkanAccess Access);
VkShaderStageFlagBits StageOf(ERTShaderStage Stage);
/// Returns all shader stages that a pipeline of the device may have.
VkShaderStageFlags AllStages(const FVulkanCapabilityBits& Bits);

} // namespace Lantern
