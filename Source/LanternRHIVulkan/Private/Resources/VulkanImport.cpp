// What can be known of an image that an engine created: whether its memory is that of the texture it is said to be.
#include "Resources/VulkanImport.h"

#include "Device/VulkanDeviceImpl.h"
#include "Device/VulkanTranslate.h"
#include "LanternRHI/RTText.h"

#include <algorithm>
#include <iterator>

namespace Lantern
{

namespace
{

/// Depth formats that engines mistake for each other.
struct FDepthFormat
{
	VkFormat Format;
	const char* Name;
};
constexpr FDepthFormat DepthFormats[] = {{VK_FORMAT_D16_UNORM, "D16_UNORM"}, {VK_FORMAT_D16_UNORM_S8_UINT, "D16_UNORM_S8_UINT"},
    {VK_FORMAT_X8_D24_UNORM_PACK32, "X8_D24_UNORM_PACK32"}, {VK_FORMAT_D24_UNORM_S8_UINT, "D24_UNORM_S8_UINT"},
    {VK_FORMAT_D32_SFLOAT, "D32_SFLOAT"}, {VK_FORMAT_D32_SFLOAT_S8_UINT, "D32_SFLOAT_S8_UINT"}};

/// Whether some image of this description needs Bytes of memory. Images that are created alike need memory alike (Vulkan 1.3,
/// "Resource Memory Association"), so an image with none of the usual usages' sizes has another format or extent.
bool CanNeed(FVulkanDevice& Device, const FRTTextureDesc& Desc, VkFormat Format, VkDeviceSize Bytes)
{
	VkImageFormatProperties Limits{};
	for (uint32_t Choice = 0; Choice < 16; ++Choice)
	{
		VkImageCreateInfo Info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
		Info.imageType = VK_IMAGE_TYPE_2D;
		Info.format = Format;
		Info.extent = {Desc.Width, Desc.Height, 1};
		Info.mipLevels = Desc.MipCount;
		Info.arrayLayers = Desc.ArraySize;
		Info.samples = VK_SAMPLE_COUNT_1_BIT;
		Info.tiling = VK_IMAGE_TILING_OPTIMAL;
		Info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
		             (Choice & 1 ? VkImageUsageFlags(VK_IMAGE_USAGE_TRANSFER_SRC_BIT) : 0u) |
		             (Choice & 2 ? VkImageUsageFlags(VK_IMAGE_USAGE_TRANSFER_DST_BIT) : 0u) |
		             (Choice & 4 ? VkImageUsageFlags(VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT) : 0u);
		Info.flags = Choice & 8 ? VkImageCreateFlags(VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT) : 0;
		if (Device.Instance->Api.GetPhysicalDeviceImageFormatProperties(
		        Device.Physical, Info.format, Info.imageType, Info.tiling, Info.usage, Info.flags, &Limits) != VK_SUCCESS)
		{
			continue;
		}
		VkDeviceImageMemoryRequirements Query{VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS};
		Query.pCreateInfo = &Info;
		VkMemoryRequirements2 Needs{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
		Device.Api.GetDeviceImageMemoryRequirements(Device.Handle, &Query, &Needs);
		if (Needs.memoryRequirements.size == Bytes) { return true; }
	}
	return false;
}

FRTStatus CheckDepth(FVulkanDevice& Device, const FRTTextureDesc& Desc, VkDeviceSize Bytes)
{
	const VkFormat Stated = GetVulkanFormat(Desc.Format);
	const auto Mine =
	    std::find_if(std::begin(DepthFormats), std::end(DepthFormats), [&](const FDepthFormat& Item) { return Item.Format == Stated; });
	if (Mine == std::end(DepthFormats) || CanNeed(Device, Desc, Stated, Bytes)) { return {}; }
	for (const FDepthFormat& Other : DepthFormats)
	{
		if (Other.Format == Stated || !CanNeed(Device, Desc, Other.Format, Bytes)) { continue; }
		return FRTStatus::Error(ERTResult::InvalidArgument,
		    "Texture '%s': FRTTextureDesc::Format is %s, but the image's memory is that of %s", FRTShown(Desc.Name).Text, Mine->Name,
		    Other.Name);
	}
	return {}; // created in a way that this list does not have
}

} // namespace

FRTStatus CheckImport(FVulkanDevice& Device, const FRTTextureDesc& Desc, VkImage Image)
{
	const FRTShown Name(Desc.Name ? Desc.Name : "");
	const auto Refuse = [&](const char* Argument) {
		return FRTStatus::Error(ERTResult::InvalidArgument, "Texture '%s': %s", Name.Text, Argument);
	};
	if (Image == VK_NULL_HANDLE) { return Refuse("NativeImage is null"); }
	if (GetVulkanFormat(Desc.Format) == VK_FORMAT_UNDEFINED) { return Refuse("FRTTextureDesc::Format is unknown"); }
	const uint32_t Limit = Device.GetCapabilities().MaxTextureDimension;
	if (Desc.Width == 0 || Desc.Width > Limit) { return Refuse("FRTTextureDesc::Width is 0 or above the device's limit"); }
	if (Desc.Height == 0 || Desc.Height > Limit) { return Refuse("FRTTextureDesc::Height is 0 or above the device's limit"); }
	uint32_t MostMips = 1;
	while (std::max(Desc.Width, Desc.Height) >> MostMips != 0) { ++MostMips; }
	if (Desc.MipCount == 0 || Desc.MipCount > MostMips) { return Refuse("FRTTextureDesc::MipCount is 0 or above the size's mips"); }
	// The least that Vulkan grants for layers is 256; none of ours are near it.
	constexpr uint32_t MostLayers = 2048;
	if (Desc.ArraySize == 0 || Desc.ArraySize > MostLayers) { return Refuse("FRTTextureDesc::ArraySize is 0 or above 2048"); }
	if (Desc.bCube && Desc.ArraySize != 6) { return Refuse("FRTTextureDesc::bCube needs an ArraySize of 6"); }
	if (Desc.bCube && Desc.Width != Desc.Height) { return Refuse("FRTTextureDesc::bCube needs equal Width and Height"); }
	VkMemoryRequirements Needs{};
	Device.Api.GetImageMemoryRequirements(Device.Handle, Image, &Needs);
	const VkDeviceSize Texels = VkDeviceSize(Desc.Width) * Desc.Height * Desc.ArraySize;
	const VkDeviceSize Least = IsCompressed(Desc.Format) ? Texels * BytesPerBlock(Desc.Format) / 16 : Texels * BytesPerTexel(Desc.Format);
	if (Needs.size < Least)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument,
		    "Texture '%s': FRTTextureDesc says %u x %u texels, which need %llu bytes; the image has %llu", Name.Text, Desc.Width,
		    Desc.Height, static_cast<unsigned long long>(Least), static_cast<unsigned long long>(Needs.size));
	}
	return CheckDepth(Device, Desc, Needs.size);
}

FRTStatus CheckImport(FVulkanDevice& Device, const FRTBufferDesc& Desc, const FRTNativeBuffer& Native)
{
	const FRTShown Name(Desc.Name ? Desc.Name : "");
	const auto Refuse = [&](const char* Argument) {
		return FRTStatus::Error(ERTResult::InvalidArgument, "Buffer '%s': %s", Name.Text, Argument);
	};
	if (Desc.Size == 0) { return Refuse("FRTBufferDesc::Size is 0"); }
	if (Native.Handle == 0 && Native.Address == 0) { return Refuse("FRTNativeBuffer::Handle and Address are 0"); }
	if (Native.Address % 16 != 0) { return Refuse("FRTNativeBuffer::Address is not a multiple of 16"); }
	if (Native.Handle == 0) { return {}; }
	VkMemoryRequirements Needs{};
	Device.Api.GetBufferMemoryRequirements(Device.Handle, (VkBuffer)Native.Handle, &Needs);
	if (Needs.size >= Desc.Size) { return {}; }
	return FRTStatus::Error(ERTResult::InvalidArgument, "Buffer '%s': FRTBufferDesc::Size is %llu bytes; the buffer has %llu", Name.Text,
	    static_cast<unsigned long long>(Desc.Size), static_cast<unsigned long long>(Needs.size));
}

} // namespace Lantern
