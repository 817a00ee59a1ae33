// A VkInstance, ours or the engine's, and the messages of its validation.
#pragma once

#include "Device/VulkanApi.h"
#include "LanternRHIVulkan/VulkanDevice.h"

#include <atomic>
#include <memory>
#include <vector>

namespace Lantern
{

class FVulkanInstance
{
public:
	FVulkanInstance() = default;
	FVulkanInstance(const FVulkanInstance&) = delete;
	FVulkanInstance& operator=(const FVulkanInstance&) = delete;
	~FVulkanInstance();

	struct FOptions
	{
		bool bValidation = false;
		bool bSynchronizationValidation = false;
		FRTVulkanMessageCallback Callback = nullptr;
		void* CallbackUser = nullptr;
	};

	FRTStatus Create(const FOptions& Options);
	/// Takes the engine's instance, which stays the engine's. bValidation: listen to its messages.
	FRTStatus Adopt(VkInstance Instance, PFN_vkGetInstanceProcAddr GetInstanceProcAddr, const FOptions& Options);

	std::vector<VkPhysicalDevice> GetPhysicalDevices() const;
	uint32_t GetMessageCount() const { return MessageCount.load(); }
	void Report(ERTVulkanMessage Severity, const char* Text) const;

	VkInstance Handle = VK_NULL_HANDLE;
	FVulkanInstanceApi Api;
	/// VK_EXT_debug_utils is enabled, so that names and labels may be given.
	bool bDebugUtils = false;

private:
	FRTStatus CheckLayers(
	    const FVulkanLoader& Loader, const FOptions& Options, std::vector<const char*>& Layers, std::vector<const char*>& Extensions);
	FRTStatus CreateMessenger();

	static VKAPI_ATTR VkBool32 VKAPI_CALL OnMessage(VkDebugUtilsMessageSeverityFlagBitsEXT Severity, VkDebugUtilsMessageTypeFlagsEXT Types,
	    const VkDebugUtilsMessengerCallbackDataEXT* Data, void* User);

	bool bOwned = false;
	VkDebugUtilsMessengerEXT Messenger = VK_NULL_HANDLE;
	FOptions Settings;
	std::atomic<uint32_t> MessageCount{0};
};

} // namespace Lantern
