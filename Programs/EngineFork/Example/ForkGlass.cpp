// The compute pass that composites the plugin's glass.
#include "Example/ForkGlass.h"

#include <array>

#include "Example/ForkLight.h"
#include "ForkGlassShader.h"

namespace Fork
{

using namespace Lantern;

namespace
{

constexpr uint32_t GroupSize = 8; // ForkGlass.comp
constexpr uint32_t ReadCount = 3, BindingCount = ReadCount + 2;

struct FPush
{
	VkOffset2D Offset{};
	VkExtent2D Size{};
	uint32_t bGiven = 0;
};

} // namespace

FError FForkGlass::Create(const FForkDevice& Owner)
{
	Device = Owner.Device;
	constexpr VkImageUsageFlags Usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
	FError Error = Shown.Create(Owner, TextureSize, FForkLight::Format, Usage, VK_IMAGE_ASPECT_COLOR_BIT);
	const auto CreateNull = [&](FForkImage& Image, VkFormat Format) {
		if (Error.empty()) { Error = Image.Create(Owner, {1, 1}, Format, VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_COLOR_BIT); }
	};
	CreateNull(NoGlass, FForkLight::Format);
	CreateNull(NoLooks, VK_FORMAT_R32G32B32A32_UINT);
	if (Error.empty()) { Error = CreateSets(); }
	return Error.empty() ? CreatePipeline() : Error;
}

FError FForkGlass::CreateSets()
{
	std::array<VkDescriptorSetLayoutBinding, BindingCount> Bindings{};
	for (uint32_t Index = 0; Index < BindingCount; ++Index)
	{
		const VkDescriptorType Type = Index < ReadCount ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
		Bindings[Index] = {Index, Type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
	}
	VkDescriptorSetLayoutCreateInfo LayoutInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
	LayoutInfo.bindingCount = BindingCount;
	LayoutInfo.pBindings = Bindings.data();
	vkCreateDescriptorSetLayout(Device, &LayoutInfo, nullptr, &SetLayout);
	const VkDescriptorPoolSize Sizes[] = {{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, ReadCount * ViewCount},
	    {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, (BindingCount - ReadCount) * ViewCount}};
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

FError FForkGlass::CreatePipeline()
{
	const VkPushConstantRange Range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(FPush)};
	VkPipelineLayoutCreateInfo LayoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
	LayoutInfo.setLayoutCount = 1;
	LayoutInfo.pSetLayouts = &SetLayout;
	LayoutInfo.pushConstantRangeCount = 1;
	LayoutInfo.pPushConstantRanges = &Range;
	vkCreatePipelineLayout(Device, &LayoutInfo, nullptr, &Layout);
	return CreateComputePipeline(Device, {ForkGlassShader, sizeof(ForkGlassShader)}, Layout, Pipeline);
}

void FForkGlass::WriteSet(VkDescriptorSet Set, const VkImageView* Views)
{
	std::array<VkDescriptorImageInfo, BindingCount> Infos{};
	std::array<VkWriteDescriptorSet, BindingCount> Writes{};
	for (uint32_t Index = 0; Index < BindingCount; ++Index)
	{
		const bool bRead = Index < ReadCount;
		Infos[Index] = {VK_NULL_HANDLE, Views[Index], bRead ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_GENERAL};
		Writes[Index] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, nullptr, Set, Index, 0, 1,
		    bRead ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, &Infos[Index], nullptr, nullptr};
	}
	vkUpdateDescriptorSets(Device, BindingCount, Writes.data(), 0, nullptr);
}

void FForkGlass::Run(VkCommandBuffer Commands, uint32_t View, const FForkImage& Lit, const FRTModuleTransmission& Glass)
{
	const auto GetView = [](IRTTexture& Texture) { return reinterpret_cast<VkImageView>(Texture.GetNative(ERTNative::ImageView)); };
	const bool bGiven = Glass.Light != nullptr;
	const FPush Push{GetViewOffset(View), ViewSize, bGiven ? 1u : 0u};
	if (!bGiven)
	{
		for (const FForkImage* Image : {&NoGlass, &NoLooks})
		{
			Transition(
			    Commands, Image->Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
		}
	}
	const VkImageView Views[BindingCount] = {bGiven ? GetView(*Glass.Light) : NoGlass.View,
	    bGiven ? GetView(*Glass.Transmittance) : NoGlass.View, bGiven ? GetView(*Glass.Looks) : NoLooks.View, Lit.View, Shown.View};
	WriteSet(Sets[View], Views);
	Transition(Commands, Lit.Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_GENERAL); // it is written
	Transition(Commands, Shown.Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
	vkCmdBindPipeline(Commands, VK_PIPELINE_BIND_POINT_COMPUTE, Pipeline);
	vkCmdBindDescriptorSets(Commands, VK_PIPELINE_BIND_POINT_COMPUTE, Layout, 0, 1, &Sets[View], 0, nullptr);
	vkCmdPushConstants(Commands, Layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(Push), &Push);
	vkCmdDispatch(Commands, (ViewSize.width + GroupSize - 1) / GroupSize, (ViewSize.height + GroupSize - 1) / GroupSize, 1);
}

FForkGlass::~FForkGlass()
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
