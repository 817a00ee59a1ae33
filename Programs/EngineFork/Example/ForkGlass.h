// The pass behind the engine's lighting that puts glass in front of the picture.
#pragma once

#include "Example/ForkRaster.h"
#include "LanternModule/Module.h"

namespace Fork
{

class FForkGlass
{
public:
	FForkGlass() = default;
	FForkGlass(const FForkGlass&) = delete;
	~FForkGlass();
	FError Create(const FForkDevice& Owner);
	/// Reads Lit, which is FForkLight's, and leaves Shown in VK_IMAGE_LAYOUT_GENERAL. The GPU must have finished the view's frame before.
	void Run(VkCommandBuffer Commands, uint32_t View, const FForkImage& Lit, const Lantern::FRTModuleTransmission& Glass);

	FForkImage Shown; ///< as FForkLight::Lit

private:
	FError CreateSets();
	FError CreatePipeline();
	void WriteSet(VkDescriptorSet Set, const VkImageView* Views);

	VkDevice Device = VK_NULL_HANDLE;
	FForkImage NoGlass, NoLooks; // stand in for null textures
	VkDescriptorSetLayout SetLayout = VK_NULL_HANDLE;
	VkDescriptorPool Pool = VK_NULL_HANDLE;
	VkDescriptorSet Sets[ViewCount] = {};
	VkPipelineLayout Layout = VK_NULL_HANDLE;
	VkPipeline Pipeline = VK_NULL_HANDLE;
};

} // namespace Fork
