// What the raw dispatch reads and writes, bound by hand: G-buffer, acceleration structure, output, and the table of sections.
#pragma once

#include <vector>

#include "Bench/BenchVulkan.h"
#include "LanternHost/HostScene.h"

namespace Lantern
{

struct FRawShadowDesc;

inline constexpr uint32_t RawPushBytes = 116; ///< push constants of the hand-written shaders

/// As in Shaders/RawSections.glsl.
struct FRawSection
{
	uint64_t Indices, Coverage;
	uint32_t Texture;
	float Cutoff;
	uint32_t Pad[2];
};
static_assert(sizeof(FRawSection) == 32, "shared with shaders");

class FRawTables
{
public:
	/// InVulkan and InDesc must outlive this object. InVulkan must be loaded before Create.
	FRawTables(const FBenchVulkan& InVulkan, const FRawShadowDesc& InDesc) : Vulkan(InVulkan), Desc(InDesc) {}
	~FRawTables();
	FRawTables(const FRawTables&) = delete;
	FRawTables& operator=(const FRawTables&) = delete;

	/// Output: storage image that the dispatch writes. The GPU must be done with all before this object goes.
	FRTStatus Create(VkImageView Output);
	/// Whether the scene has alpha-tested sections.
	bool HasMasked() const { return bMasked; }
	/// One for each hit record of the scene.
	const std::vector<FRawSection>& GetSections() const { return Sections; }
	bool IsMasked(size_t Section) const { return SectionMasked[Section]; }
	VkPipelineLayout GetLayout() const { return Layout; }
	const VkDescriptorSet& GetSet() const { return Set; }

private:
	FRTStatus CreateTextures();
	FRTStatus CreateSampler(const FHostTexture& Texture, VkSampler& Out);
	FRTStatus CreateSections();
	FRTStatus CreateLayout();
	void WriteDescriptors(VkImageView Output) const;

	const FBenchVulkan& Vulkan;
	const FRawShadowDesc& Desc;
	bool bMasked = false;
	std::vector<FRawSection> Sections;
	std::vector<bool> SectionMasked;
	std::vector<VkDescriptorImageInfo> Textures;
	std::vector<uint32_t> MaterialTextures; ///< by material, into Textures
	std::vector<VkSampler> Samplers;
	TRTRef<IRTBuffer> SectionBuffer;
	VkDescriptorSetLayout SetLayout = VK_NULL_HANDLE;
	VkDescriptorPool DescriptorPool = VK_NULL_HANDLE;
	VkDescriptorSet Set = VK_NULL_HANDLE;
	VkPipelineLayout Layout = VK_NULL_HANDLE;
};

} // namespace Lantern
