// Descriptors and pipeline of a pass over images.
#include "Example/ForkImagePass.h"

#include <array>

namespace Fork
{

namespace
{

constexpr uint32_t GroupSize = 8; // of the shaders

VkDescriptorType GetType(const FImagePassDesc& Desc, uint32_t Binding)
{
	return Binding < Desc.ReadCount ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
}

} // namespace

FError FForkImagePass::Create(const FForkDevice& Owner, const FImagePassDesc& InDesc)
{
	Device = Owner.Device;
	Desc = InDesc;
	if (FError Error = CreateSets(); !Error.empty()) { return Error; }
	const VkPushConstantRange Range{VK_SHADER_STAGE_COMPUTE_BIT, 0, Desc.PushBytes};
	VkPipelineLayoutCreateInfo LayoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
	LayoutInfo.setLayoutCount = 1;
	LayoutInfo.pSetLayouts = &SetLayout;
	LayoutInfo.pushConstantRangeCount = 1;
	LayoutInfo.pPushConstantRanges = &Range;
	vkCreatePipelineLayout(Device, &LayoutInfo, nullptr, &Layout);
	return CreateComputePipeline(Device, Desc.Shader, Layout, Pipeline);
}

FError FForkImagePass::CreateSets()
{
	std::vector<VkDescriptorSetLayoutBinding> Bindings;
	for (uint32_t Binding = 0; Binding < Desc.ReadCount + Desc.StorageCount; ++Binding)
	{
		Bindings.push_back({Binding, GetType(Desc, Binding), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
	}
	VkDescriptorSetLayoutCreateInfo LayoutInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
	LayoutInfo.bindingCount = static_cast<uint32_t>(Bindings.size());
	LayoutInfo.pBindings = Bindings.data();
	vkCreateDescriptorSetLayout(Device, &LayoutInfo, nullptr, &SetLayout);
	const VkDescriptorPoolSize Sizes[] = {
	    {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, Desc.ReadCount * ViewCount}, {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, Desc.StorageCount * ViewCount}};
	VkDescriptorPoolCreateInfo PoolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
	PoolInfo.maxSets = ViewCount;
	PoolInfo.poolSizeCount = 2;
	PoolInfo.pPoolSizes = Sizes;
	vkCreateDescriptorPool(Device, &PoolInfo, nullptr, &Pool);
	std::array<VkDescriptorSetLayout, ViewCount> Layouts;
	Layouts.fill(SetLayout);
	VkDescriptorSetAllocateInfo Info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
	Info.descriptorPool = Pool;
	Info.descriptorSetCount = ViewCount;
	Info.pSetLayouts = Layouts.data();
	const VkResult Result = vkAllocateDescriptorSets(Device, &Info, Sets);
	return Result == VK_SUCCESS ? FError() : "vkAllocateDescriptorSets failed with " + std::to_string(Result);
}

void FForkImagePass::Run(VkCommandBuffer Commands, uint32_t View, const std::vector<FBoundImage>& Images, const void* Push) const
{
	std::vector<VkDescriptorImageInfo> Infos;
	for (const FBoundImage& Image : Images) { Infos.push_back({VK_NULL_HANDLE, Image.View, Image.Layout}); }
	std::vector<VkWriteDescriptorSet> Writes;
	for (uint32_t Binding = 0; Binding < Images.size(); ++Binding)
	{
		Writes.push_back({VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, nullptr, Sets[View], Binding, 0, 1, GetType(Desc, Binding),
		    &Infos[Binding], nullptr, nullptr});
	}
	vkUpdateDescriptorSets(Device, static_cast<uint32_t>(Writes.size()), Writes.data(), 0, nullptr);
	// The plugin has bound pipelines, sets and push constants of its own: see IRTModuleRenderer::RenderFrame.
	vkCmdBindPipeline(Commands, VK_PIPELINE_BIND_POINT_COMPUTE, Pipeline);
	vkCmdBindDescriptorSets(Commands, VK_PIPELINE_BIND_POINT_COMPUTE, Layout, 0, 1, &Sets[View], 0, nullptr);
	vkCmdPushConstants(Commands, Layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, Desc.PushBytes, Push);
	vkCmdDispatch(Commands, (ViewSize.width + GroupSize - 1) / GroupSize, (ViewSize.height + GroupSize - 1) / GroupSize, 1);
}

FForkImagePass::~FForkImagePass()
{
	if (Device != VK_NULL_HANDLE)
	{
		vkDestroyPipeline(Device, Pipeline, nullptr);
		vkDestroyPipelineLayout(Device, Layout, nullptr);
		vkDestroyDescriptorPool(Device, Pool, nullptr);
		vkDestroyDescriptorSetLayout(Device, SetLayout, nullptr);
	}
}

} // namespace Fork
