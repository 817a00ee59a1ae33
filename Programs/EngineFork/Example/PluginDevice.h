// What the plugin has on one VkDevice of the engine: the adopted device, the G-buffer, a texture with its sampler.
#pragma once

#include "Example/ForkRaster.h"
#include "LanternModule/ModuleVulkan.h"

namespace Fork
{

class FPluginDevice
{
public:
	FPluginDevice() = default;
	FPluginDevice(const FPluginDevice&) = delete;
	~FPluginDevice();
	/// Owner must have been created with Requirements, which come from IRTModuleVulkan::GetRequirements. Uploads the map of the cut-out
	/// material, too.
	FError Adopt(
	    Lantern::IRTModule& Module, const FForkInstance& Instance, FForkDevice& Owner, const Lantern::IRTVulkanRequirements& Requirements);
	FError ImportGBuffer(const FForkRaster& Raster);

	Lantern::TRTRef<Lantern::IRTDevice> Device; // declared first, so that it is released last
	Lantern::TRTRef<Lantern::IRTTexture> Depth, Normals, Motion, BaseColor, Material;
	Lantern::TRTRef<Lantern::IRTTexture> CutOutMap;
	Lantern::TRTRef<Lantern::IRTSampler> CutOutSampler;

private:
	FError UploadMap(FForkDevice& Owner);

	VkDevice Native = VK_NULL_HANDLE;
	FForkImage MapImage; ///< the engine's
	VkSampler MapSampler = VK_NULL_HANDLE;
};

} // namespace Fork
