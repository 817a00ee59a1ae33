// Creation of the Vulkan peer of the RHI. This header needs none of Vulkan's. LanternRHIVulkan/VulkanInterop.h takes over an
// engine's device.
//
// A device must have Vulkan 1.3 with these features. Commands: dynamic rendering, synchronization2, timeline semaphores.
// Resources: buffer device addresses, bindless descriptors, storage images without format. Shaders: 64-bit integers, scalar
// block layout. Ray tracing decides the rung (ERTRung); every extension of the ladder is optional.
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

/// Called from any thread, also during a call of the device. It must not call the device.
using FRTVulkanMessageCallback = void (*)(void* User, ERTVulkanMessage Severity, const char* Text);

/// Gets each call of Vulkan that a device makes, from the thread that made it, right after it.
struct FRTVulkanCallSink
{
	/// Name: "vkQueueSubmit2", static. Null: calls are not timed, and cost nothing more.
	void (*Call)(void* User, const char* Name, uint64_t Nanoseconds) = nullptr;
	void* User = nullptr;
};

struct FRTVulkanDeviceDesc
{
	/// Index as in ListVulkanDevices. -1 chooses the best device: discrete with ray-tracing pipelines first, CPUs last.
	int DeviceIndex = -1;
	/// Switches VK_LAYER_KHRONOS_validation on. Unsupported if the layer is not installed.
	bool bValidation = false;
	/// Adds the layer's synchronization validation, which is slow.
	bool bSynchronizationValidation = false;
	/// Highest rung to use. RayQuery hides ray-tracing pipelines, Pipeline hides reordering and micromaps, and so on.
	ERTRung MaxRung = ERTRung::Micromap;
	bool bDisableRayQuery = false;
	bool bDisablePipeline = false;
	/// Accepts a device without any ray tracing (rung None).
	bool bAllowNoRayTracing = false;
	/// File that is read at creation and written, atomically, when the device is destroyed. Null keeps no cache. A file that is
	/// damaged or another driver's is discarded with one message.
	const char* PipelineCacheFile = nullptr;
	/// Sends pipeline libraries through the pipeline cache too. If false, each process compiles them anew, unless the driver has
	/// a cache of its own; but threads that compile them share nothing.
	bool bCacheLibraries = true;
	/// Null prints warnings and errors to standard error.
	FRTVulkanMessageCallback MessageCallback = nullptr;
	void* MessageUser = nullptr;
	/// For tools that look for the call that a frame waits in. The newest sink serves all devices of the process that have one.
	FRTVulkanCallSink CallSink;
};

/// Returns Unsupported if there is no loader, no device, or none good enough. The message says what each device lacks.
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
	char Missing[1024] = {}; ///< one line for each thing it lacks, and what that costs; empty if it lacks nothing
	char Quirks[1024] = {};  ///< one line for each known fault of this driver that Lantern works around
};

/// Fills at most Capacity entries of Out, which may be null if Capacity is 0. OutCount: the number of devices, which may be 0.
/// Returns Unsupported if there is no loader.
FRTStatus ListVulkanDevices(FRTVulkanDeviceInfo* Out, uint32_t Capacity, uint32_t* OutCount);

/// Writes the pipeline cache now rather than at destruction. Ok if the device keeps none.
FRTStatus SaveVulkanPipelineCache(IRTDevice* Device);

} // namespace Lantern
