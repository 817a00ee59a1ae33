// The yardstick of `lantern bench rays`: sun shadow rays by plain Vulkan, as one would write them by hand for this one job. It has a
// pipeline, shader table, descriptor set, command buffer and tables of its own. From the RHI it takes device and memory, and the
// acceleration structure and pictures that the plugin's pass reads.
#pragma once

#include <memory>
#include <vector>

#include "Bench/BenchRawTables.h"

namespace Lantern
{

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
	FRTStatus CreateComputePipeline();
	FRTStatus CreateRayPipeline();
	FRTStatus CreateShaderTable();
	FRTStatus CreateCommands();
	FRTStatus CompileModule(const char* Path, ERTShaderStage Stage, VkShaderModule& Out);
	FRTStatus Record();

	FRawShadowDesc Desc;
	FBenchVulkan Vulkan;
	FRawTables Tables{Vulkan, Desc};
	std::vector<VkShaderModule> Modules;
	TRTRef<IRTBuffer> ShaderTable, Readback;
	TRTRef<IRTTexture> Output;
	VkImageView OutputView = VK_NULL_HANDLE;
	VkPipeline Pipeline = VK_NULL_HANDLE;
	VkStridedDeviceAddressRegionKHR RayGenRegion{}, MissRegion{}, HitRegion{};
	VkCommandPool CommandPool = VK_NULL_HANDLE;
	VkCommandBuffer Commands = VK_NULL_HANDLE;
	VkQueryPool Queries = VK_NULL_HANDLE;
	VkFence Fence = VK_NULL_HANDLE;
};

} // namespace Lantern
