// The engine's skinning: a compute pass that bends the reed, in plain Vulkan. It writes what is drawn, and what the plugin traces.
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
	/// Writes Vertices for the bend of Reed. They can be drawn and read afterwards. Traced: address of the plugin's positions of the
	/// reed, three floats each; 0: it has none yet.
	void Run(VkCommandBuffer Commands, const FReed& Reed, VkDeviceAddress Traced) const;

	FForkBuffer Vertices; ///< FVertex each, without normals and UVs
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
