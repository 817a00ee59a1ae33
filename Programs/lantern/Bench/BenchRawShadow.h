// The yardstick of `lantern bench rays`: sun shadow rays by plain Vulkan, as one would write them by hand for this one job. It has a
// pipeline, shader table, descriptor set, command buffer and tables of its own. From the RHI it takes device and memory, and the
// acceleration structure and pictures that the plugin's pass reads.
#pragma once

#include <memory>
#include <vector>

#include "Bench/BenchVulkan.h"
#include "LanternHost/HostScene.h"

namespace Lantern
{

inline constexpr uint32_t RawPushBytes = 116; ///< push constants of the hand-written shaders

struct FRawShadowDesc
{
	IRTDevice* Device = nullptr;
	FShaderCompiler* Compiler = nullptr; ///< searches Programs/lantern/Bench/Shaders and Shaders
	FHostScene* Scene = nullptr;         ///< drawn at least once; must not change afterwards
	FView View;
	IRTTexture* Depth = nullptr; ///< as FGBuffer has them, in ShaderRead
	IRTTexture* Normals = nullptr;
	float MaxDistance = 0.0f;
	uint32_t InstanceMask = 0;
	bool bPipeline = false;  ///< otherwise ray query
	bool bCountRays = false; ///< traces nothing; the picture is 1 in pixels that would trace a ray
};

/// One thread may use it. Nothing else may use the queue during Create and Run.
class FRawShadow
{
public:
	/// The scene must have one hit record for each section, which holds if the RTPSO in use has a single ray type.
	static FRTStatus Create(const FRawShadowDesc& Desc, std::unique_ptr<FRawShadow>& Out);
	~FRawShadow();

	/// Submits one dispatch and waits for it. OutMs is its time by timestamps.
	FRTStatus Run(double& OutMs);
	/// Visibility of the last Run: halves, rows from the top.
	const uint16_t* GetPicture() const;

private:
	explicit FRawShadow(const FRawShadowDesc& InDesc) : Desc(InDesc) {}
	FRTStatus Initialise();
	FRTStatus CreateOutput();
	FRTStatus CreateSections(); // BenchRawTables.cpp
	FRTStatus CreateTextures(); // BenchRawTables.cpp
	FRTStatus CreateSampler(const FHostTexture& Texture, VkSampler& Out);
	FRTStatus CreateLayout();      // BenchRawTables.cpp
	FRTStatus CreateDescriptors(); // BenchRawTables.cpp
	FRTStatus CreateComputePipeline();
	FRTStatus CreateRayPipeline();
	FRTStatus CreateShaderTable();
	FRTStatus CreateCommands();
	FRTStatus CompileModule(const char* Path, ERTShaderStage Stage, VkShaderModule& Out);
	FRTStatus Record();
	FRTStatus Check(VkResult Result, const char* What) const;

	/// As in Shaders/RawSections.glsl.
	struct FSection
	{
		uint64_t Indices, Coverage;
		uint32_t Texture;
		float Cutoff;
		uint32_t Pad[2];
	};
	static_assert(sizeof(FSection) == 32, "shared with shaders");

	FRawShadowDesc Desc;
	FBenchVulkan Vulkan;
	bool bMasked = false;
	std::vector<FSection> Sections;
	std::vector<bool> SectionMasked;
	std::vector<VkDescriptorImageInfo> Textures;
	std::vector<uint32_t> MaterialTextures; ///< by material, into Textures
	std::vector<VkSampler> Samplers;
	std::vector<VkShaderModule> Modules;
	TRTRef<IRTBuffer> SectionBuffer, Table, Readback;
	TRTRef<IRTTexture> Output;
	VkImageView OutputView = VK_NULL_HANDLE;
	VkDescriptorSetLayout SetLayout = VK_NULL_HANDLE;
	VkDescriptorPool DescriptorPool = VK_NULL_HANDLE;
	VkDescriptorSet Set = VK_NULL_HANDLE;
	VkPipelineLayout Layout = VK_NULL_HANDLE;
	VkPipeline Pipeline = VK_NULL_HANDLE;
	VkStridedDeviceAddressRegionKHR RayGenRegion{}, MissRegion{}, HitRegion{};
	VkCommandPool CommandPool = VK_NULL_HANDLE;
	VkCommandBuffer Commands = VK_NULL_HANDLE;
	VkQueryPool Queries = VK_NULL_HANDLE;
	VkFence Fence = VK_NULL_HANDLE;
};

} // namespace Lantern
