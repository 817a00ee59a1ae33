// Creation of the Vulkan peer of the RHI. Needs no Vulkan header; for taking over an engine's device see
// LanternRHIVulkan/VulkanInterop.h.
//
// Needed of a device: Vulkan 1.3 with dynamic rendering, synchronization2, timeline semaphores, buffer device
// addresses, bindless descriptors, 64-bit integers, scalar block layout, storage images without format. Ray
// tracing decides the rung (ERTRung); every extension of the ladder is optional.
#pragma once

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

enum class ERTVulkanMessage : uint8_t
{
	Info,
	Warning,
	Error,
};

/// Called from any thread, also while a device call is under way: it must not call the device.
using FRTVulkanMessageCallback = void (*)(void* User, ERTVulkanMessage Severity, const char* Text);

struct FRTVulkanDeviceDesc
{
	/// As ListVulkanDevices counts them. -1: the best one (discrete with ray-tracing pipelines first, CPU last).
	int DeviceIndex = -1;
	/// VK_LAYER_KHRONOS_validation; Unsupported when the layer is not installed.
	bool bValidation = false;
	/// Also the layer's synchronization validation. Slow.
	bool bSynchronizationValidation = false;
	/// Highest rung to use. RayQuery hides ray-tracing pipelines, Pipeline hides reordering and micromaps, ….
	ERTRung MaxRung = ERTRung::Micromap;
	bool bDisableRayQuery = false;
	bool bDisablePipeline = false;
	/// A device without any ray tracing is good enough (rung None).
	bool bAllowNoRayTracing = false;
	/// Read at creation and written, atomically, when the device is destroyed. Null: not kept. A file that is
	/// damaged or another driver's is discarded with one message.
	const char* PipelineCacheFile = nullptr;
	/// Pipeline libraries, too, go through the pipeline cache. Without, they are compiled anew in each process (unless
	/// the driver has a cache of its own), but threads that compile them share nothing.
	bool bCacheLibraries = true;
	/// Null: standard error, warnings and errors only.
	FRTVulkanMessageCallback MessageCallback = nullptr;
	void* MessageUser = nullptr;
};

/// Unsupported, with what every device found lacks, when there is no loader, no device, or none good enough.
FRTStatus CreateVulkanDevice(const FRTVulkanDeviceDesc& Desc, IRTDevice** Out);

struct FRTVulkanDeviceInfo
{
	char Name[256] = {};
	char Driver[256] = {};   ///< name and version
	char Type[16] = {};      ///< discrete, integrated, virtual, cpu, other
	uint32_t ApiVersion = 0; ///< packed as VK_MAKE_API_VERSION
	bool bUsable = false;    ///< has what every device needs; the rung may still be None
	ERTRung Rung = ERTRung::None;
	bool bRayQuery = false;
	bool bRayTracingPipeline = false;
	char Missing[1024] = {}; ///< one line per thing it lacks, and what that costs; empty: nothing
	char Quirks[1024] = {};  ///< one line per known fault of this driver that Lantern works around
};

/// Fills at most Capacity entries of Out (may be null when 0); OutCount: the devices there are.
/// Unsupported without a loader; no device is Ok with 0.
FRTStatus ListVulkanDevices(FRTVulkanDeviceInfo* Out, uint32_t Capacity, uint32_t* OutCount);

/// Writes the pipeline cache now rather than at destruction. Ok when none was asked for.
FRTStatus SaveVulkanPipelineCache(IRTDevice* Device);

} // namespace Lantern
