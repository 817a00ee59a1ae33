// The engine's start and its frame, with the plugin in both.
#include "Example/ForkEngine.h"

#include <cstdio>
#include <iterator>
#include <utility>

namespace Fork
{

using namespace Lantern;

namespace
{

constexpr VkDeviceSize MaskBytes = PixelCount * 2; // of each mask, in halves
constexpr VkDeviceSize LitBytes = PixelCount * 8;
constexpr VkDeviceSize ViewBytes = 2 * MaskBytes + LitBytes;

void CopyImage(VkCommandBuffer Commands, VkImage Image, VkImageLayout Layout, VkOffset2D From, const FForkBuffer& To, VkDeviceSize Offset)
{
	Transition(Commands, Image, VK_IMAGE_ASPECT_COLOR_BIT, Layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
	VkBufferImageCopy Region{};
	Region.bufferOffset = Offset;
	Region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
	Region.imageOffset = {From.x, From.y, 0};
	Region.imageExtent = {ViewSize.width, ViewSize.height, 1};
	vkCmdCopyImageToBuffer(Commands, Image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, To.Buffer, 1, &Region);
	Transition(Commands, Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, Layout);
}

} // namespace

FError FForkEngine::CreateOnDevice(FOnDevice& Out) const
{
	FError Reasons = "no Vulkan device";
	FForkFeatures Own;
	for (VkPhysicalDevice Physical : Instance.ListDevices())
	{
		FRTVulkanRequirementsDesc Desc;
		Desc.Instance = Instance.Instance;
		Desc.InstanceVersion = FForkInstance::Version;
		Desc.PhysicalDevice = Physical;
		Desc.Extensions = FForkFeatures::Extensions;
		Desc.ExtensionCount = static_cast<uint32_t>(std::size(FForkFeatures::Extensions));
		Desc.FeatureChain = &Own.Core;
		const FRTStatus Status = Module.GetVulkan()->GetRequirements(Desc, Out.Requirements.ReleaseAndGetAddress());
		if (!Status.IsOk())
		{
			Reasons += std::string("; ") + Status.Message;
			continue;
		}
		const char* const* const Names = Out.Requirements->GetExtensions();
		const FForkDeviceLists Lists{{Names, Names + Out.Requirements->GetExtensionCount()}, Out.Requirements->MergeFeatures()};
		const FRTCapabilities& Capabilities = Out.Requirements->GetCapabilities();
		std::printf("device: %s, %s\n", Capabilities.DeviceName, Capabilities.DriverName);
		return Out.Device.Create(Physical, Lists);
	}
	return Reasons;
}

FError FForkEngine::CreateDevice()
{
	On = std::make_unique<FOnDevice>();
	return CreateOnDevice(*On);
}

FError FForkEngine::FOnDevice::CreateThings()
{
	FError Error = Skin.Create(Device);
	if (Error.empty()) { Error = Raster.Create(Device); }
	if (Error.empty()) { Error = Light.Create(Device); }
	if (Error.empty()) { Error = Glass.Create(Device); }
	return Error.empty() ? Readback.Create(Device, ViewCount * ViewBytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT) : Error;
}

FError FForkEngine::LoadScene(const FForkScene& Scene)
{
	FError Error = On->CreateThings();
	if (Error.empty()) { Error = On->Plugin.Adopt(Module, Instance, On->Device, *On->Requirements); }
	if (Error.empty()) { Error = On->Plugin.ImportGBuffer(On->Raster); }
	return Error.empty() ? Plugin.Create(Module, On->Plugin, Scene) : Error;
}

FError FForkEngine::ChangeDevice()
{
	auto New = std::make_unique<FOnDevice>();
	FError Error = CreateOnDevice(*New);
	if (Error.empty()) { Error = New->CreateThings(); }
	if (Error.empty()) { Error = New->Plugin.Adopt(Module, Instance, New->Device, *New->Requirements); }
	if (Error.empty()) { Error = New->Plugin.ImportGBuffer(New->Raster); }
	if (Error.empty()) { Error = Plugin.Recreate(New->Plugin); }
	if (!Error.empty()) { return Error; }
	std::swap(On, New);
	Before.reset();
	return Error;
}

FError FForkEngine::CopyOutputs(const FRTModuleOutputs& Outputs, uint32_t View, FFrameMasks& Out) const
{
	Out = {};
	VkDeviceSize Offset = View * ViewBytes;
	const auto* const Start = static_cast<const uint16_t*>(On->Readback.Mapped);
	for (const auto& [Signal, Memory] :
	    {std::pair(ESignal::SunShadow, &Out.SunShadow), std::pair(ESignal::AmbientOcclusion, &Out.AmbientOcclusion)})
	{
		if (IRTTexture* const Mask = Outputs.Get(Signal))
		{
			if (Mask->GetDesc().Format != ERTFormat::R16_FLOAT) { return "an output has another format than this engine reads"; }
			// Outputs are readable by shaders, and have the size of the view.
			CopyImage(On->Device.Commands, reinterpret_cast<VkImage>(Mask->GetNative(ERTNative::Image)),
			    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, {}, On->Readback, Offset);
			*Memory = Start + Offset / sizeof(uint16_t);
		}
		Offset += MaskBytes;
	}
	CopyImage(On->Device.Commands, On->Glass.Shown.Image, VK_IMAGE_LAYOUT_GENERAL, GetViewOffset(View), On->Readback, Offset);
	Out.Lit = Start + Offset / sizeof(uint16_t);
	return {};
}

/// The skinned vertices go to the engine's own buffer, and to that of the plugin as soon as the plugin has one.
FError FForkEngine::SkinReed(const FReed& Reed)
{
	VkDeviceAddress Traced = 0;
	FError Error = Plugin.FindReedPositions(Traced);
	if (!Error.empty()) { return Error; }
	On->Skin.Run(On->Device.Commands, Reed, Traced);
	return Traced != 0 ? Plugin.MarkReedSkinned() : Error;
}

FError FForkEngine::RunView(const FForkFrame& Frame, bool bCut, FFrameMasks& Out)
{
	FError Error = On->Device.BeginCommands();
	if (Error.empty() && Frame.View == 0) { Error = SkinReed(Frame.Scene.Reed); }
	if (!Error.empty()) { return Error; }
	On->Raster.Draw(On->Device.Commands, Frame, On->Skin);
	FRTModuleOutputs Outputs;
	Error = Plugin.Render(On->Device.Commands, Frame, bCut, Outputs);
	if (!Error.empty()) { return Error; }
	On->Light.Run(On->Device.Commands, Frame, On->Raster, Outputs, Plugin.GetLampNumber());
	On->Glass.Run(On->Device.Commands, Frame.View, On->Light.Lit, Outputs.Transmission);
	Error = CopyOutputs(Outputs, Frame.View, Out);
	if (!Error.empty()) { return Error; }
	const auto SubmitAndEnd = [this] {
		const FError Submitted = On->Device.Submit();
		return Submitted.empty() ? Plugin.FinishFrame() : Submitted;
	};
	Error = RhiThread.Post(SubmitAndEnd).get();
	return Error.empty() ? On->Device.WaitForSubmit() : Error;
}

FError FForkEngine::RunFrame(const FForkScene& Scene, bool bCut, std::array<FFrameMasks, ViewCount>& Out)
{
	if (bCut || !Before) { Before = Scene; }
	FError Error;
	for (uint32_t View = 0; Error.empty() && View < ViewCount; ++View) { Error = RunView({Scene, *Before, View}, bCut, Out[View]); }
	Before = Scene;
	return Error;
}

} // namespace Fork
