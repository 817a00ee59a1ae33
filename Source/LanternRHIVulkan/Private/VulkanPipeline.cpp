#include "VulkanPipeline.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "VulkanQuirks.h"

namespace Lantern
{

namespace
{

/// Shader modules of one pipeline creation; they are needed no longer than that.
class FModules
{
public:
	explicit FModules(FVulkanDevice& InDevice) : Device(InDevice) {}
	FModules(const FModules&) = delete;
	FModules& operator=(const FModules&) = delete;
	~FModules()
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
		const VkResult Result =
		    Device.Check(Device.Api.CreateShaderModule(Device.Handle, &Info, nullptr, &Stage.module));
		if (Result != VK_SUCCESS)
		{
			return MakeStatus(Result, "Creating shader", Code.Name);
		}
		Device.SetName(VK_OBJECT_TYPE_SHADER_MODULE, ToNative(Stage.module), Code.Name);
		Stages.push_back(Stage);
		return {};
	}

	std::vector<VkPipelineShaderStageCreateInfo> Stages;

private:
	FVulkanDevice& Device;
};

VkCullModeFlags CullOf(ERTCull Cull)
{
	switch (Cull)
	{
	case ERTCull::None: return VK_CULL_MODE_NONE;
	case ERTCull::Back: return VK_CULL_MODE_BACK_BIT;
	case ERTCull::Front: return VK_CULL_MODE_FRONT_BIT;
	}
	return VK_CULL_MODE_NONE;
}

/// The fixed state of a raster pipeline; it points into itself.
struct FRasterState
{
	static constexpr uint32_t MaxColors = 8;

	explicit FRasterState(const FRTRasterPipelineDesc& Desc)
	{
		assert(Desc.ColorCount <= MaxColors);
		Assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
		Viewport.viewportCount = 1;
		Viewport.scissorCount = 1;
		Raster.polygonMode = VK_POLYGON_MODE_FILL;
		Raster.cullMode = CullOf(Desc.Cull);
		Raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
		Raster.lineWidth = 1.0f;
		Samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
		const bool bDepth = Desc.DepthFormat != ERTFormat::Unknown;
		Depth.depthTestEnable = bDepth;
		Depth.depthWriteEnable = bDepth && Desc.bDepthWrite;
		Depth.depthCompareOp = VK_COMPARE_OP_GREATER_OR_EQUAL;
		for (uint32_t Index = 0; Index < Desc.ColorCount; ++Index)
		{
			Attachments[Index].colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
			                                    VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
			Formats[Index] = GetVulkanFormat(Desc.ColorFormats[Index]);
		}
		Blend.attachmentCount = Desc.ColorCount;
		Blend.pAttachments = Attachments;
		Dynamic.dynamicStateCount = 2;
		Dynamic.pDynamicStates = DynamicStates;
		Rendering.colorAttachmentCount = Desc.ColorCount;
		Rendering.pColorAttachmentFormats = Formats;
		Rendering.depthAttachmentFormat = GetVulkanFormat(Desc.DepthFormat);
	}
	FRasterState(const FRasterState&) = delete;
	FRasterState& operator=(const FRasterState&) = delete;

	VkPipelineVertexInputStateCreateInfo VertexInput{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
	VkPipelineInputAssemblyStateCreateInfo Assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
	VkPipelineViewportStateCreateInfo Viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
	VkPipelineRasterizationStateCreateInfo Raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
	VkPipelineMultisampleStateCreateInfo Samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
	VkPipelineDepthStencilStateCreateInfo Depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
	VkPipelineColorBlendAttachmentState Attachments[MaxColors] = {};
	VkFormat Formats[MaxColors] = {};
	VkPipelineColorBlendStateCreateInfo Blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
	VkDynamicState DynamicStates[2] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
	VkPipelineDynamicStateCreateInfo Dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
	VkPipelineRenderingCreateInfo Rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
};

VkRayTracingShaderGroupTypeKHR GroupTypeOf(ERTGroupKind Kind)
{
	switch (Kind)
	{
	case ERTGroupKind::General: return VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR;
	case ERTGroupKind::Triangles: return VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR;
	case ERTGroupKind::Procedural: return VK_RAY_TRACING_SHADER_GROUP_TYPE_PROCEDURAL_HIT_GROUP_KHR;
	}
	return VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR;
}

/// `void main() {}` as a closest-hit shader, by glslang.
constexpr uint32_t EmptyClosestHit[] = {
    0x07230203, 0x00010500, 0x0008000b, 0x00000006, 0x00000000, 0x00020011, 0x0000117f, 0x0006000a, 0x5f565053,
    0x5f52484b, 0x5f796172, 0x63617274, 0x00676e69, 0x0006000b, 0x00000001, 0x4c534c47, 0x6474732e, 0x3035342e,
    0x00000000, 0x0003000e, 0x00000000, 0x00000001, 0x0005000f, 0x000014c4, 0x00000004, 0x6e69616d, 0x00000000,
    0x00020013, 0x00000002, 0x00030021, 0x00000003, 0x00000002, 0x00050036, 0x00000002, 0x00000004, 0x00000000,
    0x00000003, 0x000200f8, 0x00000005, 0x000100fd, 0x00010038};

using FGroups = std::vector<VkRayTracingShaderGroupCreateInfoKHR>;

FGroups MakeGroups(const FRTRayTracingPipelineDesc& Desc)
{
	static_assert(NoShader == VK_SHADER_UNUSED_KHR, "indices are passed on as they are");
	FGroups Groups(Desc.GroupCount);
	for (uint32_t Index = 0; Index < Desc.GroupCount; ++Index)
	{
		const FRTShaderGroup& Group = Desc.Groups[Index];
		Groups[Index] = {VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR};
		Groups[Index].type = GroupTypeOf(Group.Kind);
		Groups[Index].generalShader = Group.General;
		Groups[Index].closestHitShader = Group.ClosestHit;
		Groups[Index].anyHitShader = Group.AnyHit;
		Groups[Index].intersectionShader = Group.Intersection;
	}
	return Groups;
}

bool HasHitShader(const FGroups& Groups)
{
	return std::any_of(Groups.begin(), Groups.end(),
	                   [](const VkRayTracingShaderGroupCreateInfoKHR& Group)
	                   { return Group.closestHitShader != NoShader || Group.anyHitShader != NoShader; });
}

/// EVulkanQuirk::CrashWithoutHitShaders: a group behind those asked for, which no shader table knows of.
FRTStatus AddUnusedHitShader(FModules& Modules, FGroups& Groups)
{
	VkRayTracingShaderGroupCreateInfoKHR Group{VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR};
	Group.type = VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR;
	Group.generalShader = Group.anyHitShader = Group.intersectionShader = VK_SHADER_UNUSED_KHR;
	Group.closestHitShader = static_cast<uint32_t>(Modules.Stages.size());
	Groups.push_back(Group);
	return Modules.Add({EmptyClosestHit, std::size(EmptyClosestHit), ERTShaderStage::ClosestHit, "EmptyClosestHit"});
}

} // namespace

FRTStatus FVulkanPipeline::Finish(VkResult Result, const char* What, const char* Name)
{
	if (Device.Check(Result) != VK_SUCCESS)
	{
		Handle = VK_NULL_HANDLE;
		FRTStatus Status = MakeStatus(Result, What, Name);
		if (Status.Code == ERTResult::Unsupported)
		{
			Status.Code = ERTResult::CompileFailed; // unspecific results of a pipeline's creation
		}
		return Status;
	}
	Device.SetName(VK_OBJECT_TYPE_PIPELINE, ToNative(Handle), Name);
	return {};
}

FRTStatus FVulkanPipeline::InitialiseCompute(const FRTComputePipelineDesc& Desc)
{
	FModules Modules(Device);
	FRTStatus Status = Modules.Add(Desc.Shader);
	if (!Status)
	{
		return Status;
	}
	BindPoint = VK_PIPELINE_BIND_POINT_COMPUTE;
	VkComputePipelineCreateInfo Info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
	Info.stage = Modules.Stages[0];
	Info.layout = Device.Bindless.PipelineLayout;
	return Finish(Device.Api.CreateComputePipelines(Device.Handle, Device.Cache.Handle, 1, &Info, nullptr, &Handle),
	              "Creating compute pipeline", Desc.Name);
}

FRTStatus FVulkanPipeline::InitialiseRaster(const FRTRasterPipelineDesc& Desc)
{
	FModules Modules(Device);
	FRTStatus Status = Modules.Add(Desc.Vertex);
	if (Status && Desc.Fragment.Words)
	{
		Status = Modules.Add(Desc.Fragment);
	}
	if (!Status)
	{
		return Status;
	}
	BindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
	const FRasterState State(Desc);
	VkGraphicsPipelineCreateInfo Info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &State.Rendering};
	Info.stageCount = static_cast<uint32_t>(Modules.Stages.size());
	Info.pStages = Modules.Stages.data();
	Info.pVertexInputState = &State.VertexInput;
	Info.pInputAssemblyState = &State.Assembly;
	Info.pViewportState = &State.Viewport;
	Info.pRasterizationState = &State.Raster;
	Info.pMultisampleState = &State.Samples;
	Info.pDepthStencilState = &State.Depth;
	Info.pColorBlendState = &State.Blend;
	Info.pDynamicState = &State.Dynamic;
	Info.layout = Device.Bindless.PipelineLayout;
	return Finish(Device.Api.CreateGraphicsPipelines(Device.Handle, Device.Cache.Handle, 1, &Info, nullptr, &Handle),
	              "Creating raster pipeline", Desc.Name);
}

FRTStatus FVulkanPipeline::InitialiseRayTracing(const FRTRayTracingPipelineDesc& Desc)
{
	const FRTCapabilities& Caps = Device.GetCapabilities();
	if (!Caps.bRayTracingPipeline)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "'%.200s': the device has no ray-tracing pipelines", Desc.Name);
	}
	if (Desc.MaxRecursion > Caps.MaxRayRecursionDepth)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "'%.200s' needs recursion %u; the device's limit is %u",
		                        Desc.Name, Desc.MaxRecursion, Caps.MaxRayRecursionDepth);
	}
	if (Desc.bLibrary || Desc.LibraryCount > 0)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "'%.200s': no pipeline libraries yet", Desc.Name);
	}
	FModules Modules(Device);
	for (uint32_t Index = 0; Index < Desc.ShaderCount; ++Index)
	{
		FRTStatus Status = Modules.Add(Desc.Shaders[Index]);
		if (!Status)
		{
			return Status;
		}
	}
	FGroups Groups = MakeGroups(Desc);
	const bool bNeedsHitShader =
	    (Device.Probe.Quirks & static_cast<uint32_t>(EVulkanQuirk::CrashWithoutHitShaders)) != 0;
	if (bNeedsHitShader && !HasHitShader(Groups))
	{
		FRTStatus Status = AddUnusedHitShader(Modules, Groups);
		if (!Status)
		{
			return Status;
		}
	}
	BindPoint = VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR;
	VkRayTracingPipelineCreateInfoKHR Info{VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR};
	Info.stageCount = static_cast<uint32_t>(Modules.Stages.size());
	Info.pStages = Modules.Stages.data();
	Info.groupCount = static_cast<uint32_t>(Groups.size());
	Info.pGroups = Groups.data();
	Info.maxPipelineRayRecursionDepth = Desc.MaxRecursion;
	Info.layout = Device.Bindless.PipelineLayout;
	FRTStatus Status = Finish(Device.Api.CreateRayTracingPipelinesKHR(Device.Handle, VK_NULL_HANDLE,
	                                                                  Device.Cache.Handle, 1, &Info, nullptr, &Handle),
	                          "Creating ray-tracing pipeline", Desc.Name);
	if (!Status)
	{
		return Status;
	}
	GroupCount = Desc.GroupCount;
	GroupHandles.resize(size_t(GroupCount) * Caps.ShaderGroupHandleSize);
	return MakeStatus(Device.Check(Device.Api.GetRayTracingShaderGroupHandlesKHR(
	                      Device.Handle, Handle, 0, GroupCount, GroupHandles.size(), GroupHandles.data())),
	                  "Reading the group handles of", Desc.Name);
}

const uint8_t* FVulkanPipeline::GetGroupHandle(uint32_t Group) const
{
	assert(Group < GroupCount);
	return GroupHandles.data() + size_t(Group) * Device.GetCapabilities().ShaderGroupHandleSize;
}

uint64_t FVulkanPipeline::GetNative(ERTNative Kind) const
{
	switch (Kind)
	{
	case ERTNative::Pipeline: return ToNative(Handle);
	case ERTNative::PipelineLayout: return ToNative(Device.Bindless.PipelineLayout);
	default: return 0;
	}
}

} // namespace Lantern
