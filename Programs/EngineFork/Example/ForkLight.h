// The engine's lighting: a compute pass that reads the G-buffer and the plugin's outputs.
#pragma once

#include "Example/ForkImagePass.h"
#include "LanternModule/Module.h"

namespace Fork
{

class FForkLight
{
public:
	static constexpr VkFormat Format = VK_FORMAT_R16G16B16A16_SFLOAT;
	static constexpr double Sun = 1.0, Ambient = 0.25; ///< on a surface that faces it, and from everywhere

	FError Create(const FForkDevice& Owner);
	/// Lights a view. The GPU must have finished the view's frame before. Leaves Lit in VK_IMAGE_LAYOUT_GENERAL. LampNumber: by which the
	/// light mask names the lamp.
	void Run(VkCommandBuffer Commands, const FForkFrame& Frame, const FForkRaster& Raster, const Lantern::FRTModuleOutputs& Outputs,
	    uint32_t LampNumber);

	FForkImage Lit; ///< radiance, of all views side by side; a: 1 where there is a surface

private:
	FForkImage NoMask; // stands in for null textures of integers
	FForkImagePass Pass;
};

} // namespace Fork
