// The engine's G-buffer: a raster pass in plain Vulkan.
#pragma once

#include "Example/ForkScene.h"
#include "Example/ForkSkin.h"
#include "Example/ForkVulkan.h"

namespace Fork
{

/// Extent of a view. The views lie side by side in the engine's textures.
inline constexpr VkExtent2D ViewSize{320, 180};
inline constexpr uint32_t ViewCount = static_cast<uint32_t>(std::tuple_size_v<decltype(FForkScene::Cameras)>);
inline constexpr VkExtent2D TextureSize{ViewSize.width * ViewCount, ViewSize.height};
inline VkOffset2D GetViewOffset(uint32_t View) { return {static_cast<int32_t>(View * ViewSize.width), 0}; }

/// A frame of a view, and what was drawn in the frame before.
struct FForkFrame
{
	const FForkScene& Scene;
	const FForkScene& Before;
	uint32_t View = 0;
};

class FForkRaster
{
public:
	static constexpr VkFormat DepthFormat = VK_FORMAT_D32_SFLOAT_S8_UINT;
	static constexpr VkFormat ColorFormats[] = {
	    VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R16G16_SFLOAT, VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_R8G8B8A8_UNORM};
	static constexpr float Grey = 0.50289f; ///< base colour of all surfaces: 188 of 255 steps of sRGB
	/// The engine tests against its depth in later passes, and reads it in shaders.
	static constexpr VkImageLayout DepthLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;

	FForkRaster() = default;
	FForkRaster(const FForkRaster&) = delete;
	~FForkRaster();
	FError Create(const FForkDevice& InOwner);
	/// Draws a view into its part of the textures. Leaves the colours in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL and the depth in
	/// DepthLayout.
	void Draw(VkCommandBuffer Commands, const FForkFrame& Frame, const FForkSkin& Skin) const;

	FForkImage Depth, Normals, Motion, BaseColor, Material;

private:
	FError CreatePipeline();
	void Begin(VkCommandBuffer Commands, const VkRect2D& Area) const;
	void DrawBoxes(VkCommandBuffer Commands, const FForkFrame& Frame) const;
	void DrawReed(VkCommandBuffer Commands, const FForkFrame& Frame, const FForkSkin& Skin) const;

	VkDevice Device = VK_NULL_HANDLE;
	FForkBuffer Mesh;             // FBoxMesh
	FForkBuffer Views[ViewCount]; // what the shaders know of each view
	VkPipelineLayout Layout = VK_NULL_HANDLE;
	VkPipeline Pipeline = VK_NULL_HANDLE;
};

} // namespace Fork
