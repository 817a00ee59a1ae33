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
	static constexpr VkFormat DepthFormat = VK_FORMAT_D32_SFLOAT_S8_UINT;
	static constexpr VkFormat NormalsFormat = VK_FORMAT_R8G8B8A8_UNORM;

	FForkRaster() = default;
	FForkRaster(const FForkRaster&) = delete;
	~FForkRaster();
	FError Create(const FForkDevice& InOwner, VkExtent2D InSize);
	/// Leaves the normals in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL and the depth in DepthLayout.
	void Draw(VkCommandBuffer Commands, const FForkScene& Scene, const FCamera& Camera, const FForkSkin& Skin) const;
	/// The engine tests against its depth in later passes, and reads it in shaders.
	static constexpr VkImageLayout DepthLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;

	FForkImage Depth, Normals;

private:
	FError CreatePipeline();
	void DrawBoxes(VkCommandBuffer Commands, const FForkScene& Scene, const FCamera& Camera) const;
	void DrawReed(VkCommandBuffer Commands, const FForkScene& Scene, const FCamera& Camera, const FForkSkin& Skin) const;

	VkDevice Device = VK_NULL_HANDLE;
	VkExtent2D Size{};
	VkPipelineLayout Layout = VK_NULL_HANDLE;
	VkPipeline Pipeline = VK_NULL_HANDLE;
	FForkBuffer Mesh; // vertices, then indices
};

} // namespace Fork
