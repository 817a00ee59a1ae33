// FVulkanInstance: creation, take-over, and messages of the validation layers.
#include "Device/VulkanInstance.h"

#include "Device/VulkanStatus.h"

#include <cstdio>
#include <cstring>

namespace Lantern
{

namespace
{

constexpr const char* ValidationLayer = "VK_LAYER_KHRONOS_validation";

} // namespace

FVulkanInstance::~FVulkanInstance()
{
	if (Messenger) { Api.DestroyDebugUtilsMessengerEXT(Handle, Messenger, nullptr); }
	if (bOwned && Handle) { Api.DestroyInstance(Handle, nullptr); }
}

void FVulkanInstance::Report(ERTVulkanMessage Severity, const char* Text) const
{
	// Layers and drivers write these texts, with names of objects in them.
	const std::string Shown = Show(Text, ERTTextKind::Lines);
	if (Settings.Callback) { Settings.Callback(Settings.CallbackUser, Severity, Shown.c_str()); }
	else if (Severity != ERTVulkanMessage::Info)
	{
		fprintf(stderr, "Vulkan: %s: %s\n", Severity == ERTVulkanMessage::Error ? "error" : "warning", Shown.c_str());
	}
}

VkBool32 FVulkanInstance::OnMessage(VkDebugUtilsMessageSeverityFlagBitsEXT Severity, VkDebugUtilsMessageTypeFlagsEXT Types,
    const VkDebugUtilsMessengerCallbackDataEXT* Data, void* User)
{
	// The loader reports drivers that it could not open as general messages: no fault of ours.
	if (!(Types & VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT)) { return VK_FALSE; }
	FVulkanInstance* Self = static_cast<FVulkanInstance*>(User);
	Self->MessageCount.fetch_add(1);
	Self->Report(Severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT ? ERTVulkanMessage::Error : ERTVulkanMessage::Warning,
	    Data->pMessage ? Data->pMessage : "");
	return VK_FALSE;
}

FRTStatus FVulkanInstance::CheckLayers(
    const FVulkanLoader& Loader, const FOptions& Options, std::vector<const char*>& Layers, std::vector<const char*>& Extensions)
{
	const auto HasExtension = [&](const char* Layer, const char* Name) {
		uint32_t Count = 0;
		Loader.EnumerateInstanceExtensionProperties(Layer, &Count, nullptr);
		std::vector<VkExtensionProperties> List(Count);
		Loader.EnumerateInstanceExtensionProperties(Layer, &Count, List.data());
		for (const VkExtensionProperties& Item : List)
		{
			if (strcmp(Item.extensionName, Name) == 0) { return true; }
		}
		return false;
	};
	bDebugUtils = HasExtension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
	if (Options.bValidation)
	{
		uint32_t Count = 0;
		Loader.EnumerateInstanceLayerProperties(&Count, nullptr);
		std::vector<VkLayerProperties> List(Count);
		Loader.EnumerateInstanceLayerProperties(&Count, List.data());
		for (const VkLayerProperties& Item : List)
		{
			if (strcmp(Item.layerName, ValidationLayer) == 0) { Layers.push_back(ValidationLayer); }
		}
		if (Layers.empty())
		{
			return FRTStatus::Error(ERTResult::Unsupported,
			    "%s is not installed (e.g. Debian's "
			    "vulkan-validationlayers).",
			    ValidationLayer);
		}
		bDebugUtils = bDebugUtils || HasExtension(ValidationLayer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
		if (Options.bSynchronizationValidation) { Extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME); }
	}
	if (bDebugUtils) { Extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME); }
	return {};
}

FRTStatus FVulkanInstance::Create(const FOptions& Options)
{
	Settings = Options;
	FVulkanLoader Loader;
	FRTStatus Status = OpenVulkanLoader(&Loader);
	if (!Status) { return Status; }
	uint32_t Version = VK_API_VERSION_1_0;
	if (Loader.EnumerateInstanceVersion) { Loader.EnumerateInstanceVersion(&Version); }
	if (Version < VK_API_VERSION_1_3)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "The Vulkan loader is of version %u.%u; 1.3 is needed.",
		    VK_API_VERSION_MAJOR(Version), VK_API_VERSION_MINOR(Version));
	}
	std::vector<const char*> Layers, Extensions;
	Status = CheckLayers(Loader, Options, Layers, Extensions);
	if (!Status) { return Status; }
	VkApplicationInfo App{VK_STRUCTURE_TYPE_APPLICATION_INFO};
	App.pApplicationName = "Lantern";
	App.pEngineName = "Lantern";
	App.apiVersion = VK_API_VERSION_1_3;
	const VkValidationFeatureEnableEXT Enable = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
	VkValidationFeaturesEXT Features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
	Features.enabledValidationFeatureCount = 1;
	Features.pEnabledValidationFeatures = &Enable;
	VkInstanceCreateInfo Info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
	Info.pNext = Options.bValidation && Options.bSynchronizationValidation ? &Features : nullptr;
	Info.pApplicationInfo = &App;
	Info.enabledLayerCount = static_cast<uint32_t>(Layers.size());
	Info.ppEnabledLayerNames = Layers.data();
	Info.enabledExtensionCount = static_cast<uint32_t>(Extensions.size());
	Info.ppEnabledExtensionNames = Extensions.data();
	const VkResult Result = Loader.CreateInstance(&Info, nullptr, &Handle);
	if (Result == VK_ERROR_INCOMPATIBLE_DRIVER)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "No Vulkan driver is installed (the loader finds none it can use).");
	}
	Status = MakeStatus(Result, "vkCreateInstance", "Lantern");
	if (!Status)
	{
		Handle = VK_NULL_HANDLE;
		return Status;
	}
	// DestroyInstance alone must be there before the rest may fail.
	Api.DestroyInstance = reinterpret_cast<PFN_vkDestroyInstance>(Loader.GetInstanceProcAddr(Handle, "vkDestroyInstance"));
	bOwned = true;
	Status = LoadInstanceApi(Loader.GetInstanceProcAddr, Handle, &Api);
	return Status && Options.bValidation ? CreateMessenger() : Status;
}

FRTStatus FVulkanInstance::Adopt(VkInstance Instance, PFN_vkGetInstanceProcAddr GetInstanceProcAddr, const FOptions& Options)
{
	Settings = Options;
	Handle = Instance;
	if (!GetInstanceProcAddr)
	{
		FVulkanLoader Loader;
		FRTStatus Status = OpenVulkanLoader(&Loader);
		if (!Status) { return Status; }
		GetInstanceProcAddr = Loader.GetInstanceProcAddr;
	}
	FRTStatus Status = LoadInstanceApi(GetInstanceProcAddr, Instance, &Api);
	if (!Status) { return Status; }
	// The loader gives these out only where the extension was enabled on the instance.
	bDebugUtils = Api.SetDebugUtilsObjectNameEXT && Api.CmdBeginDebugUtilsLabelEXT && Api.CmdEndDebugUtilsLabelEXT;
	return Options.bValidation ? CreateMessenger() : FRTStatus();
}

FRTStatus FVulkanInstance::CreateMessenger()
{
	if (!Api.CreateDebugUtilsMessengerEXT || !Api.DestroyDebugUtilsMessengerEXT)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "VK_EXT_debug_utils is not enabled on the instance: its "
		                                                "validation messages cannot be counted.");
	}
	VkDebugUtilsMessengerCreateInfoEXT Info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
	Info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
	Info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
	Info.pfnUserCallback = &FVulkanInstance::OnMessage;
	Info.pUserData = this;
	return MakeStatus(Api.CreateDebugUtilsMessengerEXT(Handle, &Info, nullptr, &Messenger), "vkCreateDebugUtilsMessengerEXT", "Lantern");
}

std::vector<VkPhysicalDevice> FVulkanInstance::GetPhysicalDevices() const
{
	uint32_t Count = 0;
	if (Api.EnumeratePhysicalDevices(Handle, &Count, nullptr) != VK_SUCCESS) { return {}; }
	std::vector<VkPhysicalDevice> Devices(Count);
	Api.EnumeratePhysicalDevices(Handle, &Count, Devices.data());
	Devices.resize(Count);
	return Devices;
}

} // namespace Lantern
