// FVulkanBindless: the one descriptor set and its indices.
#include "Resources/VulkanBindless.h"

namespace Lantern
{

namespace
{

constexpr VkDescriptorType Types[FVulkanBindless::BindingCount] = {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
    VK_DESCRIPTOR_TYPE_SAMPLER, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR};

} // namespace

VkResult FVulkanBindless::Create(
    VkDevice InDevice, const FVulkanDeviceApi& InApi, const uint32_t (&Capacities)[BindingCount], const FVulkanCapabilityBits& Bits)
{
	Device = InDevice;
	Api = &InApi;
	VkDescriptorSetLayoutBinding Bindings[BindingCount] = {};
	VkDescriptorBindingFlags Flags[BindingCount] = {};
	VkDescriptorPoolSize Sizes[BindingCount] = {};
	uint32_t Count = 0;
	for (uint32_t Binding = 0; Binding < BindingCount; ++Binding)
	{
		Indices[Binding].SetCapacity(Capacities[Binding]);
		if (Capacities[Binding] == 0) { continue; }
		Bindings[Count] = {Binding, Types[Binding], Capacities[Binding], AllStages(Bits), nullptr};
		Flags[Count] = VK_DESCRIPTOR_BINDING_UPDATE_AFTER_BIND_BIT | VK_DESCRIPTOR_BINDING_PARTIALLY_BOUND_BIT |
		               VK_DESCRIPTOR_BINDING_UPDATE_UNUSED_WHILE_PENDING_BIT;
		Sizes[Count] = {Types[Binding], Capacities[Binding]};
		++Count;
	}
	VkDescriptorSetLayoutBindingFlagsCreateInfo FlagInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_BINDING_FLAGS_CREATE_INFO};
	FlagInfo.bindingCount = Count;
	FlagInfo.pBindingFlags = Flags;
	VkDescriptorSetLayoutCreateInfo LayoutInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, &FlagInfo};
	LayoutInfo.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_UPDATE_AFTER_BIND_POOL_BIT;
	LayoutInfo.bindingCount = Count;
	LayoutInfo.pBindings = Bindings;
	VkResult Result = Api->CreateDescriptorSetLayout(Device, &LayoutInfo, nullptr, &SetLayout);

	VkDescriptorPoolCreateInfo PoolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
	PoolInfo.flags = VK_DESCRIPTOR_POOL_CREATE_UPDATE_AFTER_BIND_BIT;
	PoolInfo.maxSets = 1;
	PoolInfo.poolSizeCount = Count;
	PoolInfo.pPoolSizes = Sizes;
	Result = Result ? Result : Api->CreateDescriptorPool(Device, &PoolInfo, nullptr, &Pool);

	VkDescriptorSetAllocateInfo SetInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
	SetInfo.descriptorPool = Pool;
	SetInfo.descriptorSetCount = 1;
	SetInfo.pSetLayouts = &SetLayout;
	Result = Result ? Result : Api->AllocateDescriptorSets(Device, &SetInfo, &Set);

	const VkPushConstantRange Push = {AllStages(Bits), 0, FRTCapabilities().MaxPushConstantBytes};
	VkPipelineLayoutCreateInfo PipelineInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
	PipelineInfo.setLayoutCount = 1;
	PipelineInfo.pSetLayouts = &SetLayout;
	PipelineInfo.pushConstantRangeCount = 1;
	PipelineInfo.pPushConstantRanges = &Push;
	return Result ? Result : Api->CreatePipelineLayout(Device, &PipelineInfo, nullptr, &PipelineLayout);
}

void FVulkanBindless::Destroy()
{
	if (!Api) { return; }
	Api->DestroyPipelineLayout(Device, PipelineLayout, nullptr);
	Api->DestroyDescriptorPool(Device, Pool, nullptr);
	Api->DestroyDescriptorSetLayout(Device, SetLayout, nullptr);
	Api = nullptr;
}

uint32_t FVulkanBindless::Add(EBinding Binding, VkWriteDescriptorSet& Info)
{
	std::scoped_lock Lock(Mutex);
	const uint32_t Index = Indices[Binding].Allocate();
	if (Index == NoBindlessIndex) { return Index; }
	Info.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
	Info.dstSet = Set;
	Info.dstBinding = Binding;
	Info.dstArrayElement = Index;
	Info.descriptorCount = 1;
	Info.descriptorType = Types[Binding];
	Api->UpdateDescriptorSets(Device, 1, &Info, 0, nullptr);
	return Index;
}

uint32_t FVulkanBindless::AddImage(EBinding Binding, VkImageView View)
{
	const VkImageLayout Layout = Binding == Storage ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
	const VkDescriptorImageInfo Image = {VK_NULL_HANDLE, View, Layout};
	VkWriteDescriptorSet Info{};
	Info.pImageInfo = &Image;
	return Add(Binding, Info);
}

uint32_t FVulkanBindless::AddSampler(VkSampler InSampler)
{
	const VkDescriptorImageInfo Image = {InSampler, VK_NULL_HANDLE, VK_IMAGE_LAYOUT_UNDEFINED};
	VkWriteDescriptorSet Info{};
	Info.pImageInfo = &Image;
	return Add(Sampler, Info);
}

uint32_t FVulkanBindless::AddScene(VkAccelerationStructureKHR InScene)
{
	VkWriteDescriptorSetAccelerationStructureKHR Structures{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR};
	Structures.accelerationStructureCount = 1;
	Structures.pAccelerationStructures = &InScene;
	VkWriteDescriptorSet Info{};
	Info.pNext = &Structures;
	return Add(Scene, Info);
}

void FVulkanBindless::Remove(EBinding Binding, uint32_t Index)
{
	if (Index == NoBindlessIndex) { return; }
	std::scoped_lock Lock(Mutex);
	Indices[Binding].Free(Index);
}

} // namespace Lantern
