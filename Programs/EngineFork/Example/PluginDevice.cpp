// The engine's device, its G-buffer and its texture, handed to the plugin.
#include "Example/PluginDevice.h"

#include <cstring>
#include <mutex>

namespace Fork
{

using namespace Lantern;

FError FPluginDevice::Adopt(IRTModule& Module, const FForkInstance& Instance, FForkDevice& Owner, const IRTVulkanRequirements& Requirements)
{
	FRTVulkanExternalDesc Desc;
	Desc.Instance = Instance.Instance;
	Desc.PhysicalDevice = Owner.Physical;
	Desc.Device = Owner.Device;
	Desc.Queue = Owner.Queue;
	Desc.QueueFamily = Owner.QueueFamily;
	Desc.Requirements = &Requirements;
	// The render thread and that of the RHI submit.
	Desc.LockQueue = [](void* User) { static_cast<std::mutex*>(User)->lock(); };
	Desc.UnlockQueue = [](void* User) { static_cast<std::mutex*>(User)->unlock(); };
	Desc.QueueUser = &Owner.QueueMutex;
	FError Error = ToError(Module.GetVulkan()->AdoptDevice(Desc, Device.ReleaseAndGetAddress()), "AdoptDevice");
	return Error.empty() ? UploadMap(Owner) : Error;
}

namespace
{

uint64_t ToNative(VkImage Image) { return reinterpret_cast<uint64_t>(Image); }

FRTTextureDesc Describe(VkExtent2D Size, ERTFormat Format, const char* Name)
{
	FRTTextureDesc Desc;
	Desc.Width = Size.width;
	Desc.Height = Size.height;
	Desc.Format = Format;
	Desc.Usage = ERTTextureUsage::Sampled;
	Desc.Name = Name;
	return Desc;
}

} // namespace

FError FPluginDevice::ImportGBuffer(const FForkRaster& Raster)
{
	const auto Import = [&](VkImage Image, ERTFormat Format, const char* Name, TRTRef<IRTTexture>& Out) {
		return ToError(Device->ImportTexture(Describe(TextureSize, Format, Name), ToNative(Image), Out.ReleaseAndGetAddress()), Name);
	};
	FError Error = Import(Raster.Depth.Image, ERTFormat::D32_FLOAT_S8_UINT, "ForkDepth", Depth);
	if (Error.empty()) { Error = Import(Raster.Normals.Image, ERTFormat::RGBA8_UNORM, "ForkNormals", Normals); }
	if (Error.empty()) { Error = Import(Raster.Motion.Image, ERTFormat::RG16_FLOAT, "ForkMotion", Motion); }
	if (Error.empty()) { Error = Import(Raster.BaseColor.Image, ERTFormat::RGBA8_SRGB, "ForkBaseColor", BaseColor); }
	if (Error.empty()) { Error = Import(Raster.Material.Image, ERTFormat::RGBA8_UNORM, "ForkMaterial", Material); }
	if (!Error.empty()) { return Error; }
	// The raster's barrier has already waited for the depth. The next frame's raster begins with a barrier of its own.
	const FRTExternalState State{FForkRaster::DepthLayout, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT};
	return ToError(Depth->SetExternalState(State, State), "SetExternalState(depth)");
}

FError FPluginDevice::UploadMap(FForkDevice& Owner)
{
	Native = Owner.Device;
	const auto Texels = MakeCutOutMap();
	constexpr VkExtent2D Size{CutOutMapSize, CutOutMapSize};
	constexpr VkImageUsageFlags Usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
	FForkBuffer Staging;
	FError Error = MapImage.Create(Owner, Size, VK_FORMAT_R8G8B8A8_SRGB, Usage, VK_IMAGE_ASPECT_COLOR_BIT);
	if (Error.empty()) { Error = Staging.Create(Owner, sizeof(Texels), VK_BUFFER_USAGE_TRANSFER_SRC_BIT); }
	if (Error.empty()) { Error = Owner.BeginCommands(); }
	if (!Error.empty()) { return Error; }
	std::memcpy(Staging.Mapped, Texels.data(), sizeof(Texels));
	const auto Move = [&](VkImageLayout From, VkImageLayout To) {
		Transition(Owner.Commands, MapImage.Image, VK_IMAGE_ASPECT_COLOR_BIT, From, To);
	};
	Move(VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
	VkBufferImageCopy Region{};
	Region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
	Region.imageExtent = {Size.width, Size.height, 1};
	vkCmdCopyBufferToImage(Owner.Commands, Staging.Buffer, MapImage.Image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &Region);
	Move(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL); // what the plugin expects of maps
	Error = Owner.Submit();
	if (Error.empty()) { Error = Owner.WaitForSubmit(); }
	if (!Error.empty()) { return Error; }
	const VkSamplerCreateInfo Nearest{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
	vkCreateSampler(Native, &Nearest, nullptr, &MapSampler);
	FRTSamplerDesc SamplerDesc;
	SamplerDesc.NativeSampler = reinterpret_cast<uint64_t>(MapSampler);
	SamplerDesc.Name = "ForkNearest";
	Error = ToError(Device->CreateSampler(SamplerDesc, CutOutSampler.ReleaseAndGetAddress()), "CreateSampler");
	if (!Error.empty()) { return Error; }
	FRTTextureDesc Desc = Describe(Size, ERTFormat::RGBA8_SRGB, "ForkCutOut");
	Desc.NativeView = reinterpret_cast<uint64_t>(MapImage.View);
	return ToError(Device->ImportTexture(Desc, ToNative(MapImage.Image), CutOutMap.ReleaseAndGetAddress()), "ImportTexture(map)");
}

FPluginDevice::~FPluginDevice()
{
	Depth.Reset();
	Normals.Reset();
	Motion.Reset();
	BaseColor.Reset();
	Material.Reset();
	CutOutMap.Reset();
	CutOutSampler.Reset();
	if (Device) { Device->CollectGarbage(); } // destroys the plugin's views of the images now, not some time later
	if (Native != VK_NULL_HANDLE) { vkDestroySampler(Native, MapSampler, nullptr); }
}

} // namespace Fork
