// The raster pass that fills the G-buffer.
#include "Example/ForkRaster.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <iterator>

#include "ForkFragmentShader.h"
#include "ForkVertexShader.h"

namespace Fork
{

namespace
{

constexpr VkShaderStageFlags PushStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// As in ForkDraw.glsl.
struct FViewData
{
	glm::mat4 JitteredViewToClip, WorldToView, RelativeToClip, PreviousRelativeToClip;
};
struct FPush
{
	VkDeviceAddress View = 0;
	glm::vec3 Offset{0}, Scale{1}, PreviousOffset{0}, PreviousScale{1}, Color{FForkRaster::Grey};
	uint32_t bCutOut = 0;
};
static_assert(sizeof(FPush) == 72 && sizeof(FViewData) == 256, "ForkDraw.glsl");

FViewData MakeViewData(const FCamera& Camera, const FCamera& Before)
{
	constexpr double Aspect = double(ViewSize.width) / ViewSize.height;
	const auto Turn = [](const FCamera& From) { return glm::mat4(glm::dmat4(GetWorldToView(From))); };
	glm::mat4 Jitter(1.0f); // moves the whole picture, so it is added to clip space
	Jitter[3][0] = static_cast<float>(2.0 * Camera.Jitter.x / ViewSize.width);
	Jitter[3][1] = static_cast<float>(2.0 * Camera.Jitter.y / ViewSize.height);
	const glm::mat4 ViewToClip = GetViewToClip(Camera, Aspect);
	return {Jitter * ViewToClip, Turn(Camera), ViewToClip * Turn(Camera), GetViewToClip(Before, Aspect) * Turn(Before)};
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
    VkVertexInputAttributeDescription{2, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(FVertex, Previous)},
    VkVertexInputAttributeDescription{3, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(FVertex, UV)},
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

FError FForkRaster::Create(const FForkDevice& InOwner)
{
	Device = InOwner.Device;
	constexpr VkImageUsageFlags Read = VK_IMAGE_USAGE_SAMPLED_BIT;
	FError Error = Depth.Create(InOwner, TextureSize, DepthFormat, Read | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
	    VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT);
	FForkImage* const Colors[] = {&Normals, &Motion, &BaseColor, &Material};
	for (size_t Index = 0; Error.empty() && Index < std::size(Colors); ++Index)
	{
		Error = Colors[Index]->Create(
		    InOwner, TextureSize, ColorFormats[Index], Read | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_IMAGE_ASPECT_COLOR_BIT);
	}
	const FBoxMesh Box = MakeBoxMesh();
	if (Error.empty()) { Error = Mesh.Create(InOwner, sizeof(Box), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT); }
	for (FForkBuffer& View : Views)
	{
		constexpr VkBufferUsageFlags Usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
		if (Error.empty()) { Error = View.Create(InOwner, sizeof(FViewData), Usage); }
	}
	if (!Error.empty()) { return Error; }
	std::memcpy(Mesh.Mapped, &Box, sizeof(Box));
	return CreatePipeline();
}

FError FForkRaster::CreatePipeline()
{
	const VkPushConstantRange Range{PushStages, 0, sizeof(FPush)};
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
	VkPipelineViewportStateCreateInfo View{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
	View.viewportCount = View.scissorCount = 1;
	constexpr VkDynamicState Dynamic[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
	VkPipelineDynamicStateCreateInfo DynamicInfo{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
	DynamicInfo.dynamicStateCount = static_cast<uint32_t>(std::size(Dynamic));
	DynamicInfo.pDynamicStates = Dynamic;
	VkPipelineRasterizationStateCreateInfo Raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
	Raster.cullMode = VK_CULL_MODE_BACK_BIT;
	Raster.frontFace = VK_FRONT_FACE_CLOCKWISE; // the world is left-handed
	Raster.lineWidth = 1.0f;
	VkPipelineMultisampleStateCreateInfo Multisample{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
	Multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
	VkPipelineDepthStencilStateCreateInfo DepthState{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
	DepthState.depthTestEnable = DepthState.depthWriteEnable = VK_TRUE;
	DepthState.depthCompareOp = VK_COMPARE_OP_LESS;
	VkPipelineColorBlendAttachmentState Targets[std::size(ColorFormats)] = {};
	for (VkPipelineColorBlendAttachmentState& Target : Targets) { Target.colorWriteMask = 0xf; }
	VkPipelineColorBlendStateCreateInfo Blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
	Blend.attachmentCount = static_cast<uint32_t>(std::size(Targets));
	Blend.pAttachments = Targets;
	VkPipelineRenderingCreateInfo Rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
	Rendering.colorAttachmentCount = static_cast<uint32_t>(std::size(ColorFormats));
	Rendering.pColorAttachmentFormats = ColorFormats;
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
	Info.pDynamicState = &DynamicInfo;
	Info.layout = Layout;
	const VkResult Result = vkCreateGraphicsPipelines(Device, VK_NULL_HANDLE, 1, &Info, nullptr, &Pipeline);
	for (const VkPipelineShaderStageCreateInfo& Stage : Stages) { vkDestroyShaderModule(Device, Stage.module, nullptr); }
	return Result == VK_SUCCESS ? FError() : "vkCreateGraphicsPipelines failed with " + std::to_string(Result);
}

void FForkRaster::Begin(VkCommandBuffer Commands, const VkRect2D& Area) const
{
	VkRenderingAttachmentInfo Colors[std::size(ColorFormats)] = {};
	const VkImageView ColorViews[] = {Normals.View, Motion.View, BaseColor.View, Material.View};
	for (size_t Index = 0; Index < std::size(Colors); ++Index)
	{
		Colors[Index].sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
		Colors[Index].imageView = ColorViews[Index];
		Colors[Index].imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
		Colors[Index].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
		Colors[Index].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
	}
	VkRenderingAttachmentInfo DepthTarget{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
	DepthTarget.imageView = Depth.View;
	DepthTarget.imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
	DepthTarget.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
	DepthTarget.clearValue.depthStencil = {1.0f, 0}; // the far plane
	DepthTarget.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
	VkRenderingInfo Info{VK_STRUCTURE_TYPE_RENDERING_INFO};
	Info.renderArea = Area;
	Info.layerCount = 1;
	Info.colorAttachmentCount = static_cast<uint32_t>(std::size(Colors));
	Info.pColorAttachments = Colors;
	Info.pDepthAttachment = &DepthTarget;
	vkCmdBeginRendering(Commands, &Info);
	const VkViewport Viewport{float(Area.offset.x), float(Area.offset.y), float(Area.extent.width), float(Area.extent.height), 0, 1};
	vkCmdSetViewport(Commands, 0, 1, &Viewport);
	vkCmdSetScissor(Commands, 0, 1, &Area);
}

void FForkRaster::Draw(VkCommandBuffer Commands, const FForkFrame& Frame, const FForkSkin& Skin) const
{
	const FViewData Data = MakeViewData(Frame.Scene.Cameras[Frame.View], Frame.Before.Cameras[Frame.View]);
	std::memcpy(Views[Frame.View].Mapped, &Data, sizeof(Data));
	constexpr VkImageAspectFlags Both = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
	Transition(Commands, Depth.Image, Both, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
	for (const FForkImage* Color : {&Normals, &Motion, &BaseColor, &Material})
	{
		Transition(Commands, Color->Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
	}
	Begin(Commands, {GetViewOffset(Frame.View), ViewSize});
	DrawBoxes(Commands, Frame);
	DrawReed(Commands, Frame, Skin);
	vkCmdEndRendering(Commands);

	Transition(Commands, Depth.Image, Both, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, DepthLayout);
	for (const FForkImage* Color : {&Normals, &Motion, &BaseColor, &Material})
	{
		Transition(Commands, Color->Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
		    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
	}
}

void FForkRaster::DrawBoxes(VkCommandBuffer Commands, const FForkFrame& Frame) const
{
	vkCmdBindPipeline(Commands, VK_PIPELINE_BIND_POINT_GRAPHICS, Pipeline);
	const VkDeviceSize Start = 0;
	vkCmdBindVertexBuffers(Commands, 0, 1, &Mesh.Buffer, &Start);
	vkCmdBindIndexBuffer(Commands, Mesh.Buffer, offsetof(FBoxMesh, Indices), VK_INDEX_TYPE_UINT32);
	FPush Push;
	Push.View = Views[Frame.View].GetAddress();
	const std::vector<FBox>& Boxes = Frame.Scene.Boxes;
	// In a frame in which boxes come or go, none of them has motion of its own.
	const std::vector<FBox>& Before = Frame.Before.Boxes.size() == Boxes.size() ? Frame.Before.Boxes : Boxes;
	for (size_t Index = 0; Index < Boxes.size(); ++Index)
	{
		Push.Offset = glm::vec3(Boxes[Index].Centre - Frame.Scene.Cameras[Frame.View].Position);
		Push.Scale = glm::vec3(Boxes[Index].HalfSize);
		Push.PreviousOffset = glm::vec3(Before[Index].Centre - Frame.Before.Cameras[Frame.View].Position);
		Push.PreviousScale = glm::vec3(Before[Index].HalfSize);
		Push.bCutOut = Boxes[Index].bCutOut ? 1 : 0;
		vkCmdPushConstants(Commands, Layout, PushStages, 0, sizeof(Push), &Push);
		vkCmdDrawIndexed(Commands, 36, 1, 0, 0, 0);
	}
}

void FForkRaster::DrawReed(VkCommandBuffer Commands, const FForkFrame& Frame, const FForkSkin& Skin) const
{
	const VkDeviceSize Start = 0;
	vkCmdBindVertexBuffers(Commands, 0, 1, &Skin.Vertices.Buffer, &Start);
	vkCmdBindIndexBuffer(Commands, Skin.Indices.Buffer, 0, VK_INDEX_TYPE_UINT32);
	FPush Push;
	Push.View = Views[Frame.View].GetAddress();
	Push.Offset = glm::vec3(Frame.Scene.Reed.Middle - Frame.Scene.Cameras[Frame.View].Position);
	Push.PreviousOffset = glm::vec3(Frame.Before.Reed.Middle - Frame.Before.Cameras[Frame.View].Position);
	vkCmdPushConstants(Commands, Layout, PushStages, 0, sizeof(Push), &Push);
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
