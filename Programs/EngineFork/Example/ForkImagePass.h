// A compute pass of the engine over the pixels of a view: it reads some images, and writes others as storage.
#pragma once

#include <vector>

#include "Example/ForkRaster.h"

namespace Fork
{

struct FBoundImage
{
	VkImageView View = VK_NULL_HANDLE;
	VkImageLayout Layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
};

struct FImagePassDesc
{
	uint32_t ReadCount = 0, StorageCount = 0; ///< bindings 0 … ReadCount - 1 are sampled images, those behind storage images
	FForkShader Shader;                       ///< of groups of 8 × 8
	uint32_t PushBytes = 0;
};

class FForkImagePass
{
public:
	FForkImagePass() = default;
	FForkImagePass(const FForkImagePass&) = delete;
	~FForkImagePass();
	FError Create(const FForkDevice& Owner, const FImagePassDesc& InDesc);
	/// Images: one for each binding. The GPU must have finished the view's frame before.
	void Run(VkCommandBuffer Commands, uint32_t View, const std::vector<FBoundImage>& Images, const void* Push) const;

private:
	FError CreateSets();

	FImagePassDesc Desc;
	VkDevice Device = VK_NULL_HANDLE;
	VkDescriptorSetLayout SetLayout = VK_NULL_HANDLE;
	VkDescriptorPool Pool = VK_NULL_HANDLE;
	VkDescriptorSet Sets[ViewCount] = {};
	VkPipelineLayout Layout = VK_NULL_HANDLE;
	VkPipeline Pipeline = VK_NULL_HANDLE;
};

} // namespace Fork
