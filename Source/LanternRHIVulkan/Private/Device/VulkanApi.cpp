// Loads the Vulkan loader and fills the function tables.
#include "Device/VulkanApi.h"

#if defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <dlfcn.h>
#endif

#include <cstdio>
#include <mutex>

namespace Lantern
{

namespace
{

/// The loader is never closed: drivers leave threads and at-exit handlers behind that must stay mapped.
PFN_vkGetInstanceProcAddr OpenLibrary(char* OutError, size_t ErrorSize)
{
	OutError[0] = 0;
#if defined(_WIN32)
	HMODULE Library = LoadLibraryA("vulkan-1.dll");
	if (Library)
	{
		return reinterpret_cast<PFN_vkGetInstanceProcAddr>(reinterpret_cast<void*>(GetProcAddress(Library, "vkGetInstanceProcAddr")));
	}
	snprintf(OutError, ErrorSize, "vulkan-1.dll: error %lu", GetLastError());
	return nullptr;
#else
	for (const char* File : {"libvulkan.so.1", "libvulkan.so", "libvulkan.1.dylib"})
	{
		if (void* Library = dlopen(File, RTLD_NOW | RTLD_LOCAL))
		{
			return reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(Library, "vkGetInstanceProcAddr"));
		}
		if (!OutError[0])
		{
			const char* Message = dlerror();
			snprintf(OutError, ErrorSize, "%s", Message ? Message : File);
		}
	}
	return nullptr;
#endif
}

} // namespace

FRTStatus OpenVulkanLoader(FVulkanLoader* Out)
{
	static std::once_flag Once;
	static FVulkanLoader Loader;
	static char Error[256];
	std::call_once(Once, [] {
		Loader.GetInstanceProcAddr = OpenLibrary(Error, sizeof(Error));
		if (!Loader.GetInstanceProcAddr) { return; }
#define LANTERN_VK_LOAD(Name) Loader.Name = reinterpret_cast<PFN_vk##Name>(Loader.GetInstanceProcAddr(nullptr, "vk" #Name));
		LANTERN_VK_LOAD(CreateInstance)
		LANTERN_VK_LOAD(EnumerateInstanceVersion)
		LANTERN_VK_LOAD(EnumerateInstanceExtensionProperties)
		LANTERN_VK_LOAD(EnumerateInstanceLayerProperties)
#undef LANTERN_VK_LOAD
	});
	if (!Loader.GetInstanceProcAddr || !Loader.CreateInstance)
	{
		return FRTStatus::Error(ERTResult::Unsupported,
		    "No Vulkan loader on this machine (%s). Install one, e.g. "
		    "Debian's libvulkan1, and a driver.",
		    Error[0] ? Error : "it exports nothing");
	}
	*Out = Loader;
	return {};
}

FRTStatus LoadInstanceApi(PFN_vkGetInstanceProcAddr GetInstanceProcAddr, VkInstance Instance, FVulkanInstanceApi* Out)
{
	const char* Absent = nullptr;
	Out->GetInstanceProcAddr = GetInstanceProcAddr;
#define LANTERN_VK_LOAD(Name) Out->Name = reinterpret_cast<PFN_vk##Name>(GetInstanceProcAddr(Instance, "vk" #Name));
#define LANTERN_VK_LOAD_NEEDED(Name)                                                                                                       \
	LANTERN_VK_LOAD(Name)                                                                                                                  \
	if (!Out->Name) { Absent = "vk" #Name; }
	LANTERN_VK_INSTANCE_FUNCTIONS(LANTERN_VK_LOAD_NEEDED)
	LANTERN_VK_DEBUG_FUNCTIONS(LANTERN_VK_LOAD)
#undef LANTERN_VK_LOAD_NEEDED
#undef LANTERN_VK_LOAD
	if (Absent) { return FRTStatus::Error(ERTResult::Unsupported, "The Vulkan instance has no %s: Vulkan 1.3 is needed.", Absent); }
	return {};
}

FRTStatus LoadDeviceApi(const FVulkanInstanceApi& Instance, VkDevice Device, bool bAccel, bool bPipeline, FVulkanDeviceApi* Out)
{
	const char* Absent = nullptr;
#define LANTERN_VK_LOAD(Name)                                                                                                              \
	Out->Name = reinterpret_cast<PFN_vk##Name>(Instance.GetDeviceProcAddr(Device, "vk" #Name));                                            \
	if (!Out->Name) { Absent = "vk" #Name; }
	LANTERN_VK_DEVICE_FUNCTIONS(LANTERN_VK_LOAD)
	if (bAccel) { LANTERN_VK_ACCEL_FUNCTIONS(LANTERN_VK_LOAD) }
	if (bPipeline) { LANTERN_VK_PIPELINE_FUNCTIONS(LANTERN_VK_LOAD) }
#undef LANTERN_VK_LOAD
	if (Absent)
	{
		return FRTStatus::Error(ERTResult::Unsupported,
		    "The Vulkan device has no %s: its extension was not enabled when the device was created (see GetVulkanRequirements), or the "
		    "instance was created for a Vulkan older than 1.3.",
		    Absent);
	}
	return {};
}

} // namespace Lantern
