// The engine's Vulkan instance, device, images and buffers.
#include "Example/ForkVulkan.h"

#include <array>
#include <cstdio>
#include <cstring>

namespace Fork
{

namespace
{

constexpr const char* ValidationLayer = "VK_LAYER_KHRONOS_validation";

FError Check(VkResult Result, const char* What)
{
	return Result == VK_SUCCESS ? FError() : FError(What) + " failed with " + std::to_string(Result);
}

bool IsLayerInstalled(const char* Name)
{
	uint32_t Count = 0;
	vkEnumerateInstanceLayerProperties(&Count, nullptr);
	std::vector<VkLayerProperties> Layers(Count);
	vkEnumerateInstanceLayerProperties(&Count, Layers.data());
	for (const VkLayerProperties& Layer : Layers)
	{
		if (std::strcmp(Layer.layerName, Name) == 0) { return true; }
	}
	return false;
}

VKAPI_ATTR VkBool32 VKAPI_CALL CountMessage(
    VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT, const VkDebugUtilsMessengerCallbackDataEXT* Data, void* User)
{
	++static_cast<FForkInstance*>(User)->ValidationMessages;
	std::fprintf(stderr, "validation: %s\n", Show(Data->pMessage).c_str());
	return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT DescribeMessenger(FForkInstance* Owner)
{
	VkDebugUtilsMessengerCreateInfoEXT Info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
	Info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
	Info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
	Info.pfnUserCallback = CountMessage;
	Info.pUserData = Owner;
	return Info;
}

uint32_t FindGraphicsFamily(VkPhysicalDevice Physical)
{
	uint32_t Count = 0;
	vkGetPhysicalDeviceQueueFamilyProperties(Physical, &Count, nullptr);
	std::vector<VkQueueFamilyProperties> Families(Count);
	vkGetPhysicalDeviceQueueFamilyProperties(Physical, &Count, Families.data());
	constexpr VkQueueFlags Needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		if ((Families[Index].queueFlags & Needed) == Needed) { return Index; }
	}
	return ~0u;
}

} // namespace

// ---------------------------------------------------------------------------------------------------- instance

FError FForkInstance::Create()
{
	bValidation = IsLayerInstalled(ValidationLayer);
	VkApplicationInfo Application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
	Application.pApplicationName = "EngineFork";
	Application.apiVersion = Version;
	const VkDebugUtilsMessengerCreateInfoEXT MessengerInfo = DescribeMessenger(this);
	const char* Extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
	VkInstanceCreateInfo Info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
	Info.pApplicationInfo = &Application;
	if (bValidation)
	{
		Info.pNext = &MessengerInfo;
		Info.enabledLayerCount = 1;
		Info.ppEnabledLayerNames = &ValidationLayer;
		Info.enabledExtensionCount = 1;
		Info.ppEnabledExtensionNames = &Extension;
	}
	if (const FError Error = Check(vkCreateInstance(&Info, nullptr, &Instance), "vkCreateInstance"); !Error.empty()) { return Error; }
	if (bValidation)
	{
		const auto CreateMessenger =
		    reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(Instance, "vkCreateDebugUtilsMessengerEXT"));
		return Check(CreateMessenger(Instance, &MessengerInfo, nullptr, &Messenger), "vkCreateDebugUtilsMessengerEXT");
	}
	return {};
}

FForkInstance::~FForkInstance()
{
	if (Messenger != VK_NULL_HANDLE)
	{
		const auto DestroyMessenger =
		    reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(Instance, "vkDestroyDebugUtilsMessengerEXT"));
		DestroyMessenger(Instance, Messenger, nullptr);
	}
	vkDestroyInstance(Instance, nullptr);
}

std::vector<VkPhysicalDevice> FForkInstance::ListDevices() const
{
	uint32_t Count = 0;
	vkEnumeratePhysicalDevices(Instance, &Count, nullptr);
	std::vector<VkPhysicalDevice> Devices(Count);
	vkEnumeratePhysicalDevices(Instance, &Count, Devices.data());
	return Devices;
}

// ---------------------------------------------------------------------------------------------------- device

FForkFeatures::FForkFeatures()
{
	DepthClip.depthClipEnable = VK_TRUE;
	Vulkan12.pNext = &DepthClip;
	Vulkan12.bufferDeviceAddress = VK_TRUE;
	Vulkan12.scalarBlockLayout = VK_TRUE;
	Vulkan13.pNext = &Vulkan12;
	Vulkan13.dynamicRendering = VK_TRUE;
	Vulkan13.synchronization2 = VK_TRUE;
	Core.pNext = &Vulkan13;
}

FError FForkDevice::Create(VkPhysicalDevice InPhysical, const FForkDeviceLists& Lists)
{
	Physical = InPhysical;
	QueueFamily = FindGraphicsFamily(Physical);
	if (QueueFamily == ~0u) { return "the device has no graphics queue"; }
	const float Priority = 1.0f;
	VkDeviceQueueCreateInfo QueueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
	QueueInfo.queueFamilyIndex = QueueFamily;
	QueueInfo.queueCount = 1;
	QueueInfo.pQueuePriorities = &Priority;

	VkDeviceCreateInfo Info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, Lists.Features};
	Info.queueCreateInfoCount = 1;
	Info.pQueueCreateInfos = &QueueInfo;
	Info.enabledExtensionCount = static_cast<uint32_t>(Lists.Extensions.size());
	Info.ppEnabledExtensionNames = Lists.Extensions.data();
	if (FError Error = Check(vkCreateDevice(Physical, &Info, nullptr, &Device), "vkCreateDevice"); !Error.empty()) { return Error; }
	vkGetDeviceQueue(Device, QueueFamily, 0, &Queue);

	const VkCommandPoolCreateInfo PoolInfo{
	    VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT, QueueFamily};
	vkCreateCommandPool(Device, &PoolInfo, nullptr, &Pool);
	const VkCommandBufferAllocateInfo CommandsInfo{
	    VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, Pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
	vkAllocateCommandBuffers(Device, &CommandsInfo, &Commands);
	const VkFenceCreateInfo FenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
	return Check(vkCreateFence(Device, &FenceInfo, nullptr, &Fence), "vkCreateFence");
}

FForkDevice::~FForkDevice()
{
	if (Device != VK_NULL_HANDLE)
	{
		vkDeviceWaitIdle(Device);
		vkDestroyFence(Device, Fence, nullptr);
		vkDestroyCommandPool(Device, Pool, nullptr);
		vkDestroyDevice(Device, nullptr);
	}
}

FError FForkDevice::BeginCommands()
{
	const VkCommandBufferBeginInfo Info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
	return Check(vkBeginCommandBuffer(Commands, &Info), "vkBeginCommandBuffer");
}

FError FForkDevice::Submit()
{
	if (FError Error = Check(vkEndCommandBuffer(Commands), "vkEndCommandBuffer"); !Error.empty()) { return Error; }
	VkSubmitInfo Info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
	Info.commandBufferCount = 1;
	Info.pCommandBuffers = &Commands;
	std::lock_guard Lock(QueueMutex);
	return Check(vkQueueSubmit(Queue, 1, &Info, Fence), "vkQueueSubmit");
}

FError FForkDevice::WaitForSubmit()
{
	constexpr uint64_t Patience = 600'000'000'000; // ns: ends what hangs, and decides nothing else
	const VkResult Result = vkWaitForFences(Device, 1, &Fence, VK_TRUE, Patience);
	vkResetFences(Device, 1, &Fence);
	return Check(Result, "vkWaitForFences");
}

uint32_t FForkDevice::FindMemory(uint32_t Allowed, VkMemoryPropertyFlags Wanted) const
{
	VkPhysicalDeviceMemoryProperties Properties;
	vkGetPhysicalDeviceMemoryProperties(Physical, &Properties);
	for (uint32_t Index = 0; Index < Properties.memoryTypeCount; ++Index)
	{
		if ((Allowed >> Index & 1) != 0 && (Properties.memoryTypes[Index].propertyFlags & Wanted) == Wanted) { return Index; }
	}
	return ~0u;
}

// ---------------------------------------------------------------------------------------------------- resources

FError FForkImage::Create(const FForkDevice& Owner, VkExtent2D Size, VkFormat Format, VkImageUsageFlags Usage, VkImageAspectFlags Aspect)
{
	Device = Owner.Device;
	VkImageCreateInfo Info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
	Info.imageType = VK_IMAGE_TYPE_2D;
	Info.format = Format;
	Info.extent = {Size.width, Size.height, 1};
	Info.mipLevels = 1;
	Info.arrayLayers = 1;
	Info.samples = VK_SAMPLE_COUNT_1_BIT;
	Info.usage = Usage;
	if (FError Error = Check(vkCreateImage(Device, &Info, nullptr, &Image), "vkCreateImage"); !Error.empty()) { return Error; }
	VkMemoryRequirements Needs;
	vkGetImageMemoryRequirements(Device, Image, &Needs);
	const VkMemoryAllocateInfo Allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, Needs.size,
	    Owner.FindMemory(Needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)};
	if (FError Error = Check(vkAllocateMemory(Device, &Allocation, nullptr, &Memory), "vkAllocateMemory"); !Error.empty()) { return Error; }
	vkBindImageMemory(Device, Image, Memory, 0);
	VkImageViewCreateInfo ViewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
	ViewInfo.image = Image;
	ViewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
	ViewInfo.format = Format;
	ViewInfo.subresourceRange = {Aspect, 0, 1, 0, 1};
	if (FError Error = Check(vkCreateImageView(Device, &ViewInfo, nullptr, &View), "vkCreateImageView"); !Error.empty()) { return Error; }
	ReadView = View;
	if ((Aspect & VK_IMAGE_ASPECT_STENCIL_BIT) == 0) { return {}; }
	ViewInfo.subresourceRange.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
	return Check(vkCreateImageView(Device, &ViewInfo, nullptr, &ReadView), "vkCreateImageView");
}

FForkImage::~FForkImage()
{
	if (Device != VK_NULL_HANDLE)
	{
		if (ReadView != View) { vkDestroyImageView(Device, ReadView, nullptr); }
		vkDestroyImageView(Device, View, nullptr);
		vkDestroyImage(Device, Image, nullptr);
		vkFreeMemory(Device, Memory, nullptr);
	}
}

FError FForkBuffer::Create(const FForkDevice& Owner, VkDeviceSize Size, VkBufferUsageFlags Usage)
{
	Device = Owner.Device;
	VkBufferCreateInfo Info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
	Info.size = Size;
	Info.usage = Usage;
	if (FError Error = Check(vkCreateBuffer(Device, &Info, nullptr, &Buffer), "vkCreateBuffer"); !Error.empty()) { return Error; }
	VkMemoryRequirements Needs;
	vkGetBufferMemoryRequirements(Device, Buffer, &Needs);
	constexpr VkMemoryPropertyFlags Visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
	VkMemoryAllocateFlagsInfo Flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO};
	Flags.flags = Usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT ? VkMemoryAllocateFlags(VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT) : 0;
	const VkMemoryAllocateInfo Allocation{
	    VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &Flags, Needs.size, Owner.FindMemory(Needs.memoryTypeBits, Visible)};
	if (FError Error = Check(vkAllocateMemory(Device, &Allocation, nullptr, &Memory), "vkAllocateMemory"); !Error.empty()) { return Error; }
	vkBindBufferMemory(Device, Buffer, Memory, 0);
	return Check(vkMapMemory(Device, Memory, 0, VK_WHOLE_SIZE, 0, &Mapped), "vkMapMemory");
}

VkDeviceAddress FForkBuffer::GetAddress() const
{
	VkBufferDeviceAddressInfo Info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
	Info.buffer = Buffer;
	return vkGetBufferDeviceAddress(Device, &Info);
}

FForkBuffer::~FForkBuffer()
{
	if (Device != VK_NULL_HANDLE)
	{
		vkDestroyBuffer(Device, Buffer, nullptr);
		vkFreeMemory(Device, Memory, nullptr);
	}
}

FError CreateComputePipeline(VkDevice Device, const FForkShader& Shader, VkPipelineLayout Layout, VkPipeline& Out)
{
	VkShaderModuleCreateInfo ModuleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
	ModuleInfo.codeSize = Shader.Bytes;
	ModuleInfo.pCode = Shader.Words;
	VkComputePipelineCreateInfo Info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
	Info.stage = {
	    VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, VK_SHADER_STAGE_COMPUTE_BIT, VK_NULL_HANDLE, "main", nullptr};
	vkCreateShaderModule(Device, &ModuleInfo, nullptr, &Info.stage.module);
	Info.layout = Layout;
	const VkResult Result = vkCreateComputePipelines(Device, VK_NULL_HANDLE, 1, &Info, nullptr, &Out);
	vkDestroyShaderModule(Device, Info.stage.module, nullptr);
	return Check(Result, "vkCreateComputePipelines");
}

void Transition(VkCommandBuffer Commands, VkImage Image, VkImageAspectFlags Aspect, VkImageLayout From, VkImageLayout To)
{
	VkImageMemoryBarrier2 Barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
	Barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
	Barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
	Barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
	Barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
	Barrier.oldLayout = From;
	Barrier.newLayout = To;
	Barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
	Barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
	Barrier.image = Image;
	Barrier.subresourceRange = {Aspect, 0, 1, 0, 1};
	VkDependencyInfo Info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
	Info.imageMemoryBarrierCount = 1;
	Info.pImageMemoryBarriers = &Barrier;
	vkCmdPipelineBarrier2(Commands, &Info);
}

} // namespace Fork
