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

/// The plugin leaves its outputs readable by shaders. The engine copies an output and restores its layout.
void CopyMask(VkCommandBuffer Commands, IRTTexture& Mask, const FForkBuffer& Readback, VkDeviceSize Offset)
{
	const auto Image = reinterpret_cast<VkImage>(Mask.GetNative(ERTNative::Image));
	Transition(Commands, Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
	VkBufferImageCopy Region{};
	Region.bufferOffset = Offset;
	Region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
	Region.imageExtent = {FrameSize.width, FrameSize.height, 1};
	vkCmdCopyImageToBuffer(Commands, Image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, Readback.Buffer, 1, &Region);
	Transition(Commands, Image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

} // namespace

FForkEngine::~FForkEngine() { Plugin.ReleaseGBuffer(); }

FError FForkEngine::CreateDevice()
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
		const FRTStatus Status = Module.GetVulkan()->GetRequirements(Desc, Requirements.ReleaseAndGetAddress());
		if (!Status.IsOk())
		{
			Reasons += std::string("; ") + Status.Message;
			continue;
		}
		const char* const* const Names = Requirements->GetExtensions();
		const FForkDeviceLists Lists{{Names, Names + Requirements->GetExtensionCount()}, Requirements->MergeFeatures()};
		std::printf("device: %s, %s\n", Requirements->GetCapabilities().DeviceName, Requirements->GetCapabilities().DriverName);
		return Device.Create(Physical, Lists);
	}
	return Reasons;
}

FError FForkEngine::LoadScene(const FForkScene& Scene)
{
	FError Error = Plugin.Create(Module, Instance, Device, *Requirements);
	if (Error.empty()) { Error = Skin.Create(Device); }
	for (FForkRaster& Raster : Rasters) { Error = Error.empty() ? Raster.Create(Device, FrameSize) : Error; }
	if (Error.empty()) { Error = Readback.Create(Device, ViewCount * 2 * MaskBytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT); }
	if (Error.empty()) { Error = Plugin.AddScene(Scene); }
	for (FForkRaster& Raster : Rasters) { Error = Error.empty() ? Plugin.ImportGBuffer(Raster, FrameSize) : Error; }
	return Error;
}

FError FForkEngine::CopyOutputs(const FRTModuleOutputs& Outputs, VkDeviceSize Offset, FFrameMasks& Out) const
{
	Out = {};
	for (const auto& [Mask, Memory] : {std::pair(Outputs.Get(ESignal::SunShadow), &Out.SunShadow),
	         std::pair(Outputs.Get(ESignal::AmbientOcclusion), &Out.AmbientOcclusion)})
	{
		if (Mask != nullptr)
		{
			if (Mask->GetDesc().Format != ERTFormat::R16_FLOAT) { return "an output has another format than this engine reads"; }
			CopyMask(Device.Commands, *Mask, Readback, Offset);
			*Memory = static_cast<const uint16_t*>(Readback.Mapped) + Offset / sizeof(uint16_t);
		}
		Offset += MaskBytes;
	}
	return {};
}

/// The skinned vertices go to the engine's own buffer, and to that of the plugin as soon as the plugin has one.
FError FForkEngine::SkinReed(const FReed& Reed)
{
	VkDeviceAddress Traced = 0;
	FError Error = Plugin.FindReedPositions(Traced);
	if (!Error.empty()) { return Error; }
	Skin.Run(Device.Commands, Reed, Traced);
	return Traced != 0 ? Plugin.MarkReedSkinned() : Error;
}

FError FForkEngine::RunView(const FForkScene& Scene, size_t View, bool bCut, FFrameMasks& Out)
{
	FError Error = Device.BeginCommands();
	if (Error.empty() && View == 0) { Error = SkinReed(Scene.Reed); }
	if (!Error.empty()) { return Error; }
	Rasters[View].Draw(Device.Commands, Scene, Scene.Cameras[View], Skin);
	FRTModuleOutputs Outputs;
	Error = Plugin.Render(Device.Commands, Scene.Cameras[View], static_cast<uint32_t>(View), bCut, Outputs);
	if (Error.empty()) { Error = CopyOutputs(Outputs, View * 2 * MaskBytes, Out); }
	if (!Error.empty()) { return Error; }
	const auto SubmitAndEnd = [this] {
		const FError Submitted = Device.Submit();
		return Submitted.empty() ? Plugin.FinishFrame() : Submitted;
	};
	Error = RhiThread.Post(SubmitAndEnd).get();
	return Error.empty() ? Device.WaitForSubmit() : Error;
}

FError FForkEngine::RunFrame(const FForkScene& Scene, bool bCut, std::array<FFrameMasks, ViewCount>& Out)
{
	FError Error;
	for (size_t View = 0; Error.empty() && View < ViewCount; ++View) { Error = RunView(Scene, View, bCut, Out[View]); }
	return Error;
}

} // namespace Fork
