// Plain Vulkan functions for the hand-written dispatch of the benchmark, which goes past the RHI.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

#define LANTERN_BENCH_VULKAN_FUNCTIONS(X)                                                                                                  \
	X(AllocateCommandBuffers)                                                                                                              \
	X(AllocateDescriptorSets)                                                                                                              \
	X(BeginCommandBuffer)                                                                                                                  \
	X(CmdBindDescriptorSets)                                                                                                               \
	X(CmdBindPipeline)                                                                                                                     \
	X(CmdCopyImageToBuffer)                                                                                                                \
	X(CmdDispatch)                                                                                                                         \
	X(CmdPipelineBarrier2)                                                                                                                 \
	X(CmdPushConstants)                                                                                                                    \
	X(CmdResetQueryPool)                                                                                                                   \
	X(CmdWriteTimestamp2)                                                                                                                  \
	X(CreateCommandPool)                                                                                                                   \
	X(CreateComputePipelines)                                                                                                              \
	X(CreateDescriptorPool)                                                                                                                \
	X(CreateDescriptorSetLayout)                                                                                                           \
	X(CreateFence)                                                                                                                         \
	X(CreateImageView)                                                                                                                     \
	X(CreatePipelineLayout)                                                                                                                \
	X(CreateQueryPool)                                                                                                                     \
	X(CreateSampler)                                                                                                                       \
	X(CreateShaderModule)                                                                                                                  \
	X(DestroyCommandPool)                                                                                                                  \
	X(DestroyDescriptorPool)                                                                                                               \
	X(DestroyDescriptorSetLayout)                                                                                                          \
	X(DestroyFence)                                                                                                                        \
	X(DestroyImageView)                                                                                                                    \
	X(DestroyPipeline)                                                                                                                     \
	X(DestroyPipelineLayout)                                                                                                               \
	X(DestroyQueryPool)                                                                                                                    \
	X(DestroySampler)                                                                                                                      \
	X(DestroyShaderModule)                                                                                                                 \
	X(EndCommandBuffer)                                                                                                                    \
	X(GetQueryPoolResults)                                                                                                                 \
	X(QueueSubmit)                                                                                                                         \
	X(ResetCommandPool)                                                                                                                    \
	X(ResetFences)                                                                                                                         \
	X(UpdateDescriptorSets)                                                                                                                \
	X(WaitForFences)

/// These are null on a device without ray-tracing pipelines.
#define LANTERN_BENCH_VULKAN_PIPELINE_FUNCTIONS(X)                                                                                         \
	X(CmdTraceRaysKHR)                                                                                                                     \
	X(CreateRayTracingPipelinesKHR)                                                                                                        \
	X(GetRayTracingShaderGroupHandlesKHR)

/// Device functions, loaded for the VkDevice behind an IRTDevice.
struct FBenchVulkan
{
	VkDevice Device = VK_NULL_HANDLE;
	VkQueue Queue = VK_NULL_HANDLE;
	uint32_t QueueFamily = 0;
#define LANTERN_DECLARE(Name) PFN_vk##Name Name = nullptr;
	LANTERN_BENCH_VULKAN_FUNCTIONS(LANTERN_DECLARE)
	LANTERN_BENCH_VULKAN_PIPELINE_FUNCTIONS(LANTERN_DECLARE)
#undef LANTERN_DECLARE

	/// Unsupported if the device is no Vulkan device or the loader cannot be opened.
	FRTStatus Load(IRTDevice& Rhi);
};

/// Success for VK_SUCCESS; otherwise an error that names What, the Vulkan call.
FRTStatus CheckVulkan(VkResult Result, const char* What);

} // namespace Lantern
