// Textures, our own or the engine's, and samplers.
#pragma once

#include "Device/VulkanDeviceImpl.h"

#include <string>

namespace Lantern
{

class FVulkanTexture final : public TVulkanObject<IRTTexture>
{
public:
	using TVulkanObject::TVulkanObject;
	/// Imported: an image that stays the engine's, or null to create one.
	FRTStatus Initialise(const FRTTextureDesc& InDesc, VkImage Imported);

	const FRTTextureDesc& GetDesc() const override { return Desc; }
	uint32_t GetSampledIndex() const override { return SampledIndex; }
	uint32_t GetStorageIndex() const override { return StorageIndex; }
	uint64_t GetNative(ERTNative Kind) const override;
	FRTStatus SetExternalState(const FRTExternalState& From, const FRTExternalState& To) override;

	/// ERTAccess::External as Vulkan has it.
	struct FExternal
	{
		VkImageLayout Layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
		VkPipelineStageFlags2 Stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
		VkAccessFlags2 Accesses = VK_ACCESS_2_MEMORY_WRITE_BIT | VK_ACCESS_2_MEMORY_READ_BIT;
		void ApplyTo(VkPipelineStageFlags2& OutStages, VkAccessFlags2& OutAccesses, VkImageLayout& OutLayout) const
		{
			OutStages = Stages;
			OutAccesses = Accesses;
			OutLayout = Layout;
		}
	};
	/// Side: 0 before Lantern's barriers, 1 after them.
	const FExternal& GetExternalState(int Side) const { return External[Side]; }
	VkImage GetImage() const { return Image; }
	VkImageView GetAttachmentView() const { return AttachmentView; }

private:
	~FVulkanTexture() override;
	FRTStatus CreateImage();
	FRTStatus CreateViews();
	FRTStatus CreateView(uint32_t MipCount, uint32_t LayerCount, VkImageUsageFlags Usage, VkImageView* Out);

	FRTTextureDesc Desc;
	std::string Name;
	bool bOwned = false;
	FExternal External[2];
	VkImage Image = VK_NULL_HANDLE;
	FVulkanAllocation Allocation;
	VkImageView SampledView = VK_NULL_HANDLE;
	VkImageView StorageView = VK_NULL_HANDLE;
	VkImageView AttachmentView = VK_NULL_HANDLE;
	uint32_t SampledIndex = NoBindlessIndex;
	uint32_t StorageIndex = NoBindlessIndex;
};

class FVulkanSampler final : public TVulkanObject<IRTSampler>
{
public:
	using TVulkanObject::TVulkanObject;
	FRTStatus Initialise(const FRTSamplerDesc& Desc);
	uint32_t GetIndex() const override { return Index; }

private:
	~FVulkanSampler() override;
	FRTStatus AddToHeap(const char* Name);
	bool bOwned = false;
	VkSampler Handle = VK_NULL_HANDLE;
	uint32_t Index = NoBindlessIndex;
};

} // namespace Lantern
