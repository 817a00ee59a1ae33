// FVulkanDevice: lifetime, the timeline of its queue, and creation of objects.
#include "Device/VulkanDeviceImpl.h"

#include "Commands/VulkanCommandList.h"
#include "Resources/VulkanImport.h"

#include <algorithm>
#include <cassert>

namespace Lantern
{
namespace
{

template <class T, class TInterface, class TInitialise>
FRTStatus CreateObject(FVulkanDevice& Device, TInterface** Out, TInitialise Initialise)
{
	*Out = nullptr;
	if (Device.IsLost()) { return Device.LostStatus(); }
	// AddRef and Release of TRTRef: a failed object goes the way of every released one.
	TRTRef<T> Object = MakeVulkanObject<T>(Device);
	FRTStatus Status = Initialise(*Object.Get());
	if (Status) { HandOut(Object, Out); }
	return Status;
}

} // namespace

void AddChild(FVulkanDevice& Device) { Device.AddOne(); }

void RetireChild(FVulkanDevice& Device, void* Object, void (*Delete)(void*), bool bSlow)
{
	Device.Retire({Object, Delete, bSlow});
	Device.DropOne();
}

FRTStatus SaveVulkanPipelineCache(IRTDevice* Device) { return static_cast<FVulkanDevice*>(Device)->SaveCache(); }

// ------------------------------------------------------------------------------------------------ lifetime

void FVulkanDevice::OnFinalRelease()
{
	// Submissions keep objects, and objects keep the device. No one is left to collect them later.
	(void)WaitIdle();
	CollectUpTo(IsLost() ? ~uint64_t(0) : PollAll());
	Reaper.Drain(); // or the last object would be released on the reaper's own thread
	DropOne();
}

void FVulkanDevice::DropOne()
{
	if (Children.fetch_sub(1) == 1)
	{
		// Objects deleted below release others, which must not come to this line again.
		Children.store(1u << 30);
		delete this;
	}
}

void FVulkanDevice::Retire(const FVulkanGarbage& Item)
{
	std::scoped_lock Lock(GarbageMutex);
	Garbage.Push(LastNumber.load(), Item);
}

void FVulkanDevice::CollectUpTo(uint64_t Done)
{
	for (;;)
	{
		std::vector<FVulkanGarbage> Dead;
		std::vector<FVulkanKept> Finished;
		{
			std::scoped_lock Lock(GarbageMutex);
			while (std::optional<FVulkanKept> Kept = Packets.Pop(Done)) { Finished.push_back(std::move(*Kept)); }
			while (const std::optional<FVulkanGarbage> Item = Garbage.Pop(Done)) { Dead.push_back(*Item); }
		}
		if (Dead.empty() && Finished.empty()) { return; }
		// Outside the lock: these calls release further objects.
		for (const FVulkanKept& Kept : Finished)
		{
			for (IRTRefCounted* Object : Kept) { Object->Release(); }
		}
		for (const FVulkanGarbage& Item : Dead)
		{
			// The caller may be a frame.
			if (Item.bSlow) { Reaper.Add(Item); }
			else { Item.Delete(Item.Object); }
		}
	}
}

void FVulkanDevice::CollectGarbage() { CollectUpTo(IsLost() ? 0 : PollAll()); }

// ------------------------------------------------------------------------------------------------ timeline

VkResult FVulkanDevice::Check(VkResult Result)
{
	if (Result == VK_ERROR_DEVICE_LOST && !bLost.exchange(true)) { Instance->Report(ERTVulkanMessage::Error, "the device was lost"); }
	return Result;
}

FRTStatus FVulkanDevice::LostStatus() const
{
	return FRTStatus::Error(ERTResult::DeviceLost, "The Vulkan device %s was lost.", Probe.Capabilities.DeviceName);
}

VkResult FVulkanDevice::SubmitBatch(
    FVulkanQueue& Queue, const std::vector<VkCommandBufferSubmitInfo>& Buffers, const std::vector<VkSemaphoreSubmitInfo>& Waits)
{
	VkSemaphoreSubmitInfo Signal{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
	Signal.semaphore = Queue.Timeline;
	Signal.value = LastNumber.load() + 1;
	Signal.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
	VkSubmitInfo2 Info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
	Info.commandBufferInfoCount = static_cast<uint32_t>(Buffers.size());
	Info.pCommandBufferInfos = Buffers.data();
	Info.waitSemaphoreInfoCount = static_cast<uint32_t>(Waits.size());
	Info.pWaitSemaphoreInfos = Waits.data();
	Info.signalSemaphoreInfoCount = 1;
	Info.pSignalSemaphoreInfos = &Signal;
	if (Queue.Lock.Lock) { Queue.Lock.Lock(Queue.Lock.User); }
	const VkResult Result = Check(Api.QueueSubmit2(Queue.Handle, 1, &Info, VK_NULL_HANDLE));
	if (Queue.Lock.Unlock) { Queue.Lock.Unlock(Queue.Lock.User); }
	if (Result == VK_SUCCESS)
	{
		Queue.LastSubmitted.store(Signal.value);
		LastNumber.store(Signal.value); // second: PollAll reads it first
	}
	return Result;
}

FRTStatus FVulkanDevice::SubmitLists(
    IRTCommandList* const* Lists, uint32_t Count, bool bExternal, FRTFence* OutFence, const std::vector<VkSemaphoreSubmitInfo>& Waits)
{
	if (OutFence) { *OutFence = 0; }
	if (IsLost()) { return LostStatus(); }
	FRTStatus Recording;
	std::vector<VkCommandBufferSubmitInfo> Buffers;
	const ERTQueue Queue = Count > 0 ? static_cast<FVulkanCommandList*>(Lists[0])->GetQueue() : ERTQueue::Graphics;
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		FVulkanCommandList* List = static_cast<FVulkanCommandList*>(Lists[Index]);
		assert(List->GetQueue() == Queue && "lists of two queues");
		assert(List->IsImported() == bExternal && "Submit takes lists of the device, NotifyExternalSubmit imported ones");
		Recording = Recording ? List->GetStatus() : Recording;
		// A list that the engine has submitted runs, whatever is wrong with it: the fence must still cover it.
		if (!Recording && !bExternal) { return Recording; }
		if (!bExternal)
		{
			VkCommandBufferSubmitInfo Info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
			Info.commandBuffer = List->GetHandle();
			Buffers.push_back(Info);
		}
	}
	{
		std::scoped_lock Lock(SubmitMutex);
		const VkResult Result = SubmitBatch(GetQueue(Queue), Buffers, Waits);
		if (Result != VK_SUCCESS) { return MakeStatus(Result, "vkQueueSubmit2", Count ? "command lists" : "nothing"); }
		const uint64_t Number = LastNumber.load();
		const FRTFence Fence = MakeFence(Queue, Number);
		std::scoped_lock GarbageLock(GarbageMutex);
		for (uint32_t Index = 0; Index < Count; ++Index)
		{
			FVulkanCommandList* List = static_cast<FVulkanCommandList*>(Lists[Index]);
			Packets.Push(Number, List->TakeKept(Fence));
		}
		if (OutFence) { *OutFence = Fence; }
	}
	CollectGarbage();
	return Recording;
}

std::vector<VkSemaphoreSubmitInfo> FVulkanDevice::MakeWaits(const FRTFence* Waits, uint32_t WaitCount) const
{
	std::vector<VkSemaphoreSubmitInfo> Semaphores;
	for (uint32_t Index = 0; Index < WaitCount; ++Index)
	{
		if (Waits[Index] == 0) { continue; }
		VkSemaphoreSubmitInfo& Wait = Semaphores.emplace_back(VkSemaphoreSubmitInfo{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO});
		Wait.semaphore = Queues[static_cast<size_t>(GetFenceQueue(Waits[Index]))].Timeline;
		Wait.value = GetFenceValue(Waits[Index]);
		Wait.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
	}
	return Semaphores;
}

FRTStatus FVulkanDevice::Submit(IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits, uint32_t WaitCount)
{
	return SubmitLists(Lists, Count, false, OutFence, MakeWaits(Waits, WaitCount));
}

FRTStatus FVulkanDevice::NotifyExternalSubmit(
    IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits, uint32_t WaitCount)
{
	// The fence's own batch waits, too: it stands for all of the frame, even if the engine has forgotten to.
	return SubmitLists(Lists, Count, true, OutFence, MakeWaits(Waits, WaitCount));
}

uint64_t FVulkanDevice::Poll(FVulkanQueue& Queue)
{
	uint64_t Value = 0;
	if (!IsLost() && Check(Api.GetSemaphoreCounterValue(Handle, Queue.Timeline, &Value)) == VK_SUCCESS)
	{
		uint64_t Known = Queue.LastCompleted.load();
		while (Known < Value && !Queue.LastCompleted.compare_exchange_weak(Known, Value)) {}
	}
	return Queue.LastCompleted.load();
}

uint64_t FVulkanDevice::PollAll()
{
	uint64_t Done = LastNumber.load();
	for (FVulkanQueue& Queue : Queues)
	{
		if (!Queue.Timeline) { continue; }
		const uint64_t Completed = Poll(Queue);
		if (Completed < Queue.LastSubmitted.load()) { Done = std::min(Done, Completed); }
	}
	return Done;
}

FRTFence FVulkanDevice::GetCompletedFence(ERTQueue Queue)
{
	FVulkanQueue& Mine = GetQueue(Queue);
	const uint64_t Completed = Mine.Timeline ? Poll(Mine) : 0;
	return Completed > 0 ? MakeFence(Queue, Completed) : 0;
}

FRTStatus FVulkanDevice::WaitFor(FRTFence Fence, uint64_t TimeoutNs)
{
	if (IsLost()) { return LostStatus(); }
	const FVulkanQueue& Queue = GetQueue(GetFenceQueue(Fence));
	const uint64_t Value = GetFenceValue(Fence);
	assert(Value <= Queue.LastSubmitted.load() && "a fence that no submission returned");
	VkSemaphoreWaitInfo Info{VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO};
	Info.semaphoreCount = 1;
	Info.pSemaphores = &Queue.Timeline;
	Info.pValues = &Value;
	const VkResult Result = Check(Api.WaitSemaphores(Handle, &Info, TimeoutNs));
	if (Result == VK_SUCCESS) { CollectGarbage(); }
	return MakeStatus(Result, "vkWaitSemaphores", "timeline");
}

FRTStatus FVulkanDevice::WaitIdle()
{
	FRTStatus Status;
	for (uint32_t Index = 0; Index < QueueCount && Status; ++Index)
	{
		const FVulkanQueue& Queue = Queues[Index];
		if (Queue.Timeline) { Status = WaitFor(MakeFence(static_cast<ERTQueue>(Index), Queue.LastSubmitted.load()), ~uint64_t(0)); }
	}
	return Status;
}

// ------------------------------------------------------------------------------------------------ the rest

void FVulkanDevice::Account(EVulkanMemoryKind Kind, int64_t Change)
{
	Bytes[static_cast<uint32_t>(Kind)].fetch_add(Change);
	const int64_t Total = TotalBytes.fetch_add(Change) + Change;
	int64_t Peak = PeakBytes.load();
	while (Peak < Total && !PeakBytes.compare_exchange_weak(Peak, Total)) {}
}

FRTMemoryStats FVulkanDevice::GetMemoryStats() const
{
	const auto Of = [&](EVulkanMemoryKind Kind) { return static_cast<uint64_t>(Bytes[static_cast<uint32_t>(Kind)].load()); };
	FRTMemoryStats Stats;
	Stats.Geometry = Of(EVulkanMemoryKind::Geometry);
	Stats.Scene = Of(EVulkanMemoryKind::Scene);
	Stats.ShaderTable = Of(EVulkanMemoryKind::ShaderTable);
	Stats.Texture = Of(EVulkanMemoryKind::Texture);
	Stats.Buffer = Of(EVulkanMemoryKind::Buffer);
	Stats.Scratch = Of(EVulkanMemoryKind::Scratch);
	Stats.Total = static_cast<uint64_t>(TotalBytes.load());
	Stats.Peak = static_cast<uint64_t>(PeakBytes.load());
	return Stats;
}

void FVulkanDevice::SetName(VkObjectType Type, uint64_t Object, const char* Name) const
{
	if (!Instance->bDebugUtils || !Instance->Api.SetDebugUtilsObjectNameEXT || !Name || !Name[0] || !Object) { return; }
	VkDebugUtilsObjectNameInfoEXT Info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
	Info.objectType = Type;
	Info.objectHandle = Object;
	Info.pObjectName = Name;
	Instance->Api.SetDebugUtilsObjectNameEXT(Handle, &Info);
}

uint64_t FVulkanDevice::GetNative(ERTNative Kind) const
{
	switch (Kind)
	{
	case ERTNative::Instance: return ToNative(Instance->Handle);
	case ERTNative::PhysicalDevice: return ToNative(Physical);
	case ERTNative::Device: return ToNative(Handle);
	case ERTNative::Queue: return ToNative(Queues[0].Handle);
	case ERTNative::QueueFamily: return Queues[0].Family;
	case ERTNative::DescriptorSet: return ToNative(Bindless.Set);
	case ERTNative::PipelineLayout: return ToNative(Bindless.PipelineLayout);
	case ERTNative::ComputeTimeline: return ToNative(Queues[static_cast<size_t>(ERTQueue::AsyncCompute)].Timeline);
	default: return 0;
	}
}

// ------------------------------------------------------------------------------------------------ creation: an object initialises itself

FRTStatus FVulkanDevice::CreateBuffer(const FRTBufferDesc& Desc, IRTBuffer** Out)
{
	return CreateObject<FVulkanBuffer>(*this, Out, [&](FVulkanBuffer& It) { return It.Initialise(Desc); });
}

FRTStatus FVulkanDevice::ImportBuffer(const FRTBufferDesc& Desc, const FRTNativeBuffer& Native, IRTBuffer** Out)
{
	*Out = nullptr;
	if (const FRTStatus Status = CheckImport(*this, Desc, Native); !Status) { return Status; }
	return CreateObject<FVulkanBuffer>(*this, Out, [&](FVulkanBuffer& It) { return It.Import(Desc, Native); });
}

FRTStatus FVulkanDevice::CreateTexture(const FRTTextureDesc& Desc, IRTTexture** Out)
{
	return CreateObject<FVulkanTexture>(*this, Out, [&](FVulkanTexture& It) { return It.Initialise(Desc, VK_NULL_HANDLE); });
}

FRTStatus FVulkanDevice::ImportTexture(const FRTTextureDesc& Desc, uint64_t NativeImage, IRTTexture** Out)
{
	*Out = nullptr;
	if (const FRTStatus Status = CheckImport(*this, Desc, (VkImage)NativeImage); !Status) { return Status; }
	return CreateObject<FVulkanTexture>(*this, Out, [&](FVulkanTexture& It) { return It.Initialise(Desc, (VkImage)NativeImage); });
}

FRTStatus FVulkanDevice::CreateSampler(const FRTSamplerDesc& Desc, IRTSampler** Out)
{
	return CreateObject<FVulkanSampler>(*this, Out, [&](FVulkanSampler& It) { return It.Initialise(Desc); });
}

FRTStatus FVulkanDevice::CreateComputePipeline(const FRTComputePipelineDesc& Desc, IRTPipeline** Out)
{
	return CreateObject<FVulkanPipeline>(*this, Out, [&](FVulkanPipeline& It) { return It.InitialiseCompute(Desc); });
}

FRTStatus FVulkanDevice::CreateRasterPipeline(const FRTRasterPipelineDesc& Desc, IRTPipeline** Out)
{
	return CreateObject<FVulkanPipeline>(*this, Out, [&](FVulkanPipeline& It) { return It.InitialiseRaster(Desc); });
}

FRTStatus FVulkanDevice::CreateRayTracingPipeline(const FRTRayTracingPipelineDesc& Desc, IRTPipeline** Out)
{
	return CreateObject<FVulkanPipeline>(*this, Out, [&](FVulkanPipeline& It) { return It.InitialiseRayTracing(Desc); });
}

FRTStatus FVulkanDevice::CreateGeometry(const FRTGeometryDesc& Desc, IRTGeometry** Out)
{
	return CreateObject<FVulkanGeometry>(*this, Out, [&](FVulkanGeometry& It) { return It.Initialise(Desc); });
}

FRTBuildSizes FVulkanDevice::GetGeometrySizes(const FRTGeometryDesc& Desc)
{
	return Bits.bAccel ? QueryGeometrySizes(*this, Desc) : FRTBuildSizes{};
}

FRTStatus FVulkanDevice::CreateScene(const FRTSceneDesc& Desc, IRTScene** Out)
{
	return CreateObject<FVulkanScene>(*this, Out, [&](FVulkanScene& It) { return It.Initialise(Desc); });
}

FRTStatus FVulkanDevice::CreateShaderTable(const FRTShaderTableDesc& Desc, IRTShaderTable** Out)
{
	return CreateObject<FVulkanShaderTable>(*this, Out, [&](FVulkanShaderTable& It) { return It.Initialise(Desc); });
}

FRTStatus FVulkanDevice::CreateQueryPool(ERTQuery Kind, uint32_t Count, IRTQueryPool** Out)
{
	return CreateObject<FVulkanQueryPool>(*this, Out, [&](FVulkanQueryPool& It) { return It.Initialise(Kind, Count); });
}

FRTStatus FVulkanDevice::CreateCommandList(const char* Name, IRTCommandList** Out, ERTQueue Queue)
{
	*Out = nullptr;
	if (!GetQueue(Queue).Handle) { return FRTStatus::Error(ERTResult::Unsupported, "The device has no queue of this kind."); }
	return CreateObject<FVulkanCommandList>(*this, Out, [&](FVulkanCommandList& It) { return It.Initialise(Name, Queue); });
}

FRTStatus FVulkanDevice::ImportCommandList(uint64_t NativeCommandBuffer, IRTCommandList** Out)
{
	*Out = nullptr;
	if (NativeCommandBuffer == 0) { return FRTStatus::Error(ERTResult::InvalidArgument, "ImportCommandList: NativeCommandBuffer is null"); }
	return CreateObject<FVulkanCommandList>(*this, Out, [&](FVulkanCommandList& It) {
		It.InitialiseImported((VkCommandBuffer)NativeCommandBuffer);
		return FRTStatus();
	});
}

} // namespace Lantern
