// The device: what the objects share, the queue's timeline, and the garbage that waits for it.
#pragma once

#include "Commands/VulkanScatter.h"
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

/// A queue and its timeline. Values on it are numbers that the device gives to its submissions, on whichever queue.
struct FVulkanQueue
{
	struct FLock
	{
		void (*Lock)(void*) = nullptr;
		void (*Unlock)(void*) = nullptr;
		void* User = nullptr;
	};

	VkQueue Handle = VK_NULL_HANDLE; ///< null: the device has no such queue
	uint32_t Family = 0;
	FLock Lock; ///< may be empty
	VkSemaphore Timeline = VK_NULL_HANDLE;
	std::atomic<uint64_t> LastSubmitted{0}, LastCompleted{0};
};

class FVulkanDevice final : public TRefCounted<IRTDevice>
{
public:
	FVulkanDevice(
	    std::unique_ptr<FVulkanInstance> InInstance, VkPhysicalDevice InPhysical, const FVulkanProbe& InProbe, const char* CacheFile);

	/// Creates the VkDevice that the probe describes.
	FRTStatus CreateNative();
	/// Takes an engine's device and queues.
	FRTStatus AdoptNative(const FRTVulkanExternalDesc& Desc);

	// IRTDevice
	uint32_t GetVersion() const override { return RHIVersion; }
	const FRTCapabilities& GetCapabilities() const override { return Probe.Capabilities; }
	FRTStatus CreateBuffer(const FRTBufferDesc& Desc, IRTBuffer** Out) override;
	FRTStatus CreateTexture(const FRTTextureDesc& Desc, IRTTexture** Out) override;
	FRTStatus ImportBuffer(const FRTBufferDesc& Desc, const FRTNativeBuffer& Native, IRTBuffer** Out) override;
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
	FRTStatus CreateCommandList(const char* Name, IRTCommandList** Out, ERTQueue Queue) override;
	FRTStatus ImportCommandList(uint64_t NativeCommandBuffer, IRTCommandList** Out) override;
	FRTStatus Submit(IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits, uint32_t WaitCount) override;
	FRTStatus NotifyExternalSubmit(
	    IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits, uint32_t WaitCount) override;
	FRTFence GetCompletedFence(ERTQueue Queue) override;
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
	FVulkanScatter Scatter;
	FVulkanQueue Queues[QueueCount];       ///< by ERTQueue
	std::vector<uint32_t> QueueFamilies;   ///< each once; buffers are shared by all of them
	std::vector<uint32_t> TextureFamilies; ///< each once; textures are shared by those that take shaders
	uint32_t TimestampBits = 0;
	bool bCacheLibraries = true;
	FRTVulkanCallSink CallSink;

private:
	~FVulkanDevice() override;
	void OnFinalRelease() override;

	FRTStatus CreateShared();
	FRTStatus CreateTimelines();
	FVulkanQueue& GetQueue(ERTQueue Queue) { return Queues[static_cast<size_t>(Queue)]; }
	/// SubmitMutex must be held.
	VkResult SubmitBatch(
	    FVulkanQueue& Queue, const std::vector<VkCommandBufferSubmitInfo>& Buffers, const std::vector<VkSemaphoreSubmitInfo>& Waits);
	/// Reads how far the queue has come.
	uint64_t Poll(FVulkanQueue& Queue);
	/// The submissions up to this number have finished, on whichever queue.
	uint64_t PollAll();
	std::vector<VkSemaphoreSubmitInfo> MakeWaits(const FRTFence* Waits, uint32_t WaitCount) const;
	FRTStatus SubmitLists(
	    IRTCommandList* const* Lists, uint32_t Count, bool bExternal, FRTFence* OutFence, const std::vector<VkSemaphoreSubmitInfo>& Waits);
	void CollectUpTo(uint64_t Done);
	void CollectAll();

	bool bOwned = false;
	std::mutex SubmitMutex;
	std::atomic<uint64_t> LastNumber{0}; ///< of the last submission on any queue
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
