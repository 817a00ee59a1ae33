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
	VkSampler Handle = VK_NULL_HANDLE;
	uint32_t Index = NoBindlessIndex;
};

} // namespace Lantern
