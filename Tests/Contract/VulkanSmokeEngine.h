// An engine beside Lantern, for the Vulkan smoke tests: its own instance, device and command buffer.
#pragma once

#include "LanternRHIVulkan/VulkanInterop.h"
#include "VulkanSmokeFixture.h"

#include <string>

namespace Lantern
{

inline const bool bValidation = !getenv("LANTERN_TEST_WITHOUT_LAYERS");

/// The engine's side: its own instance and device, made through the loader by hand.
class FEngine
{
public:
	~FEngine()
	{
		if (Messenger) { Get<PFN_vkDestroyDebugUtilsMessengerEXT>("vkDestroyDebugUtilsMessengerEXT")(Instance, Messenger, nullptr); }
		if (Device) { Get<PFN_vkDestroyDevice>("vkDestroyDevice")(Device, nullptr); }
		if (Instance) { Get<PFN_vkDestroyInstance>("vkDestroyInstance")(Instance, nullptr); }
	}

	template <class T>
	T Get(const char* Name)
	{
		return reinterpret_cast<T>(GetProc(Instance, Name));
	}

	bool CreateInstance()
	{
		void* Library = dlopen("libvulkan.so.1", RTLD_NOW);
		GetProc = Library ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(Library, "vkGetInstanceProcAddr")) : nullptr;
		if (!GetProc) { return false; }
		VkApplicationInfo App{VK_STRUCTURE_TYPE_APPLICATION_INFO};
		App.apiVersion = VK_API_VERSION_1_3;
		const char* Layer = "VK_LAYER_KHRONOS_validation";
		const char* Extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
		VkInstanceCreateInfo Info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
		Info.pApplicationInfo = &App;
		Info.enabledLayerCount = bValidation ? 1 : 0;
		Info.ppEnabledLayerNames = &Layer;
		Info.enabledExtensionCount = bValidation ? 1 : 0;
		Info.ppEnabledExtensionNames = &Extension;
		const bool bMade = Get<PFN_vkCreateInstance>("vkCreateInstance")(&Info, nullptr, &Instance) == VK_SUCCESS;
		return bMade && (!bValidation || CreateMessenger());
	}
	/// Collects the layers' messages in Messages.
	bool CreateMessenger()
	{
		VkDebugUtilsMessengerCreateInfoEXT Info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
		Info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
		Info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
		Info.pUserData = &Messages;
		Info.pfnUserCallback = [](VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
		                           const VkDebugUtilsMessengerCallbackDataEXT* Data, void* User) -> VkBool32 {
			*static_cast<std::string*>(User) += Data->pMessage;
			return VK_FALSE;
		};
		const auto Create = Get<PFN_vkCreateDebugUtilsMessengerEXT>("vkCreateDebugUtilsMessengerEXT");
		return Create(Instance, &Info, nullptr, &Messenger) == VK_SUCCESS;
	}

	/// The physical device of this name.
	bool FindPhysical(const char* Name)
	{
		VkPhysicalDevice List[16];
		uint32_t Count = 16;
		Get<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices")(Instance, &Count, List);
		for (uint32_t Index = 0; Index < Count; ++Index)
		{
			VkPhysicalDeviceProperties Properties;
			Get<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties")(List[Index], &Properties);
			Physical = strcmp(Properties.deviceName, Name) == 0 ? List[Index] : Physical;
		}
		return Physical != VK_NULL_HANDLE;
	}

	bool CreateDevice(const void* Features, uint32_t ExtensionCount, const char* const* Extensions,
	    const VkPhysicalDeviceFeatures* EnabledFeatures = nullptr)
	{
		const float Priority = 1;
		VkDeviceQueueCreateInfo QueueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
		QueueInfo.queueCount = 1;
		QueueInfo.pQueuePriorities = &Priority;
		VkDeviceCreateInfo Info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, Features};
		Info.queueCreateInfoCount = 1;
		Info.pQueueCreateInfos = &QueueInfo;
		Info.enabledExtensionCount = ExtensionCount;
		Info.ppEnabledExtensionNames = Extensions;
		Info.pEnabledFeatures = EnabledFeatures;
		if (Get<PFN_vkCreateDevice>("vkCreateDevice")(Physical, &Info, nullptr, &Device) != VK_SUCCESS) { return false; }
		Get<PFN_vkGetDeviceQueue>("vkGetDeviceQueue")(Device, 0, 0, &Queue);
		return true;
	}

	FRTVulkanRequirementsDesc DescribeRequirements() const
	{
		FRTVulkanRequirementsDesc Desc;
		Desc.Instance = Instance;
		Desc.InstanceVersion = VK_API_VERSION_1_3;
		Desc.PhysicalDevice = Physical;
		return Desc;
	}

	FRTVulkanExternalDesc Describe(const IRTVulkanRequirements* Requirements)
	{
		FRTVulkanExternalDesc Desc;
		Desc.Instance = Instance;
		Desc.PhysicalDevice = Physical;
		Desc.Device = Device;
		Desc.Queue = Queue;
		Desc.GetInstanceProcAddr = GetProc;
		Desc.Requirements = Requirements;
		Desc.bCountValidation = bValidation;
		return Desc;
	}

	/// A command buffer that the engine is recording.
	VkCommandBuffer BeginCommands()
	{
		VkCommandPoolCreateInfo PoolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
		Get<PFN_vkCreateCommandPool>("vkCreateCommandPool")(Device, &PoolInfo, nullptr, &Pool);
		VkCommandBufferAllocateInfo BufferInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
		BufferInfo.commandPool = Pool;
		BufferInfo.commandBufferCount = 1;
		VkCommandBuffer Commands = VK_NULL_HANDLE;
		Get<PFN_vkAllocateCommandBuffers>("vkAllocateCommandBuffers")(Device, &BufferInfo, &Commands);
		VkCommandBufferBeginInfo BeginInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
		Get<PFN_vkBeginCommandBuffer>("vkBeginCommandBuffer")(Commands, &BeginInfo);
		return Commands;
	}

	void Submit(VkCommandBuffer Commands)
	{
		Get<PFN_vkEndCommandBuffer>("vkEndCommandBuffer")(Commands);
		VkSubmitInfo Info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
		Info.commandBufferCount = 1;
		Info.pCommandBuffers = &Commands;
		Get<PFN_vkQueueSubmit>("vkQueueSubmit")(Queue, 1, &Info, VK_NULL_HANDLE);
	}

	PFN_vkGetInstanceProcAddr GetProc = nullptr;
	VkCommandPool Pool = VK_NULL_HANDLE;
	VkInstance Instance = VK_NULL_HANDLE;
	VkPhysicalDevice Physical = VK_NULL_HANDLE;
	VkDevice Device = VK_NULL_HANDLE;
	VkQueue Queue = VK_NULL_HANDLE;
	VkDebugUtilsMessengerEXT Messenger = VK_NULL_HANDLE;
	std::string Messages; ///< of validation
};

/// The engine has an instance and found the device; its own device is still to come.
inline void StartEngine(FEngine& Engine, const char* DeviceName)
{
	ASSERT_TRUE(Engine.CreateInstance());
	ASSERT_TRUE(Engine.FindPhysical(DeviceName));
}

/// As above, and makes the engine's device as the plugin requires it.
inline void StartEngine(FEngine& Engine, const char* DeviceName, TRTRef<IRTVulkanRequirements>& OutRequirements)
{
	ASSERT_NO_FATAL_FAILURE(StartEngine(Engine, DeviceName));
	ASSERT_OK(GetVulkanRequirements(Engine.DescribeRequirements(), OutRequirements.ReleaseAndGetAddress()));
	ASSERT_TRUE(
	    Engine.CreateDevice(OutRequirements->MergeFeatures(), OutRequirements->GetExtensionCount(), OutRequirements->GetExtensions()));
}

} // namespace Lantern
