// Loads Vulkan functions for the device behind an IRTDevice.
#include "Bench/BenchVulkan.h"

#include <dlfcn.h>

namespace Lantern
{

FRTStatus FBenchVulkan::Load(IRTDevice& Rhi)
{
	Device = reinterpret_cast<VkDevice>(Rhi.GetNative(ERTNative::Device));
	Queue = reinterpret_cast<VkQueue>(Rhi.GetNative(ERTNative::Queue));
	QueueFamily = static_cast<uint32_t>(Rhi.GetNative(ERTNative::QueueFamily));
	// The device was created through the same library, so this only finds it again.
	void* const Library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
	const auto GetDeviceProcAddr = Library ? reinterpret_cast<PFN_vkGetDeviceProcAddr>(dlsym(Library, "vkGetDeviceProcAddr")) : nullptr;
	if (!Device || !GetDeviceProcAddr)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "the raw dispatch needs a Vulkan device and libvulkan.so.1");
	}
	const char* Missing = nullptr;
#define LANTERN_LOAD(Name)                                                                                                                 \
	Name = reinterpret_cast<PFN_vk##Name>(GetDeviceProcAddr(Device, "vk" #Name));                                                          \
	Missing = Name ? Missing : "vk" #Name;
	LANTERN_BENCH_VULKAN_FUNCTIONS(LANTERN_LOAD)
	if (Rhi.GetCapabilities().bRayTracingPipeline) { LANTERN_BENCH_VULKAN_PIPELINE_FUNCTIONS(LANTERN_LOAD) }
#undef LANTERN_LOAD
	return Missing ? FRTStatus::Error(ERTResult::Unsupported, "the device has no %s", Missing) : FRTStatus::Success();
}

FRTStatus CheckVulkan(VkResult Result, const char* What)
{
	if (Result == VK_SUCCESS) { return FRTStatus::Success(); }
	const ERTResult Code = Result == VK_ERROR_DEVICE_LOST            ? ERTResult::DeviceLost
	                       : Result == VK_ERROR_OUT_OF_HOST_MEMORY   ? ERTResult::OutOfHostMemory
	                       : Result == VK_ERROR_OUT_OF_DEVICE_MEMORY ? ERTResult::OutOfDeviceMemory
	                       : Result == VK_TIMEOUT                    ? ERTResult::Timeout
	                                                                 : ERTResult::CompileFailed;
	return FRTStatus::Error(Code, "raw dispatch: %s failed (VkResult %d)", What, static_cast<int>(Result));
}

} // namespace Lantern
