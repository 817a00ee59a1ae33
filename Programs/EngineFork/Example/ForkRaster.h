// The engine's G-buffer: its images and the raster pass that fills them, in plain Vulkan.
#pragma once

#include "Example/ForkScene.h"
#include "Example/ForkSkin.h"
#include "Example/ForkVulkan.h"

namespace Fork
{

class FForkRaster
{
public:
	static constexpr VkFormat DepthFormat = VK_FORMAT_D32_SFLOAT;
	static constexpr VkFormat NormalsFormat = VK_FORMAT_R16G16B16A16_SNORM;

	FForkRaster() = default;
	FForkRaster(const FForkRaster&) = delete;
	~FForkRaster();
	FError Create(const FForkDevice& InOwner, VkExtent2D InSize);
	/// Leaves both images in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL.
	void Draw(VkCommandBuffer Commands, const FForkScene& Scene, const FForkSkin& Skin) const;

	FForkImage Depth, Normals;

private:
	FError CreatePipeline();
	void DrawBoxes(VkCommandBuffer Commands, const FForkScene& Scene) const;
	void DrawReed(VkCommandBuffer Commands, const FForkScene& Scene, const FForkSkin& Skin) const;

	VkDevice Device = VK_NULL_HANDLE;
	VkExtent2D Size{};
	VkPipelineLayout Layout = VK_NULL_HANDLE;
	VkPipeline Pipeline = VK_NULL_HANDLE;
	FForkBuffer Mesh; // vertices, then indices
};

} // namespace Fork
