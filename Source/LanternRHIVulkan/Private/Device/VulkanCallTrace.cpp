// Functions of Vulkan with a clock around them, one for each function of the table.
#include "Device/VulkanCallTrace.h"

#include <atomic>
#include <chrono>
#include <cstring>

namespace Lantern
{

namespace
{
/// Functions of a device that VMA calls and our table does not have.
#define LANTERN_VK_MEMORY_FUNCTIONS(X)                                                                                                     \
	X(AllocateMemory)                                                                                                                      \
	X(FreeMemory)                                                                                                                          \
	X(MapMemory)                                                                                                                           \
	X(UnmapMemory)                                                                                                                         \
	X(FlushMappedMemoryRanges)                                                                                                             \
	X(InvalidateMappedMemoryRanges)                                                                                                        \
	X(BindBufferMemory)                                                                                                                    \
	X(BindBufferMemory2)                                                                                                                   \
	X(BindImageMemory)                                                                                                                     \
	X(BindImageMemory2)                                                                                                                    \
	X(CreateBuffer)                                                                                                                        \
	X(DestroyBuffer)                                                                                                                       \
	X(CreateImage)                                                                                                                         \
	X(DestroyImage)

std::atomic<void (*)(void*, const char*, uint64_t)> SinkCall{nullptr};
std::atomic<void*> SinkUser{nullptr};
PFN_vkGetDeviceProcAddr OriginalGetDeviceProcAddr = nullptr;

class FCallTimer
{
public:
	explicit FCallTimer(const char* InName) : Name(InName), Start(FClock::now()) {}
	~FCallTimer()
	{
		const auto Duration = std::chrono::duration_cast<std::chrono::nanoseconds>(FClock::now() - Start);
		SinkCall.load(std::memory_order_relaxed)(SinkUser.load(std::memory_order_relaxed), Name, static_cast<uint64_t>(Duration.count()));
	}
	FCallTimer(const FCallTimer&) = delete;
	FCallTimer& operator=(const FCallTimer&) = delete;

private:
	using FClock = std::chrono::steady_clock;
	const char* Name;
	FClock::time_point Start;
};

// The functions of the instance's table, which serve every device: a wrapper has no place for one of a device's own.
#define LANTERN_VK_CALL(Function)                                                                                                          \
	struct FCall##Function                                                                                                                 \
	{                                                                                                                                      \
		static constexpr const char* Name = "vk" #Function;                                                                                \
		static inline PFN_vk##Function Original = nullptr;                                                                                 \
	};
LANTERN_VK_DEVICE_FUNCTIONS(LANTERN_VK_CALL)
LANTERN_VK_ACCEL_FUNCTIONS(LANTERN_VK_CALL)
LANTERN_VK_PIPELINE_FUNCTIONS(LANTERN_VK_CALL)
LANTERN_VK_MEMORY_FUNCTIONS(LANTERN_VK_CALL)
#undef LANTERN_VK_CALL

template <class TCall, class TFunction>
struct TTimed;

template <class TCall, class TResult, class... TArguments>
struct TTimed<TCall, TResult(VKAPI_PTR*)(TArguments...)>
{
	static VKAPI_ATTR TResult VKAPI_CALL Run(TArguments... Arguments)
	{
		const FCallTimer Timer(TCall::Name);
		return TCall::Original(Arguments...);
	}
};

template <class TCall, class TFunction>
TFunction Wrap(const FVulkanInstanceApi& Instance, VkInstance Handle, TFunction Function)
{
	TCall::Original = reinterpret_cast<TFunction>(Instance.GetInstanceProcAddr(Handle, TCall::Name));
	return Function && TCall::Original ? &TTimed<TCall, TFunction>::Run : Function;
}
} // namespace

void TraceVulkanCalls(const FVulkanInstanceApi& Instance, VkInstance Handle, const FRTVulkanCallSink& Sink, FVulkanDeviceApi& Api)
{
	SinkUser = Sink.User;
	SinkCall = Sink.Call;
	OriginalGetDeviceProcAddr = Instance.GetDeviceProcAddr;
#define LANTERN_VK_WRAP(Function) Api.Function = Wrap<FCall##Function>(Instance, Handle, Api.Function);
	LANTERN_VK_DEVICE_FUNCTIONS(LANTERN_VK_WRAP)
	LANTERN_VK_ACCEL_FUNCTIONS(LANTERN_VK_WRAP)
	LANTERN_VK_PIPELINE_FUNCTIONS(LANTERN_VK_WRAP)
#undef LANTERN_VK_WRAP
#define LANTERN_VK_LOAD(Function)                                                                                                          \
	FCall##Function::Original = reinterpret_cast<PFN_vk##Function>(Instance.GetInstanceProcAddr(Handle, "vk" #Function));
	LANTERN_VK_MEMORY_FUNCTIONS(LANTERN_VK_LOAD)
#undef LANTERN_VK_LOAD
}

PFN_vkVoidFunction VKAPI_CALL GetTracedDeviceProcAddr(VkDevice Device, const char* Name)
{
#define LANTERN_VK_FIND(Function)                                                                                                          \
	if (strcmp(Name, "vk" #Function) == 0 && FCall##Function::Original)                                                                    \
	{                                                                                                                                      \
		return reinterpret_cast<PFN_vkVoidFunction>(&TTimed<FCall##Function, PFN_vk##Function>::Run);                                      \
	}
	LANTERN_VK_MEMORY_FUNCTIONS(LANTERN_VK_FIND)
#undef LANTERN_VK_FIND
	return OriginalGetDeviceProcAddr(Device, Name);
}

} // namespace Lantern
