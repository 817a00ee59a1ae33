// FVulkanPipeline: compute and raster pipelines.
#include "Pipelines/VulkanPipeline.h"

#include "Pipelines/VulkanShaderModules.h"

namespace Lantern
{

namespace
{

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
		Depth.depthCompareOp = Desc.bReversedDepth ? VK_COMPARE_OP_GREATER_OR_EQUAL : VK_COMPARE_OP_LESS_OR_EQUAL;
		for (uint32_t Index = 0; Index < Desc.ColorCount; ++Index)
		{
			Attachments[Index].colorWriteMask =
			    VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
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

} // namespace

FRTStatus FVulkanPipeline::Finish(VkResult Result, const char* What, const char* Name)
{
	if (Device.Check(Result) != VK_SUCCESS)
	{
		Handle = VK_NULL_HANDLE;
		FRTStatus Status = MakeStatus(Result, What, Name);
		if (Status.Code == ERTResult::Unsupported)
		{
			Status.Code = ERTResult::CompileFailed; // results that are not specific to the creation of pipelines
		}
		return Status;
	}
	Device.SetName(VK_OBJECT_TYPE_PIPELINE, ToNative(Handle), Name);
	return {};
}

FRTStatus FVulkanPipeline::InitialiseCompute(const FRTComputePipelineDesc& Desc)
{
	FVulkanModules Modules(Device);
	FRTStatus Status = Modules.Add(Desc.Shader);
	if (!Status) { return Status; }
	BindPoint = VK_PIPELINE_BIND_POINT_COMPUTE;
	VkComputePipelineCreateInfo Info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
	Info.stage = Modules.Stages[0];
	Info.layout = Device.Bindless.PipelineLayout;
	return Finish(Device.Api.CreateComputePipelines(Device.Handle, Device.Cache.Handle, 1, &Info, nullptr, &Handle),
	    "Creating compute pipeline", Desc.Name);
}

FRTStatus FVulkanPipeline::InitialiseRaster(const FRTRasterPipelineDesc& Desc)
{
	FVulkanModules Modules(Device);
	FRTStatus Status = Modules.Add(Desc.Vertex);
	if (Status && Desc.Fragment.Words) { Status = Modules.Add(Desc.Fragment); }
	if (!Status) { return Status; }
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
