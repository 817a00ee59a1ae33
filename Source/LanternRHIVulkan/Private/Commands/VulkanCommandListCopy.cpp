// FVulkanCommandList: copies, fills, clears and mips.
#include "Commands/VulkanCommandList.h"

#include <algorithm>
#include <cassert>

namespace Lantern
{

namespace
{

VkBuffer NativeOf(IRTBuffer* Buffer) { return static_cast<FVulkanBuffer*>(Buffer)->Block.Handle; }

/// One mip of one layer, rows tightly packed.
VkBufferImageCopy RegionOf(const FRTTextureDesc& Desc, uint32_t Mip, uint32_t Layer, uint64_t Offset)
{
	assert(Mip < Desc.MipCount && Layer < Desc.ArraySize);
	VkBufferImageCopy Region{};
	Region.bufferOffset = Offset;
	Region.imageSubresource = {AspectOf(Desc.Format), Mip, Layer, 1};
	Region.imageExtent = {std::max(Desc.Width >> Mip, 1u), std::max(Desc.Height >> Mip, 1u), 1};
	return Region;
}

} // namespace

void FVulkanCommandList::CopyBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTBuffer* Source, uint64_t SourceOffset, uint64_t Size)
{
	const FRTBufferRegion Region{DestOffset, SourceOffset, Size};
	CopyBufferRegions(Dest, Source, &Region, 1);
}

void FVulkanCommandList::CopyBufferRegions(IRTBuffer* Dest, IRTBuffer* Source, const FRTBufferRegion* Regions, uint32_t Count)
{
	Keep(Dest);
	Keep(Source);
	std::vector<VkBufferCopy> Copies;
	Copies.reserve(Count);
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		const FRTBufferRegion& Region = Regions[Index];
		if (Region.Size > 0) { Copies.push_back({Region.SourceOffset, Region.DestOffset, Region.Size}); }
	}
	if (!Copies.empty())
	{
		Device.Api.CmdCopyBuffer(Handle, NativeOf(Source), NativeOf(Dest), static_cast<uint32_t>(Copies.size()), Copies.data());
	}
}

void FVulkanCommandList::CopyBufferToTexture(IRTTexture* Dest, uint32_t Mip, uint32_t Layer, IRTBuffer* Source, uint64_t SourceOffset)
{
	Keep(Dest);
	Keep(Source);
	const VkBufferImageCopy Region = RegionOf(Dest->GetDesc(), Mip, Layer, SourceOffset);
	Device.Api.CmdCopyBufferToImage(
	    Handle, NativeOf(Source), static_cast<FVulkanTexture*>(Dest)->GetImage(), GetVulkanLayout(ERTAccess::CopyWrite), 1, &Region);
}

void FVulkanCommandList::CopyTextureToBuffer(IRTBuffer* Dest, uint64_t DestOffset, IRTTexture* Source, uint32_t Mip, uint32_t Layer)
{
	Keep(Dest);
	Keep(Source);
	const VkBufferImageCopy Region = RegionOf(Source->GetDesc(), Mip, Layer, DestOffset);
	Device.Api.CmdCopyImageToBuffer(
	    Handle, static_cast<FVulkanTexture*>(Source)->GetImage(), GetVulkanLayout(ERTAccess::CopyRead), NativeOf(Dest), 1, &Region);
}

void FVulkanCommandList::FillBuffer(IRTBuffer* Dest, uint64_t Offset, uint64_t Size, uint32_t Value)
{
	assert(Offset % 4 == 0 && Size % 4 == 0);
	Keep(Dest);
	if (Size > 0) { Device.Api.CmdFillBuffer(Handle, NativeOf(Dest), Offset, Size, Value); }
}

void FVulkanCommandList::ClearTexture(IRTTexture* Dest, const float Value[4])
{
	Keep(Dest);
	const FRTTextureDesc& Desc = Dest->GetDesc();
	assert(AspectOf(Desc.Format) == VK_IMAGE_ASPECT_COLOR_BIT);
	VkClearColorValue Color{};
	for (uint32_t Channel = 0; Channel < 4; ++Channel)
	{
		if (IsIntegerFormat(Desc.Format)) { Color.uint32[Channel] = static_cast<uint32_t>(Value[Channel]); }
		else { Color.float32[Channel] = Value[Channel]; }
	}
	const VkImageSubresourceRange Range = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
	Device.Api.CmdClearColorImage(
	    Handle, static_cast<FVulkanTexture*>(Dest)->GetImage(), GetVulkanLayout(ERTAccess::CopyWrite), &Color, 1, &Range);
}

void FVulkanCommandList::MipBarrier(
    const FVulkanTexture& Texture, uint32_t First, uint32_t Count, VkImageLayout Before, VkImageLayout After)
{
	const bool bFinal = After == VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
	const FVulkanAccess Next = AccessOf(bFinal ? ERTAccess::ShaderRead : ERTAccess::CopyRead, Device.Bits);
	VkImageMemoryBarrier2 Image{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
	Image.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
	Image.srcAccessMask = Before == VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL ? VK_ACCESS_2_TRANSFER_WRITE_BIT : 0;
	Image.dstStageMask = Next.Stages;
	Image.dstAccessMask = Next.Access;
	Image.oldLayout = Before;
	Image.newLayout = After;
	Image.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
	Image.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
	Image.image = Texture.GetImage();
	Image.subresourceRange = {AspectOf(Texture.GetDesc().Format), First, Count, 0, VK_REMAINING_ARRAY_LAYERS};
	VkDependencyInfo Info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
	Info.imageMemoryBarrierCount = 1;
	Info.pImageMemoryBarriers = &Image;
	Device.Api.CmdPipelineBarrier2(Handle, &Info);
}

void FVulkanCommandList::GenerateMips(IRTTexture* Texture)
{
	Keep(Texture);
	const FVulkanTexture& Image = *static_cast<FVulkanTexture*>(Texture);
	const FRTTextureDesc& Desc = Image.GetDesc();
	VkFormatProperties Properties{};
	Device.Instance->Api.GetPhysicalDeviceFormatProperties(Device.Physical, GetVulkanFormat(Desc.Format), &Properties);
	const bool bLinear = Properties.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
	const auto Extent = [&](uint32_t Mip) {
		return VkOffset3D{static_cast<int32_t>(std::max(Desc.Width >> Mip, 1u)), static_cast<int32_t>(std::max(Desc.Height >> Mip, 1u)), 1};
	};
	for (uint32_t Mip = 1; Mip < Desc.MipCount; ++Mip)
	{
		MipBarrier(Image, Mip - 1, 1, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
		VkImageBlit Region{};
		Region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, Mip - 1, 0, Desc.ArraySize};
		Region.srcOffsets[1] = Extent(Mip - 1);
		Region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, Mip, 0, Desc.ArraySize};
		Region.dstOffsets[1] = Extent(Mip);
		Device.Api.CmdBlitImage(Handle, Image.GetImage(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, Image.GetImage(),
		    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &Region, bLinear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST);
	}
	const uint32_t Last = Desc.MipCount - 1;
	if (Last > 0) { MipBarrier(Image, 0, Last, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL); }
	MipBarrier(Image, Last, 1, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

} // namespace Lantern
