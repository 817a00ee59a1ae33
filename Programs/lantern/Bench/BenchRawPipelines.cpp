// Pipelines and shader table of the raw dispatch.
#include <cstring>

#include "Bench/BenchRawShadow.h"

namespace Lantern
{

namespace
{
VkPipelineShaderStageCreateInfo MakeStage(VkShaderStageFlagBits Stage, VkShaderModule Module)
{
	VkPipelineShaderStageCreateInfo Info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
	Info.stage = Stage;
	Info.module = Module;
	Info.pName = "main";
	return Info;
}

VkRayTracingShaderGroupCreateInfoKHR MakeGroup(bool bHit, uint32_t Shader)
{
	VkRayTracingShaderGroupCreateInfoKHR Group{VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR};
	Group.type = bHit ? VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR : VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR;
	Group.generalShader = bHit ? VK_SHADER_UNUSED_KHR : Shader;
	Group.closestHitShader = Group.intersectionShader = VK_SHADER_UNUSED_KHR;
	Group.anyHitShader = bHit ? Shader : VK_SHADER_UNUSED_KHR;
	return Group;
}

constexpr uint64_t Align(uint64_t Value, uint64_t Alignment) { return (Value + Alignment - 1) / Alignment * Alignment; }
} // namespace

FRTStatus FRawShadow::CreateComputePipeline()
{
	VkShaderModule Module = VK_NULL_HANDLE;
	if (FRTStatus S = CompileModule("RawShadow.comp", ERTShaderStage::Compute, Module); !S) { return S; }
	VkComputePipelineCreateInfo Info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
	Info.stage = MakeStage(VK_SHADER_STAGE_COMPUTE_BIT, Module);
	Info.layout = Tables.GetLayout();
	return CheckVulkan(
	    Vulkan.CreateComputePipelines(Vulkan.Device, VK_NULL_HANDLE, 1, &Info, nullptr, &Pipeline), "vkCreateComputePipelines");
}

FRTStatus FRawShadow::CreateRayPipeline()
{
	VkShaderModule RayGen = VK_NULL_HANDLE, Miss = VK_NULL_HANDLE, AnyHit = VK_NULL_HANDLE;
	if (FRTStatus S = CompileModule("RawShadow.rgen", ERTShaderStage::RayGen, RayGen); !S) { return S; }
	if (FRTStatus S = CompileModule("RawShadow.rmiss", ERTShaderStage::Miss, Miss); !S) { return S; }
	std::vector<VkPipelineShaderStageCreateInfo> Stages = {
	    MakeStage(VK_SHADER_STAGE_RAYGEN_BIT_KHR, RayGen), MakeStage(VK_SHADER_STAGE_MISS_BIT_KHR, Miss)};
	std::vector<VkRayTracingShaderGroupCreateInfoKHR> Groups = {
	    MakeGroup(false, 0), MakeGroup(false, 1), MakeGroup(true, VK_SHADER_UNUSED_KHR)};
	if (Tables.HasMasked())
	{
		if (FRTStatus S = CompileModule("RawShadow.rahit", ERTShaderStage::AnyHit, AnyHit); !S) { return S; }
		Stages.push_back(MakeStage(VK_SHADER_STAGE_ANY_HIT_BIT_KHR, AnyHit));
		Groups.push_back(MakeGroup(true, 2));
	}
	VkRayTracingPipelineCreateInfoKHR Info{VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR};
	Info.stageCount = static_cast<uint32_t>(Stages.size());
	Info.pStages = Stages.data();
	Info.groupCount = static_cast<uint32_t>(Groups.size());
	Info.pGroups = Groups.data();
	Info.maxPipelineRayRecursionDepth = 1;
	Info.layout = Tables.GetLayout();
	const VkResult Result =
	    Vulkan.CreateRayTracingPipelinesKHR(Vulkan.Device, VK_NULL_HANDLE, VK_NULL_HANDLE, 1, &Info, nullptr, &Pipeline);
	if (FRTStatus S = CheckVulkan(Result, "vkCreateRayTracingPipelinesKHR"); !S) { return S; }
	return CreateShaderTable();
}

FRTStatus FRawShadow::CreateShaderTable()
{
	const FRTCapabilities& Capabilities = Desc.Device->GetCapabilities();
	const uint64_t Handle = Capabilities.ShaderGroupHandleSize, Base = Capabilities.ShaderGroupBaseAlignment;
	std::vector<uint8_t> Handles(4 * Handle);
	if (FRTStatus S = CheckVulkan(Vulkan.GetRayTracingShaderGroupHandlesKHR(
	                                  Vulkan.Device, Pipeline, 0, Tables.HasMasked() ? 4 : 3, Handles.size(), Handles.data()),
	        "vkGetRayTracingShaderGroupHandlesKHR");
	    !S)
	{
		return S;
	}
	const std::vector<FRawSection>& Sections = Tables.GetSections();
	const uint64_t Stride = Align(Handle + sizeof(FRawSection), Capabilities.ShaderGroupHandleAlignment);
	const uint64_t MissOffset = Align(Handle, Base), HitOffset = 2 * MissOffset;
	std::vector<uint8_t> Records(HitOffset + Sections.size() * Stride);
	std::memcpy(Records.data(), Handles.data(), Handle);
	std::memcpy(Records.data() + MissOffset, Handles.data() + Handle, Handle);
	for (size_t Section = 0; Section < Sections.size(); ++Section)
	{
		uint8_t* const Record = Records.data() + HitOffset + Section * Stride;
		std::memcpy(Record, Handles.data() + (Tables.IsMasked(Section) ? 3 : 2) * Handle, Handle);
		std::memcpy(Record + Handle, &Sections[Section], sizeof(FRawSection));
	}
	FUploader Uploader(*Desc.Device);
	if (FRTStatus S = Uploader.CreateBuffer("RawShaderTable", ERTBufferUsage::ShaderTable, Records.data(), Records.size(), ShaderTable); !S)
	{
		return S;
	}
	if (ShaderTable->GetDeviceAddress() % Base != 0)
	{
		return FRTStatus::Error(
		    ERTResult::Unsupported, "raw dispatch: the shader table's address is not a multiple of %u", static_cast<unsigned>(Base));
	}
	RayGenRegion = {ShaderTable->GetDeviceAddress(), MissOffset, MissOffset};
	MissRegion = {ShaderTable->GetDeviceAddress() + MissOffset, MissOffset, MissOffset};
	HitRegion = {ShaderTable->GetDeviceAddress() + HitOffset, Stride, Sections.size() * Stride};
	return Uploader.Flush();
}

} // namespace Lantern
