// The engine's skinning: a compute pass that bends the reed, in plain Vulkan. What it writes is drawn, and handed to the plugin.
#pragma once

#include "Example/ForkScene.h"
#include "Example/ForkVulkan.h"

namespace Fork
{

class FForkSkin
{
public:
	FForkSkin() = default;
	FForkSkin(const FForkSkin&) = delete;
	~FForkSkin();
	FError Create(const FForkDevice& Owner);
	/// Writes Vertices for the bend of Reed. They can be drawn and read afterwards.
	void Run(VkCommandBuffer Commands, const FReed& Reed) const;

	FForkBuffer Vertices; ///< FVertex each, without normals
	FForkBuffer Indices;
	uint32_t VertexCount = 0, IndexCount = 0;

private:
	FError CreatePipeline();

	VkDevice Device = VK_NULL_HANDLE;
	VkPipelineLayout Layout = VK_NULL_HANDLE;
	VkPipeline Pipeline = VK_NULL_HANDLE;
	FForkBuffer BindPose; ///< FSkinVertex each
};

} // namespace Fork
