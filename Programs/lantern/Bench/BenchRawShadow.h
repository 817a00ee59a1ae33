// The yardstick of `lantern bench rays`: sun shadow rays by plain Vulkan, as one would write them by hand for this
// one job. Pipeline, shader table, descriptor set, command buffer and tables are its own; of the RHI it uses the
// device, memory, the acceleration structure and the pictures that the plugin's pass reads, too.
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
	bool bPipeline = false;  ///< else ray query
	bool bCountRays = false; ///< traces nothing: the picture is 1 where a ray would be traced
};

/// One thread; nothing else may use the queue during Create and Run.
class FRawShadow
{
public:
	/// The scene's hit records must be one for each section: the RTPSO in use has a single ray type.
	static FRTStatus Create(const FRawShadowDesc& Desc, std::unique_ptr<FRawShadow>& Out);
	~FRawShadow();

	/// One dispatch in a submission of its own, waited for. OutMs: by timestamps around it.
	FRTStatus Run(double& OutMs);
	/// Visibility of the last Run, fp16, rows from the top.
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
