// The raster pass that fills the G-buffer.
#include "Example/ForkRaster.h"

#include <array>
#include <cstddef>
#include <cstring>

#include <glm/gtc/quaternion.hpp>

#include "ForkFragmentShader.h"
#include "ForkVertexShader.h"

namespace Fork
{

namespace
{

struct FPush
{
	glm::mat4 ViewToClip;
	glm::vec4 WorldToView; ///< quaternion
	glm::vec4 Offset, Scale;
};
static_assert(sizeof(FPush) == 112, "Fork.vert");

/// Jitter moves the whole picture, so it is added to clip space.
FPush MakePush(const FCamera& Camera, VkExtent2D Size)
{
	FPush Push{};
	glm::mat4 Jitter(1.0f);
	Jitter[3][0] = static_cast<float>(2.0 * Camera.Jitter.x / Size.width);
	Jitter[3][1] = static_cast<float>(2.0 * Camera.Jitter.y / Size.height);
	Push.ViewToClip = Jitter * GetViewToClip(Camera, double(Size.width) / Size.height);
	const glm::dquat Rotation = glm::quat_cast(GetWorldToView(Camera));
	Push.WorldToView = glm::vec4(Rotation.x, Rotation.y, Rotation.z, Rotation.w);
	return Push;
}

VkShaderModule CreateShader(VkDevice Device, const uint32_t* Words, size_t Bytes)
{
	VkShaderModuleCreateInfo Info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
	Info.codeSize = Bytes;
	Info.pCode = Words;
	VkShaderModule Module = VK_NULL_HANDLE;
	vkCreateShaderModule(Device, &Info, nullptr, &Module);
	return Module;
}

constexpr std::array Attributes = {
    VkVertexInputAttributeDescription{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(FVertex, Position)},
    VkVertexInputAttributeDescription{1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(FVertex, Normal)},
};
constexpr VkVertexInputBindingDescription Binding{0, sizeof(FVertex), VK_VERTEX_INPUT_RATE_VERTEX};

VkPipelineVertexInputStateCreateInfo DescribeVertices()
{
	VkPipelineVertexInputStateCreateInfo Info{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
	Info.vertexBindingDescriptionCount = 1;
	Info.pVertexBindingDescriptions = &Binding;
	Info.vertexAttributeDescriptionCount = static_cast<uint32_t>(Attributes.size());
	Info.pVertexAttributeDescriptions = Attributes.data();
	return Info;
}

} // namespace

FError FForkRaster::Create(const FForkDevice& InOwner, VkExtent2D InSize)
{
	Device = InOwner.Device;
	Size = InSize;
	constexpr VkImageUsageFlags Usage = VK_IMAGE_USAGE_SAMPLED_BIT;
	FError Error = Depth.Create(InOwner, Size, DepthFormat, Usage | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
	    VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT);
	if (Error.empty())
	{
		Error = Normals.Create(InOwner, Size, NormalsFormat, Usage | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_IMAGE_ASPECT_COLOR_BIT);
	}
	const FBoxMesh Box = MakeBoxMesh();
	if (Error.empty()) { Error = Mesh.Create(InOwner, sizeof(Box), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT); }
	if (!Error.empty()) { return Error; }
	std::memcpy(Mesh.Mapped, &Box, sizeof(Box));
	return CreatePipeline();
}

FError FForkRaster::CreatePipeline()
{
	const VkPushConstantRange Range{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(FPush)};
	VkPipelineLayoutCreateInfo LayoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
	LayoutInfo.pushConstantRangeCount = 1;
	LayoutInfo.pPushConstantRanges = &Range;
	vkCreatePipelineLayout(Device, &LayoutInfo, nullptr, &Layout);

	std::array<VkPipelineShaderStageCreateInfo, 2> Stages{};
	Stages[0] = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, VK_SHADER_STAGE_VERTEX_BIT,
	    CreateShader(Device, ForkVertexShader, sizeof(ForkVertexShader)), "main", nullptr};
	Stages[1] = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, VK_SHADER_STAGE_FRAGMENT_BIT,
	    CreateShader(Device, ForkFragmentShader, sizeof(ForkFragmentShader)), "main", nullptr};

	const VkPipelineVertexInputStateCreateInfo Vertices = DescribeVertices();
	VkPipelineInputAssemblyStateCreateInfo Assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
	Assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
	const VkViewport Viewport{0, 0, float(Size.width), float(Size.height), 0, 1};
	const VkRect2D Scissor{{0, 0}, Size};
	VkPipelineViewportStateCreateInfo View{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
	View.viewportCount = View.scissorCount = 1;
	View.pViewports = &Viewport;
	View.pScissors = &Scissor;
	VkPipelineRasterizationStateCreateInfo Raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
	Raster.cullMode = VK_CULL_MODE_BACK_BIT;
	Raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
	Raster.lineWidth = 1.0f;
	VkPipelineMultisampleStateCreateInfo Multisample{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
	Multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
	VkPipelineDepthStencilStateCreateInfo DepthState{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
	DepthState.depthTestEnable = DepthState.depthWriteEnable = VK_TRUE;
	DepthState.depthCompareOp = VK_COMPARE_OP_LESS;
	VkPipelineColorBlendAttachmentState Target{};
	Target.colorWriteMask = 0xf;
	VkPipelineColorBlendStateCreateInfo Blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
	Blend.attachmentCount = 1;
	Blend.pAttachments = &Target;
	VkPipelineRenderingCreateInfo Rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
	Rendering.colorAttachmentCount = 1;
	Rendering.pColorAttachmentFormats = &NormalsFormat;
	Rendering.depthAttachmentFormat = DepthFormat;

	VkGraphicsPipelineCreateInfo Info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &Rendering};
	Info.stageCount = static_cast<uint32_t>(Stages.size());
	Info.pStages = Stages.data();
	Info.pVertexInputState = &Vertices;
	Info.pInputAssemblyState = &Assembly;
	Info.pViewportState = &View;
	Info.pRasterizationState = &Raster;
	Info.pMultisampleState = &Multisample;
	Info.pDepthStencilState = &DepthState;
	Info.pColorBlendState = &Blend;
	Info.layout = Layout;
	const VkResult Result = vkCreateGraphicsPipelines(Device, VK_NULL_HANDLE, 1, &Info, nullptr, &Pipeline);
	for (const VkPipelineShaderStageCreateInfo& Stage : Stages) { vkDestroyShaderModule(Device, Stage.module, nullptr); }
	return Result == VK_SUCCESS ? FError() : "vkCreateGraphicsPipelines failed with " + std::to_string(Result);
}

void FForkRaster::Draw(VkCommandBuffer Commands, const FForkScene& Scene, const FCamera& Camera, const FForkSkin& Skin) const
{
	constexpr VkImageAspectFlags Both = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
	Transition(Commands, Depth.Image, Both, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
	Transition(Commands, Normals.Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);

	VkRenderingAttachmentInfo Color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
	Color.imageView = Normals.View;
	Color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
	Color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
	Color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
	VkRenderingAttachmentInfo DepthTarget{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
	DepthTarget.imageView = Depth.View;
	DepthTarget.imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
	DepthTarget.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
	DepthTarget.clearValue.depthStencil = {1.0f, 0}; // the far plane
	DepthTarget.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
	VkRenderingInfo Info{VK_STRUCTURE_TYPE_RENDERING_INFO};
	Info.renderArea = {{0, 0}, Size};
	Info.layerCount = 1;
	Info.colorAttachmentCount = 1;
	Info.pColorAttachments = &Color;
	Info.pDepthAttachment = &DepthTarget;
	vkCmdBeginRendering(Commands, &Info);
	DrawBoxes(Commands, Scene, Camera);
	DrawReed(Commands, Scene, Camera, Skin);
	vkCmdEndRendering(Commands);

	Transition(Commands, Depth.Image, Both, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, DepthLayout);
	Transition(Commands, Normals.Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
	    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

void FForkRaster::DrawBoxes(VkCommandBuffer Commands, const FForkScene& Scene, const FCamera& Camera) const
{
	vkCmdBindPipeline(Commands, VK_PIPELINE_BIND_POINT_GRAPHICS, Pipeline);
	const VkDeviceSize Start = 0;
	vkCmdBindVertexBuffers(Commands, 0, 1, &Mesh.Buffer, &Start);
	vkCmdBindIndexBuffer(Commands, Mesh.Buffer, offsetof(FBoxMesh, Indices), VK_INDEX_TYPE_UINT32);
	FPush Push = MakePush(Camera, Size);
	for (const FBox& Box : Scene.Boxes)
	{
		Push.Offset = glm::vec4(glm::vec3(Box.Centre - Camera.Position), 0.0f);
		Push.Scale = glm::vec4(glm::vec3(Box.HalfSize), 0.0f);
		vkCmdPushConstants(Commands, Layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Push), &Push);
		vkCmdDrawIndexed(Commands, 36, 1, 0, 0, 0);
	}
}

void FForkRaster::DrawReed(VkCommandBuffer Commands, const FForkScene& Scene, const FCamera& Camera, const FForkSkin& Skin) const
{
	const VkDeviceSize Start = 0;
	vkCmdBindVertexBuffers(Commands, 0, 1, &Skin.Vertices.Buffer, &Start);
	vkCmdBindIndexBuffer(Commands, Skin.Indices.Buffer, 0, VK_INDEX_TYPE_UINT32);
	FPush Push = MakePush(Camera, Size);
	Push.Offset = glm::vec4(glm::vec3(Scene.Reed.Middle - Camera.Position), 0.0f);
	Push.Scale = glm::vec4(1.0f);
	vkCmdPushConstants(Commands, Layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Push), &Push);
	vkCmdDrawIndexed(Commands, Skin.IndexCount, 1, 0, 0, 0);
}

FForkRaster::~FForkRaster()
{
	if (Device != VK_NULL_HANDLE)
	{
		vkDestroyPipeline(Device, Pipeline, nullptr);
		vkDestroyPipelineLayout(Device, Layout, nullptr);
	}
}

} // namespace Fork
