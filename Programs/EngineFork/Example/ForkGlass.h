// The pass behind the engine's lighting that puts glass in front of the picture.
#pragma once

#include "Example/ForkImagePass.h"
#include "LanternModule/Module.h"

namespace Fork
{

class FForkGlass
{
public:
	FError Create(const FForkDevice& Owner);
	/// Reads Lit, which is FForkLight's, and leaves Shown in VK_IMAGE_LAYOUT_GENERAL. The GPU must have finished the view's frame before.
	void Run(VkCommandBuffer Commands, uint32_t View, const FForkImage& Lit, const Lantern::FRTModuleTransmission& Glass);

	FForkImage Shown; ///< as FForkLight::Lit

private:
	FForkImage NoGlass, NoLooks; // stand in for null textures
	FForkImagePass Pass;
};

} // namespace Fork
