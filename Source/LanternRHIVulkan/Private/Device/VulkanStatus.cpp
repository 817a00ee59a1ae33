// Results of Vulkan as FRTStatus.
#include "Device/VulkanStatus.h"

#include <cstdio>

namespace Lantern
{

const char* ToString(VkResult Result)
{
	switch (Result)
	{
#define LANTERN_VK_CASE(Value)                                                                                                             \
	case Value: return #Value;
		LANTERN_VK_CASE(VK_SUCCESS)
		LANTERN_VK_CASE(VK_NOT_READY)
		LANTERN_VK_CASE(VK_TIMEOUT)
		LANTERN_VK_CASE(VK_INCOMPLETE)
		LANTERN_VK_CASE(VK_ERROR_OUT_OF_HOST_MEMORY)
		LANTERN_VK_CASE(VK_ERROR_OUT_OF_DEVICE_MEMORY)
		LANTERN_VK_CASE(VK_ERROR_INITIALIZATION_FAILED)
		LANTERN_VK_CASE(VK_ERROR_DEVICE_LOST)
		LANTERN_VK_CASE(VK_ERROR_MEMORY_MAP_FAILED)
		LANTERN_VK_CASE(VK_ERROR_LAYER_NOT_PRESENT)
		LANTERN_VK_CASE(VK_ERROR_EXTENSION_NOT_PRESENT)
		LANTERN_VK_CASE(VK_ERROR_FEATURE_NOT_PRESENT)
		LANTERN_VK_CASE(VK_ERROR_INCOMPATIBLE_DRIVER)
		LANTERN_VK_CASE(VK_ERROR_TOO_MANY_OBJECTS)
		LANTERN_VK_CASE(VK_ERROR_FORMAT_NOT_SUPPORTED)
		LANTERN_VK_CASE(VK_ERROR_FRAGMENTED_POOL)
		LANTERN_VK_CASE(VK_ERROR_FRAGMENTATION)
		LANTERN_VK_CASE(VK_ERROR_OUT_OF_POOL_MEMORY)
		LANTERN_VK_CASE(VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS)
		LANTERN_VK_CASE(VK_ERROR_INVALID_SHADER_NV)
		LANTERN_VK_CASE(VK_PIPELINE_COMPILE_REQUIRED)
		LANTERN_VK_CASE(VK_ERROR_UNKNOWN)
#undef LANTERN_VK_CASE
	default: break;
	}
	thread_local char Number[32];
	snprintf(Number, sizeof(Number), "VkResult %d", static_cast<int>(Result));
	return Number;
}

std::string Show(std::string_view Text, ERTTextKind Kind)
{
	std::string Shown;
	ShowText(Text.data(), Text.size(), Kind, [&](const char* Bytes, size_t Count) { Shown.append(Bytes, Count); });
	return Shown;
}

FRTStatus MakeStatus(VkResult Result, const char* What, const char* Name)
{
	ERTResult Code = ERTResult::Unsupported;
	switch (Result)
	{
	case VK_SUCCESS: return {};
	case VK_ERROR_OUT_OF_HOST_MEMORY: Code = ERTResult::OutOfHostMemory; break;
	case VK_ERROR_OUT_OF_DEVICE_MEMORY:
	case VK_ERROR_MEMORY_MAP_FAILED:
	case VK_ERROR_TOO_MANY_OBJECTS: Code = ERTResult::OutOfDeviceMemory; break;
	case VK_ERROR_FRAGMENTED_POOL:
	case VK_ERROR_FRAGMENTATION:
	case VK_ERROR_OUT_OF_POOL_MEMORY: Code = ERTResult::OutOfDescriptors; break;
	case VK_ERROR_DEVICE_LOST: Code = ERTResult::DeviceLost; break;
	case VK_ERROR_INVALID_SHADER_NV: Code = ERTResult::CompileFailed; break;
	case VK_TIMEOUT: Code = ERTResult::Timeout; break;
	default: break;
	}
	return FRTStatus::Error(Code, "%s '%s': %s", What, FRTShown(Name).Text, ToString(Result));
}

} // namespace Lantern
