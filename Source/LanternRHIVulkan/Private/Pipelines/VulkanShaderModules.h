// Shader modules while a pipeline is created.
#pragma once

#include "Device/VulkanDeviceImpl.h"

#include <cassert>
#include <vector>

namespace Lantern
{

/// Shader modules that one creation of a pipeline needs. Destroyed with this object.
class FVulkanModules
{
public:
	explicit FVulkanModules(FVulkanDevice& InDevice) : Device(InDevice) {}
	FVulkanModules(const FVulkanModules&) = delete;
	FVulkanModules& operator=(const FVulkanModules&) = delete;
	~FVulkanModules()
	{
		for (const VkPipelineShaderStageCreateInfo& Stage : Stages)
		{
			Device.Api.DestroyShaderModule(Device.Handle, Stage.module, nullptr);
		}
	}

	FRTStatus Add(const FRTShaderCode& Code)
	{
		assert(Code.Words && Code.WordCount > 0);
		VkShaderModuleCreateInfo Info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
		Info.codeSize = Code.WordCount * sizeof(uint32_t);
		Info.pCode = Code.Words;
		VkPipelineShaderStageCreateInfo Stage{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
		Stage.stage = StageOf(Code.Stage);
		Stage.pName = "main";
		const VkResult Result = Device.Check(Device.Api.CreateShaderModule(Device.Handle, &Info, nullptr, &Stage.module));
		if (Result != VK_SUCCESS) { return MakeStatus(Result, "Creating shader", Code.Name); }
		Device.SetName(VK_OBJECT_TYPE_SHADER_MODULE, ToNative(Stage.module), Code.Name);
		Stages.push_back(Stage);
		return {};
	}

	std::vector<VkPipelineShaderStageCreateInfo> Stages;

private:
	FVulkanDevice& Device;
};

} // namespace Lantern
