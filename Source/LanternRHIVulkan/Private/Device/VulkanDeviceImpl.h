// The device: what the objects share, the queue's timeline, and the garbage that waits for it.
#pragma once

#include "Device/VulkanCapabilities.h"
#include "Device/VulkanInstance.h"
#include "Device/VulkanMemory.h"
#include "Device/VulkanObject.h"
#include "Device/VulkanReaper.h"
#include "Device/VulkanStatus.h"
#include "Device/VulkanTranslate.h"
#include "LanternRHICommon/FenceQueue.h"
#include "LanternRHIVulkan/VulkanInterop.h"
#include "Pipelines/VulkanPipelineCache.h"
#include "Resources/VulkanBindless.h"
#include "ShaderTable/VulkanTableScatter.h"

#include <memory>
#include <unordered_set>

namespace Lantern
{

enum class EVulkanMemoryKind : uint32_t
{
	Geometry,
	Scene,
	ShaderTable,
	Texture,
	Buffer,
	Scratch,
	Count,
};

/// References that a submission holds until it has finished.
using FVulkanKept = std::unordered_set<IRTRefCounted*>;

class FVulkanDevice final : public TRefCounted<IRTDevice>
{
public:
	struct FQueueLock
	{
		void (*Lock)(void*) = nullptr;
		void (*Unlock)(void*) = nullptr;
		void* User = nullptr;
	};

	FVulkanDevice(
	    std::unique_ptr<FVulkanInstance> InInstance, VkPhysicalDevice InPhysical, const FVulkanProbe& InProbe, const char* CacheFile);

	/// Creates the VkDevice that the probe describes.
	FRTStatus CreateNative();
	FRTStatus CreateCompileDevice(const FRTVulkanDeviceDesc& Desc);
	/// Takes an engine's device. The lock may be empty.
	FRTStatus AdoptNative(VkDevice InDevice, VkQueue InQueue, uint32_t InFamily, const FQueueLock& InLock);

	// IRTDevice
	uint32_t GetVersion() const override { return RHIVersion; }
	const FRTCapabilities& GetCapabilities() const override { return Probe.Capabilities; }
	FRTStatus CreateBuffer(const FRTBufferDesc& Desc, IRTBuffer** Out) override;
	FRTStatus CreateTexture(const FRTTextureDesc& Desc, IRTTexture** Out) override;
	FRTStatus ImportTexture(const FRTTextureDesc& Desc, uint64_t NativeImage, IRTTexture** Out) override;
	FRTStatus CreateSampler(const FRTSamplerDesc& Desc, IRTSampler** Out) override;
	FRTStatus CreateComputePipeline(const FRTComputePipelineDesc& Desc, IRTPipeline** Out) override;
	FRTStatus CreateRasterPipeline(const FRTRasterPipelineDesc& Desc, IRTPipeline** Out) override;
	FRTStatus CreateRayTracingPipeline(const FRTRayTracingPipelineDesc& Desc, IRTPipeline** Out) override;
	FRTStatus CreateGeometry(const FRTGeometryDesc& Desc, IRTGeometry** Out) override;
	FRTBuildSizes GetGeometrySizes(const FRTGeometryDesc& Desc) override;
	FRTStatus CreateScene(const FRTSceneDesc& Desc, IRTScene** Out) override;
	FRTStatus CreateShaderTable(const FRTShaderTableDesc& Desc, IRTShaderTable** Out) override;
	FRTStatus CreateQueryPool(ERTQuery Kind, uint32_t Count, IRTQueryPool** Out) override;
	FRTStatus CreateCommandList(const char* Name, IRTCommandList** Out) override;
	FRTStatus ImportCommandList(uint64_t NativeCommandBuffer, IRTCommandList** Out) override;
	FRTStatus Submit(IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence) override;
	FRTStatus NotifyExternalSubmit(IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence) override;
	FRTFence GetCompletedFence() override;
	FRTStatus WaitFor(FRTFence Fence, uint64_t TimeoutNs) override;
	FRTStatus WaitIdle() override;
	void CollectGarbage() override;
	FRTMemoryStats GetMemoryStats() const override;
	uint32_t GetValidationMessageCount() const override { return Instance->GetMessageCount(); }
	uint64_t GetNative(ERTNative Kind) const override;

	// For the objects.
	/// Returns Result, and notes if the device is lost.
	VkResult Check(VkResult Result);
	bool IsLost() const { return bLost.load(std::memory_order_relaxed); }
	FRTStatus LostStatus() const;
	void Account(EVulkanMemoryKind Kind, int64_t Bytes);
	void SetName(VkObjectType Type, uint64_t Handle, const char* Name) const;
	void AddOne() { Children.fetch_add(1); }
	void DropOne();
	void Retire(const FVulkanGarbage& Item);
	FRTStatus SaveCache() { return Cache.Save(); }

	std::unique_ptr<FVulkanInstance> Instance;
	VkPhysicalDevice Physical = VK_NULL_HANDLE;
	VkDevice Handle = VK_NULL_HANDLE;
	FVulkanProbe Probe;
	FVulkanCapabilityBits Bits;
	FVulkanDeviceApi Api;
	FVulkanMemory Memory;
	FVulkanBindless Bindless;
	FVulkanPipelineCache Cache;
	FVulkanTableScatter Scatter;
	uint32_t QueueFamily = 0;
	uint32_t TimestampBits = 0;
	bool bCacheLibraries = true;
	FRTVulkanCallSink CallSink;
	FVulkanDevice* CompileDevice = nullptr; ///< FRTVulkanDeviceDesc::bCompileDevice; owned

private:
	~FVulkanDevice() override;
	void OnFinalRelease() override;

	FRTStatus CreateShared();
	/// SubmitMutex must be held.
	VkResult SubmitBatch(const std::vector<VkCommandBufferSubmitInfo>& Buffers);
	FRTStatus SubmitLists(IRTCommandList* const* Lists, uint32_t Count, bool bExternal, FRTFence* OutFence);
	void CollectUpTo(FRTFence Done);
	void CollectAll();

	bool bOwned = false;
	VkQueue Queue = VK_NULL_HANDLE;
	FQueueLock QueueLock;
	VkSemaphore Timeline = VK_NULL_HANDLE;
	std::mutex SubmitMutex;
	std::atomic<FRTFence> LastSubmitted{0};
	std::atomic<FRTFence> LastCompleted{0};
	std::atomic<bool> bLost{false};

	std::mutex GarbageMutex;
	TFenceQueue<FVulkanGarbage> Garbage;
	FVulkanReaper Reaper;
	TFenceQueue<FVulkanKept> Packets;

	/// The objects that are alive, plus one while the user holds a reference to the device.
	std::atomic<uint32_t> Children{1};

	std::atomic<int64_t> Bytes[static_cast<uint32_t>(EVulkanMemoryKind::Count)] = {};
	std::atomic<int64_t> TotalBytes{0};
	std::atomic<int64_t> PeakBytes{0};
};

template <class T>
uint64_t ToNative(T Handle)
{
	return (uint64_t)Handle; // a pointer or an integer, as the platform has it
}

} // namespace Lantern
