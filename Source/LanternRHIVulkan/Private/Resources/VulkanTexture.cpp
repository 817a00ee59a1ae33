// FVulkanTexture and FVulkanSampler: images, views and their bindless indices.
#include "Resources/VulkanTexture.h"

#include <algorithm>
#include <cassert>

#include "LanternRHI/RTText.h"

namespace Lantern
{

FRTStatus FVulkanTexture::Initialise(const FRTTextureDesc& InDesc, VkImage Imported)
{
	Desc = InDesc;
	Name = InDesc.Name ? InDesc.Name : "";
	Desc.Name = Name.c_str();
	assert(Imported || Desc.NativeView == 0);
	assert(Desc.Width > 0 && Desc.Height > 0 && Desc.MipCount > 0 && Desc.ArraySize > 0);
	Image = Imported;
	if (!Imported)
	{
		FRTStatus Status = CreateImage();
		if (!Status) { return Status; }
	}
	return CreateViews();
}

FVulkanTexture::~FVulkanTexture()
{
	Device.Bindless.Remove(FVulkanBindless::Sampled, SampledIndex);
	Device.Bindless.Remove(FVulkanBindless::Storage, StorageIndex);
	for (VkImageView View : {StorageView, AttachmentView}) { Device.Api.DestroyImageView(Device.Handle, View, nullptr); }
	if (Desc.NativeView == 0) { Device.Api.DestroyImageView(Device.Handle, SampledView, nullptr); }
	if (bOwned)
	{
		Device.Memory.DestroyImage(Image, Allocation);
		Device.Account(EVulkanMemoryKind::Texture, -static_cast<int64_t>(Allocation.Bytes));
	}
}

FRTStatus FVulkanTexture::CreateImage()
{
	VkImageCreateInfo Info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
	Info.flags = Desc.bCube ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0;
	Info.imageType = VK_IMAGE_TYPE_2D;
	Info.format = GetVulkanFormat(Desc.Format);
	Info.extent = {Desc.Width, Desc.Height, 1};
	Info.mipLevels = Desc.MipCount;
	Info.arrayLayers = Desc.ArraySize;
	Info.samples = VK_SAMPLE_COUNT_1_BIT;
	Info.tiling = VK_IMAGE_TILING_OPTIMAL;
	Info.usage = ImageUsageOf(Desc);
	Info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
	if (Device.TextureFamilies.size() > 1)
	{
		Info.sharingMode = VK_SHARING_MODE_CONCURRENT;
		Info.queueFamilyIndexCount = static_cast<uint32_t>(Device.TextureFamilies.size());
		Info.pQueueFamilyIndices = Device.TextureFamilies.data();
	}
	Info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
	VkImageFormatProperties Limits{};
	VkResult Result = Device.Instance->Api.GetPhysicalDeviceImageFormatProperties(
	    Device.Physical, Info.format, Info.imageType, Info.tiling, Info.usage, Info.flags, &Limits);
	if (Result != VK_SUCCESS)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "Texture '%s': the device has no format %d with the usages %#x asked for (%s)",
		    FRTShown(Desc.Name).Text, static_cast<int>(Info.format), static_cast<unsigned>(Info.usage), ToString(Result));
	}
	if (Desc.Width > Limits.maxExtent.width || Desc.Height > Limits.maxExtent.height || Desc.MipCount > Limits.maxMipLevels ||
	    Desc.ArraySize > Limits.maxArrayLayers)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "Texture '%s': %ux%u, %u mips, %u layers; the device's limit is %ux%u, %u, %u",
		    FRTShown(Desc.Name).Text, Desc.Width, Desc.Height, Desc.MipCount, Desc.ArraySize, Limits.maxExtent.width,
		    Limits.maxExtent.height, Limits.maxMipLevels, Limits.maxArrayLayers);
	}
	Result = Device.Memory.CreateImage(Info, &Image, &Allocation);
	if (Result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
	{
		Device.CollectGarbage(); // what was released may already be free
		Result = Device.Memory.CreateImage(Info, &Image, &Allocation);
	}
	if (Device.Check(Result) != VK_SUCCESS)
	{
		Image = VK_NULL_HANDLE;
		return MakeStatus(Result, "Creating texture", Desc.Name);
	}
	bOwned = true;
	Device.Account(EVulkanMemoryKind::Texture, static_cast<int64_t>(Allocation.Bytes));
	Device.SetName(VK_OBJECT_TYPE_IMAGE, ToNative(Image), Desc.Name);
	return {};
}

FRTStatus FVulkanTexture::CreateView(uint32_t MipCount, uint32_t LayerCount, VkImageUsageFlags Usage, VkImageView* Out)
{
	// Without this, the view would claim all usages of the image, which an sRGB view, for example, cannot have.
	VkImageViewUsageCreateInfo UsageInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO};
	UsageInfo.usage = Usage;
	VkImageViewCreateInfo Info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, &UsageInfo};
	Info.image = Image;
	Info.viewType = LayerCount > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
	if (Desc.bCube && Usage == VK_IMAGE_USAGE_SAMPLED_BIT) { Info.viewType = VK_IMAGE_VIEW_TYPE_CUBE; }
	Info.format = GetVulkanFormat(Desc.Format);
	const bool bAttachment = (Usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0;
	Info.subresourceRange = {bAttachment ? AllAspectsOf(Desc.Format) : AspectOf(Desc.Format), 0, MipCount, 0, LayerCount};
	const VkResult Result = Device.Check(Device.Api.CreateImageView(Device.Handle, &Info, nullptr, Out));
	if (Result == VK_SUCCESS) { Device.SetName(VK_OBJECT_TYPE_IMAGE_VIEW, ToNative(*Out), Desc.Name); }
	return MakeStatus(Result, "Creating a view of texture", Desc.Name);
}

FRTStatus FVulkanTexture::CreateViews()
{
	FRTStatus Status;
	const auto NoIndex = [&](const char* Binding) {
		return FRTStatus::Error(ERTResult::OutOfDescriptors, "Texture '%s': all %u %s indices are in use", FRTShown(Desc.Name).Text,
		    Device.GetCapabilities().MaxBindlessTextures, Binding);
	};
	if (HasAny(Desc.Usage, ERTTextureUsage::Sampled))
	{
		if (Desc.NativeView != 0) { SampledView = (VkImageView)Desc.NativeView; }
		else { Status = CreateView(Desc.MipCount, Desc.ArraySize, VK_IMAGE_USAGE_SAMPLED_BIT, &SampledView); }
		if (!Status) { return Status; }
		SampledIndex = Device.Bindless.AddImage(FVulkanBindless::Sampled, SampledView);
		if (SampledIndex == NoBindlessIndex) { return NoIndex("sampled"); }
	}
	if (HasAny(Desc.Usage, ERTTextureUsage::Storage))
	{
		Status = CreateView(1, Desc.ArraySize, VK_IMAGE_USAGE_STORAGE_BIT, &StorageView);
		if (!Status) { return Status; }
		StorageIndex = Device.Bindless.AddImage(FVulkanBindless::Storage, StorageView);
		if (StorageIndex == NoBindlessIndex) { return NoIndex("storage"); }
	}
	if (HasAny(Desc.Usage, ERTTextureUsage::RenderTarget | ERTTextureUsage::Depth))
	{
		const VkImageUsageFlags Usage =
		    HasAny(Desc.Usage, ERTTextureUsage::Depth) ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
		Status = CreateView(1, 1, Usage, &AttachmentView);
	}
	return Status;
}

uint64_t FVulkanTexture::GetNative(ERTNative Kind) const
{
	switch (Kind)
	{
	case ERTNative::Device: return ToNative(Device.Handle);
	case ERTNative::Image: return ToNative(Image);
	case ERTNative::ImageView: return ToNative(SampledView ? SampledView : AttachmentView);
	default: return 0;
	}
}

FRTStatus FVulkanTexture::SetExternalState(const FRTExternalState& From, const FRTExternalState& To)
{
	const auto Refuse = [&](const char* Why) {
		return FRTStatus::Error(ERTResult::InvalidArgument, "SetExternalState: texture '%s': %s", FRTShown(Desc.Name).Text, Why);
	};
	if (bOwned) { return Refuse("it was not imported"); }
	if (From.Layout == VK_IMAGE_LAYOUT_UNDEFINED || From.Layout == VK_IMAGE_LAYOUT_PREINITIALIZED)
	{
		return Refuse("From.Layout is one without content");
	}
	if (To.Layout == VK_IMAGE_LAYOUT_UNDEFINED || To.Layout == VK_IMAGE_LAYOUT_PREINITIALIZED)
	{
		return Refuse("To.Layout is one that no barrier can leave an image in");
	}
	if (From.Stages == 0 || To.Stages == 0) { return Refuse("Stages is 0"); }
	External[0] = {static_cast<VkImageLayout>(From.Layout), From.Stages, From.Accesses};
	External[1] = {static_cast<VkImageLayout>(To.Layout), To.Stages, To.Accesses};
	return {};
}

// ------------------------------------------------------------------------------------------------ sampler

namespace
{

VkSamplerAddressMode AddressOf(ERTAddress Address)
{
	switch (Address)
	{
	case ERTAddress::Repeat: return VK_SAMPLER_ADDRESS_MODE_REPEAT;
	case ERTAddress::Clamp: return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
	case ERTAddress::Mirror: return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
	}
	return VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

} // namespace

FRTStatus FVulkanSampler::Initialise(const FRTSamplerDesc& Desc)
{
	const char* Name = Desc.Name ? Desc.Name : "";
	bOwned = Desc.NativeSampler == 0;
	if (!bOwned)
	{
		Handle = (VkSampler)Desc.NativeSampler;
		return AddToHeap(Name);
	}
	VkSamplerCreateInfo Info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
	Info.minFilter = Desc.Min == ERTFilter::Linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
	Info.magFilter = Desc.Mag == ERTFilter::Linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
	Info.mipmapMode = Desc.Mip == ERTFilter::Linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
	Info.addressModeU = AddressOf(Desc.U);
	Info.addressModeV = AddressOf(Desc.V);
	Info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
	Info.maxLod = VK_LOD_CLAMP_NONE;
	Info.maxAnisotropy = std::clamp(Desc.MaxAnisotropy, 1.0f, Device.Probe.MaxAnisotropy);
	Info.anisotropyEnable = Info.maxAnisotropy > 1.0f;
	const VkResult Result = Device.Check(Device.Api.CreateSampler(Device.Handle, &Info, nullptr, &Handle));
	if (Result != VK_SUCCESS)
	{
		Handle = VK_NULL_HANDLE;
		return MakeStatus(Result, "Creating sampler", Name);
	}
	Device.SetName(VK_OBJECT_TYPE_SAMPLER, ToNative(Handle), Name);
	return AddToHeap(Name);
}

FRTStatus FVulkanSampler::AddToHeap(const char* Name)
{
	Index = Device.Bindless.AddSampler(Handle);
	if (Index == NoBindlessIndex)
	{
		return FRTStatus::Error(
		    ERTResult::OutOfDescriptors, "Sampler '%s': all %u indices are in use", FRTShown(Name).Text, Device.Probe.MaxBindlessSamplers);
	}
	return {};
}

FVulkanSampler::~FVulkanSampler()
{
	Device.Bindless.Remove(FVulkanBindless::Sampler, Index);
	if (bOwned) { Device.Api.DestroySampler(Device.Handle, Handle, nullptr); }
}

} // namespace Lantern
