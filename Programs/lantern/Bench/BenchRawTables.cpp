// Descriptors of the raw dispatch, and the table of alpha-tested sections.
#include "Bench/BenchRawTables.h"

#include <algorithm>
#include <cstddef>
#include <map>

#include "Bench/BenchRawShadow.h"
#include "LanternScene/ShaderTable/SectionTable.h"

namespace Lantern
{

FRTStatus FRawTables::Create(VkImageView Output)
{
	bMasked = Desc.Scene->GetScene().GetFacts().bMasked;
	if (FRTStatus S = CreateTextures(); !S) { return S; }
	if (FRTStatus S = CreateSections(); !S) { return S; }
	if (FRTStatus S = CreateLayout(); !S) { return S; }
	WriteDescriptors(Output);
	return FRTStatus::Success();
}

FRawTables::~FRawTables()
{
	if (!Vulkan.Device) { return; }
	Vulkan.DestroyPipelineLayout(Vulkan.Device, Layout, nullptr);
	Vulkan.DestroyDescriptorPool(Vulkan.Device, DescriptorPool, nullptr);
	Vulkan.DestroyDescriptorSetLayout(Vulkan.Device, SetLayout, nullptr);
	for (const VkSampler Sampler : Samplers) { Vulkan.DestroySampler(Vulkan.Device, Sampler, nullptr); }
}

FRTStatus FRawTables::CreateSampler(const FHostTexture& Texture, VkSampler& Out)
{
	const auto Address = [](bool bRepeat, bool bMirror) {
		return bMirror   ? VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT
		       : bRepeat ? VK_SAMPLER_ADDRESS_MODE_REPEAT
		                 : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
	};
	VkSamplerCreateInfo Info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
	Info.magFilter = Info.minFilter = Texture.bNearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
	Info.addressModeU = Address(Texture.bRepeatU, Texture.bMirrorU);
	Info.addressModeV = Address(Texture.bRepeatV, Texture.bMirrorV);
	const VkResult Result = Vulkan.CreateSampler(Vulkan.Device, &Info, nullptr, &Out);
	if (Result == VK_SUCCESS) { Samplers.push_back(Out); }
	return CheckVulkan(Result, "vkCreateSampler");
}

/// One descriptor for each texture whose alpha some masked material tests.
FRTStatus FRawTables::CreateTextures()
{
	const FSceneDescription& Scene = Desc.Scene->GetDescription();
	std::map<int32_t, uint32_t> Known;
	std::vector<uint32_t> OfMaterial(Scene.Materials.size(), 0);
	for (size_t Material = 0; bMasked && Material < Scene.Materials.size(); ++Material)
	{
		const int32_t Texture = Scene.Materials[Material].Slots[TEXTURE_BASE_COLOR].Texture;
		if (Scene.Materials[Material].AlphaMode == EAlphaMode::Opaque || Texture < 0) { continue; }
		const auto [Entry, bNew] = Known.try_emplace(Texture, static_cast<uint32_t>(Textures.size()));
		OfMaterial[Material] = Entry->second;
		if (!bNew) { continue; }
		VkDescriptorImageInfo Image{};
		Image.imageView =
		    reinterpret_cast<VkImageView>(Desc.Scene->GetImage(Scene.Textures[Texture].Image)->GetNative(ERTNative::ImageView));
		Image.imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
		if (FRTStatus S = CreateSampler(Scene.Textures[Texture], Image.sampler); !S) { return S; }
		Textures.push_back(Image);
	}
	MaterialTextures = std::move(OfMaterial);
	return FRTStatus::Success();
}

FRTStatus FRawTables::CreateSections()
{
	FSectionTable& Source = Desc.Scene->GetScene().GetSections();
	const FSceneDescription& Scene = Desc.Scene->GetDescription();
	for (uint32_t Index = 0; Index < Source.GetCapacity(); ++Index)
	{
		const FSectionData& Data = Source.Get(Index);
		const FHostMaterial& Material = Scene.Materials[Data.Material];
		const FHostTextureSlot& Slot = Material.Slots[TEXTURE_BASE_COLOR];
		FRawSection Section{};
		Section.Indices = Data.Indices;
		Section.Coverage = Data.Attributes + (Slot.UVSet == 0 ? offsetof(FVertexAttributes, UV0) : offsetof(FVertexAttributes, UV1));
		Section.Texture = MaterialTextures[Data.Material];
		// The material's own opacity goes into the cutoff; without a texture any texel decides the same.
		const float Cutoff = Desc.Scene->GetScene().GetMaterials()[Data.Material].AlphaCutoff;
		Section.Cutoff = Slot.Texture >= 0 ? Cutoff / std::max(Material.BaseColor.a, 1e-6f) : Material.BaseColor.a < Cutoff ? 2.0f : -1.0f;
		Sections.push_back(Section);
		SectionMasked.push_back((Data.Flags & SECTION_MASKED) != 0);
	}
	FUploader Uploader(*Desc.Device);
	if (FRTStatus S = Uploader.CreateBuffer(
	        "RawSections", ERTBufferUsage::Storage, Sections.data(), Sections.size() * sizeof(FRawSection), SectionBuffer);
	    !S)
	{
		return S;
	}
	return Uploader.Flush();
}

FRTStatus FRawTables::CreateLayout()
{
	const VkShaderStageFlags Trace = Desc.bPipeline ? VK_SHADER_STAGE_RAYGEN_BIT_KHR : VK_SHADER_STAGE_COMPUTE_BIT;
	const VkShaderStageFlags Hit = Desc.bPipeline ? VK_SHADER_STAGE_ANY_HIT_BIT_KHR : VK_SHADER_STAGE_COMPUTE_BIT;
	std::vector<VkDescriptorSetLayoutBinding> Bindings = {{0, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, 1, Trace, nullptr},
	    {1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, Trace, nullptr}, {2, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, Trace, nullptr},
	    {3, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, Trace, nullptr}};
	if (!Textures.empty())
	{
		Bindings.push_back({4, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, static_cast<uint32_t>(Textures.size()), Hit, nullptr});
	}
	if (bMasked && !Desc.bPipeline) { Bindings.push_back({5, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, Hit, nullptr}); }
	VkDescriptorSetLayoutCreateInfo Info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
	Info.bindingCount = static_cast<uint32_t>(Bindings.size());
	Info.pBindings = Bindings.data();
	VkResult Result = Vulkan.CreateDescriptorSetLayout(Vulkan.Device, &Info, nullptr, &SetLayout);

	const VkPushConstantRange Push{Trace, 0, RawPushBytes};
	VkPipelineLayoutCreateInfo LayoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
	LayoutInfo.setLayoutCount = 1;
	LayoutInfo.pSetLayouts = &SetLayout;
	LayoutInfo.pushConstantRangeCount = 1;
	LayoutInfo.pPushConstantRanges = &Push;
	Result = Result ? Result : Vulkan.CreatePipelineLayout(Vulkan.Device, &LayoutInfo, nullptr, &Layout);

	std::vector<VkDescriptorPoolSize> Sizes;
	for (const VkDescriptorSetLayoutBinding& Binding : Bindings) { Sizes.push_back({Binding.descriptorType, Binding.descriptorCount}); }
	VkDescriptorPoolCreateInfo Pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
	Pool.maxSets = 1;
	Pool.poolSizeCount = static_cast<uint32_t>(Sizes.size());
	Pool.pPoolSizes = Sizes.data();
	Result = Result ? Result : Vulkan.CreateDescriptorPool(Vulkan.Device, &Pool, nullptr, &DescriptorPool);
	VkDescriptorSetAllocateInfo Allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
	Allocate.descriptorPool = DescriptorPool;
	Allocate.descriptorSetCount = 1;
	Allocate.pSetLayouts = &SetLayout;
	Result = Result ? Result : Vulkan.AllocateDescriptorSets(Vulkan.Device, &Allocate, &Set);
	return CheckVulkan(Result, "creating the descriptor set");
}

void FRawTables::WriteDescriptors(VkImageView Output) const
{
	const auto Tlas =
	    reinterpret_cast<VkAccelerationStructureKHR>(Desc.Scene->GetScene().GetStructure()->GetNative(ERTNative::AccelerationStructure));
	VkWriteDescriptorSetAccelerationStructureKHR Structure{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR};
	Structure.accelerationStructureCount = 1;
	Structure.pAccelerationStructures = &Tlas;
	const auto View = [](IRTTexture* Texture) { return reinterpret_cast<VkImageView>(Texture->GetNative(ERTNative::ImageView)); };
	const VkDescriptorImageInfo Depth{VK_NULL_HANDLE, View(Desc.Depth), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
	const VkDescriptorImageInfo Normals{VK_NULL_HANDLE, View(Desc.Normals), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
	const VkDescriptorImageInfo Target{VK_NULL_HANDLE, Output, VK_IMAGE_LAYOUT_GENERAL};
	const VkDescriptorBufferInfo Buffer{reinterpret_cast<VkBuffer>(SectionBuffer->GetNative(ERTNative::Buffer)), 0, VK_WHOLE_SIZE};
	std::vector<VkWriteDescriptorSet> Writes;
	const auto Add = [&](uint32_t Binding, VkDescriptorType Type, const VkDescriptorImageInfo* Images, uint32_t Count) {
		VkWriteDescriptorSet Write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
		Write.dstSet = Set;
		Write.dstBinding = Binding;
		Write.descriptorCount = Count;
		Write.descriptorType = Type;
		Write.pImageInfo = Images;
		Writes.push_back(Write);
	};
	Add(0, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, nullptr, 1);
	Writes.back().pNext = &Structure;
	Add(1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, &Depth, 1);
	Add(2, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, &Normals, 1);
	Add(3, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, &Target, 1);
	if (!Textures.empty()) { Add(4, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, Textures.data(), static_cast<uint32_t>(Textures.size())); }
	if (bMasked && !Desc.bPipeline)
	{
		Add(5, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, nullptr, 1);
		Writes.back().pBufferInfo = &Buffer;
	}
	Vulkan.UpdateDescriptorSets(Vulkan.Device, static_cast<uint32_t>(Writes.size()), Writes.data(), 0, nullptr);
}

} // namespace Lantern
