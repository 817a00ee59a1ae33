// Creation and take-over of a device, and the choice among devices.
#include "Device/VulkanDeviceImpl.h"

#include "Device/VulkanCallTrace.h"
#include "Device/VulkanRequirements.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace Lantern
{

FVulkanDevice::FVulkanDevice(
    std::unique_ptr<FVulkanInstance> InInstance, VkPhysicalDevice InPhysical, const FVulkanProbe& InProbe, const char* CacheFile)
    : Instance(std::move(InInstance)),
      Physical(InPhysical),
      Probe(InProbe),
      Cache(CacheFile)
{
	Probe.Features.Link(Probe.Extensions);
	Bits = {Probe.bAccel, Probe.Capabilities.bRayQuery, Probe.Capabilities.bRayTracingPipeline, Probe.bMaintenance1};
	Queues[0].Family = Probe.QueueFamily;
}

FVulkanDevice::~FVulkanDevice()
{
	if (!Handle) { return; }
	if (Queues[0].Timeline)
	{
		(void)WaitIdle();
		CollectAll();
		if (const FRTStatus Status = Cache.Save(); !Status) { Instance->Report(ERTVulkanMessage::Warning, Status.Message); }
	}
	for (const FVulkanQueue& Queue : Queues)
	{
		if (Queue.Timeline) { Api.DestroySemaphore(Handle, Queue.Timeline, nullptr); }
	}
	Scatter.Destroy(*this);
	Cache.Destroy();
	Bindless.Destroy();
	Memory.Destroy();
	if (bOwned)
	{
		// The table may be incomplete when creation failed half-way.
		const auto DestroyDevice = reinterpret_cast<PFN_vkDestroyDevice>(Instance->Api.GetDeviceProcAddr(Handle, "vkDestroyDevice"));
		DestroyDevice(Handle, nullptr);
	}
}

/// Nothing is in flight, and nobody holds an object.
void FVulkanDevice::CollectAll()
{
	for (bool bMore = true; bMore;)
	{
		CollectUpTo(~uint64_t(0));
		Reaper.Drain();
		const std::scoped_lock Lock(GarbageMutex);
		bMore = !Garbage.IsEmpty() || !Packets.IsEmpty(); // what a pipeline held
	}
}

FRTStatus FVulkanDevice::CreateNative()
{
	const float Priorities[] = {1.0f, 1.0f};
	std::vector<VkDeviceQueueCreateInfo> QueueInfos;
	const auto AddQueue = [&](FVulkanQueue& Queue, uint32_t Family) {
		const auto IsSame = [=](const VkDeviceQueueCreateInfo& Item) { return Item.queueFamilyIndex == Family; };
		auto Found = std::find_if(QueueInfos.begin(), QueueInfos.end(), IsSame);
		if (Found == QueueInfos.end()) { Found = QueueInfos.insert(Found, {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO}); }
		Found->queueFamilyIndex = Family;
		Found->pQueuePriorities = Priorities;
		Queue.Family = Family;
		return Found->queueCount++;
	};
	constexpr uint32_t None = FVulkanProbe::NoQueueFamily;
	FVulkanQueue &Compute = GetQueue(ERTQueue::AsyncCompute), &Transfer = GetQueue(ERTQueue::Transfer);
	const uint32_t GraphicsIndex = AddQueue(Queues[0], Probe.QueueFamily);
	const uint32_t ComputeIndex = Probe.ComputeFamily != None ? AddQueue(Compute, Probe.ComputeFamily) : 0;
	const uint32_t TransferIndex = Probe.TransferFamily != None ? AddQueue(Transfer, Probe.TransferFamily) : 0;
	VkDeviceCreateInfo Info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &Probe.Features.Core};
	Info.queueCreateInfoCount = static_cast<uint32_t>(QueueInfos.size());
	Info.pQueueCreateInfos = QueueInfos.data();
	Info.enabledExtensionCount = static_cast<uint32_t>(Probe.Extensions.size());
	Info.ppEnabledExtensionNames = Probe.Extensions.data();
	const VkResult Result = Instance->Api.CreateDevice(Physical, &Info, nullptr, &Handle);
	if (Result != VK_SUCCESS)
	{
		Handle = VK_NULL_HANDLE;
		return MakeStatus(Result, "vkCreateDevice", Probe.Capabilities.DeviceName);
	}
	bOwned = true;
	FRTStatus Status = LoadDeviceApi(Instance->Api, Handle, Bits.bAccel, Bits.bPipeline, &Api);
	if (!Status) { return Status; }
	if (CallSink.Call) { TraceVulkanCalls(Instance->Api, Instance->Handle, CallSink, Api); }
	Api.GetDeviceQueue(Handle, Queues[0].Family, GraphicsIndex, &Queues[0].Handle);
	if (Probe.ComputeFamily != None) { Api.GetDeviceQueue(Handle, Compute.Family, ComputeIndex, &Compute.Handle); }
	if (Probe.TransferFamily != None) { Api.GetDeviceQueue(Handle, Transfer.Family, TransferIndex, &Transfer.Handle); }
	return CreateShared();
}

FRTStatus FVulkanDevice::AdoptNative(const FRTVulkanExternalDesc& Desc)
{
	Handle = Desc.Device;
	Queues[0].Handle = Desc.Queue;
	Queues[0].Family = Desc.QueueFamily;
	Queues[0].Lock = {Desc.LockQueue, Desc.UnlockQueue, Desc.QueueUser};
	FVulkanQueue& Transfer = GetQueue(ERTQueue::Transfer);
	Transfer.Handle = Desc.TransferQueue;
	Transfer.Family = Desc.TransferQueueFamily;
	FVulkanQueue& Compute = GetQueue(ERTQueue::AsyncCompute);
	Compute.Handle = Desc.ComputeQueue;
	Compute.Family = Desc.ComputeQueueFamily;
	FRTStatus Status = LoadDeviceApi(Instance->Api, Handle, Bits.bAccel, Bits.bPipeline, &Api);
	return Status ? CreateShared() : Status;
}

FRTStatus FVulkanDevice::CreateTimelines()
{
	const auto AddFamily = [](std::vector<uint32_t>& Families, uint32_t Family) {
		if (std::find(Families.begin(), Families.end(), Family) == Families.end()) { Families.push_back(Family); }
	};
	VkSemaphoreTypeCreateInfo Type{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO};
	Type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
	VkSemaphoreCreateInfo Info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &Type};
	VkResult Result = VK_SUCCESS;
	for (FVulkanQueue& Queue : Queues)
	{
		if (!Queue.Handle || Result != VK_SUCCESS) { continue; }
		Result = Api.CreateSemaphore(Handle, &Info, nullptr, &Queue.Timeline);
		if (Result == VK_SUCCESS) { SetName(VK_OBJECT_TYPE_SEMAPHORE, ToNative(Queue.Timeline), "Lantern timeline"); }
		AddFamily(QueueFamilies, Queue.Family);
		if (&Queue != &GetQueue(ERTQueue::Transfer)) { AddFamily(TextureFamilies, Queue.Family); }
	}
	Probe.Capabilities.bAsyncComputeQueue = GetQueue(ERTQueue::AsyncCompute).Handle != VK_NULL_HANDLE;
	Probe.Capabilities.bTransferQueue = GetQueue(ERTQueue::Transfer).Handle != VK_NULL_HANDLE;
	return MakeStatus(Result, "vkCreateSemaphore", Probe.Capabilities.DeviceName);
}

FRTStatus FVulkanDevice::CreateShared()
{
	const char* Name = Probe.Capabilities.DeviceName;
	uint32_t FamilyCount = 0;
	Instance->Api.GetPhysicalDeviceQueueFamilyProperties(Physical, &FamilyCount, nullptr);
	std::vector<VkQueueFamilyProperties> Families(FamilyCount);
	Instance->Api.GetPhysicalDeviceQueueFamilyProperties(Physical, &FamilyCount, Families.data());
	if (Queues[0].Family >= FamilyCount)
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "FRTVulkanExternalDesc::QueueFamily is %u, and %s has %u", Queues[0].Family, Name, FamilyCount);
	}
	TimestampBits = Families[Queues[0].Family].timestampValidBits;
	Probe.Capabilities.bTimestamps = TimestampBits > 0;

	const PFN_vkGetDeviceProcAddr GetProcAddr = CallSink.Call ? &GetTracedDeviceProcAddr : Instance->Api.GetDeviceProcAddr;
	FRTStatus Status =
	    MakeStatus(Memory.Create(Instance->Handle, Physical, Handle, Instance->Api, GetProcAddr), "Creating the memory allocator of", Name);
	if (!Status) { return Status; }
	const uint32_t Textures = Probe.Capabilities.MaxBindlessTextures;
	Status = MakeStatus(Bindless.Create(Handle, Api, {Textures, Textures, Probe.MaxBindlessSamplers, Probe.MaxBindlessScenes}, Bits),
	    "Creating the descriptor heap of", Name);
	if (!Status) { return Status; }
	char Message[512] = {};
	Status = MakeStatus(Cache.Create(Handle, Api, Probe, Message, sizeof(Message)), "vkCreatePipelineCache", Name);
	if (Message[0]) { Instance->Report(ERTVulkanMessage::Warning, Message); }
	if (!Status) { return Status; }
	Status = CreateTimelines();
	SetName(VK_OBJECT_TYPE_DESCRIPTOR_SET, ToNative(Bindless.Set), "Lantern bindless");
	// Here, so that no list that is recorded waits for a compiler.
	return Status ? Scatter.Create(*this) : Status;
}

namespace
{

const char* TypeName(VkPhysicalDeviceType Type)
{
	switch (Type)
	{
	case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return "discrete";
	case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return "integrated";
	case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return "virtual";
	case VK_PHYSICAL_DEVICE_TYPE_CPU: return "cpu";
	default: return "other";
	}
}

bool IsGoodEnough(const FVulkanProbe& Probe, const FRTVulkanDeviceDesc& Desc)
{
	return Probe.bUsable && (Desc.bAllowNoRayTracing || Probe.Capabilities.Rung != ERTRung::None);
}

/// Rates a device; larger is better. Pipelines count before the kind of device, and CPUs are always last.
int Score(const FVulkanProbe& Probe)
{
	int Points = static_cast<int>(Probe.Capabilities.Rung) + (Probe.Capabilities.bRayQuery ? 8 : 0);
	Points += Probe.Type == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU ? 100 : 0;
	Points += Probe.Type == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU ? 50 : 0;
	Points += Probe.Capabilities.bRayTracingPipeline ? 1000 : 0;
	Points += Probe.Capabilities.Rung != ERTRung::None ? 500 : 0;
	return Probe.Capabilities.bIsCpu ? Points - 10000 : Points;
}

FRTStatus ChooseDevice(
    const FVulkanInstance& Instance, const FRTVulkanDeviceDesc& Desc, VkPhysicalDevice* OutPhysical, FVulkanProbe* OutProbe)
{
	const std::vector<VkPhysicalDevice> Devices = Instance.GetPhysicalDevices();
	if (Devices.empty())
	{
		return FRTStatus::Error(ERTResult::Unsupported, "No Vulkan device: the loader is there, but no driver answers.");
	}
	const int Count = static_cast<int>(Devices.size());
	if (Desc.DeviceIndex < -1 || Desc.DeviceIndex >= Count)
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "Device %d was asked for; there are %d, counted from 0.", Desc.DeviceIndex, Count);
	}
	std::string Reasons;
	bool bFound = false;
	for (int Index = 0; Index < Count; ++Index)
	{
		if (Desc.DeviceIndex >= 0 && Index != Desc.DeviceIndex) { continue; }
		FVulkanProbe Probe;
		ProbeVulkanDevice(Instance.Api, Devices[Index], {Desc.MaxRung, Desc.bDisableRayQuery, Desc.bDisablePipeline}, &Probe);
		if (!IsGoodEnough(Probe, Desc)) { Reasons += "\n  " + std::to_string(Index) + ": " + DescribeProbe(Probe); }
		else if (!bFound || Score(Probe) > Score(*OutProbe))
		{
			bFound = true;
			*OutProbe = Probe;
			*OutPhysical = Devices[Index];
		}
	}
	return bFound ? FRTStatus() : FRTStatus::Error(ERTResult::Unsupported, "No Vulkan device can run Lantern:%s", Reasons.c_str());
}

/// Submits an empty list to each queue beside the first. NVIDIA's driver takes 3 ms for a queue's first submission, which would
/// be a frame's.
FRTStatus WarmQueues(IRTDevice& Device)
{
	const FRTCapabilities& Capabilities = Device.GetCapabilities();
	const std::pair<ERTQueue, bool> Queues[] = {
	    {ERTQueue::Transfer, Capabilities.bTransferQueue}, {ERTQueue::AsyncCompute, Capabilities.bAsyncComputeQueue}};
	for (const auto& [Queue, bThere] : Queues)
	{
		if (!bThere) { continue; }
		TRTRef<IRTCommandList> List;
		FRTFence Fence = 0;
		FRTStatus Status = Device.CreateCommandList("Warm", List.ReleaseAndGetAddress(), Queue);
		Status = Status ? List->Begin() : Status;
		Status = Status ? List->End() : Status;
		IRTCommandList* const Lists[] = {List.Get()};
		Status = Status ? Device.Submit(Lists, 1, &Fence) : Status;
		Status = Status ? Device.WaitFor(Fence, 1'000'000'000) : Status;
		if (!Status) { return Status; }
	}
	return FRTStatus::Success();
}

} // namespace

FRTStatus CreateVulkanDevice(const FRTVulkanDeviceDesc& Desc, IRTDevice** Out)
{
	*Out = nullptr;
	auto Instance = std::make_unique<FVulkanInstance>();
	FRTStatus Status = Instance->Create({Desc.bValidation, Desc.bSynchronizationValidation, Desc.MessageCallback, Desc.MessageUser});
	if (!Status) { return Status; }
	VkPhysicalDevice Physical = VK_NULL_HANDLE;
	FVulkanProbe Probe;
	Status = ChooseDevice(*Instance, Desc, &Physical, &Probe);
	if (!Status) { return Status; }
	FVulkanDevice* Device = new FVulkanDevice(std::move(Instance), Physical, Probe, Desc.PipelineCacheFile);
	Device->bCacheLibraries = Desc.bCacheLibraries;
	Device->CallSink = Desc.CallSink;
	Status = Device->CreateNative();
	Status = Status ? WarmQueues(*Device) : Status;
	if (!Status)
	{
		Device->DropOne();
		return Status;
	}
	*Out = Device;
	return Status;
}

FRTStatus AdoptVulkanDevice(const FRTVulkanExternalDesc& Desc, IRTDevice** Out)
{
	*Out = nullptr;
	const std::pair<const void*, const char*> Needed[] = {{Desc.Instance, "Instance"}, {Desc.PhysicalDevice, "PhysicalDevice"},
	    {Desc.Device, "Device"}, {Desc.Queue, "Queue"}, {Desc.Requirements, "Requirements"}};
	for (const auto& [Pointer, Name] : Needed)
	{
		if (Pointer == nullptr) { return FRTStatus::Error(ERTResult::InvalidArgument, "FRTVulkanExternalDesc::%s is null", Name); }
	}
	auto Instance = std::make_unique<FVulkanInstance>();
	FRTStatus Status =
	    Instance->Adopt(Desc.Instance, Desc.GetInstanceProcAddr, {Desc.bCountValidation, false, Desc.MessageCallback, Desc.MessageUser});
	if (!Status) { return Status; }
	const FVulkanProbe& Probe = static_cast<const FVulkanRequirements*>(Desc.Requirements)->Probe;
	FVulkanDevice* Device = new FVulkanDevice(std::move(Instance), Desc.PhysicalDevice, Probe, Desc.PipelineCacheFile);
	Status = Device->AdoptNative(Desc);
	Status = Status ? WarmQueues(*Device) : Status;
	if (!Status)
	{
		Device->DropOne();
		return Status;
	}
	*Out = Device;
	return Status;
}

FRTStatus ListVulkanDevices(FRTVulkanDeviceInfo* Out, uint32_t Capacity, uint32_t* OutCount)
{
	*OutCount = 0;
	FVulkanInstance Instance;
	FRTStatus Status = Instance.Create({});
	if (!Status) { return Status; }
	const std::vector<VkPhysicalDevice> Devices = Instance.GetPhysicalDevices();
	*OutCount = static_cast<uint32_t>(Devices.size());
	for (uint32_t Index = 0; Index < Devices.size() && Index < Capacity; ++Index)
	{
		FVulkanProbe Probe;
		ProbeVulkanDevice(Instance.Api, Devices[Index], {}, &Probe);
		FRTVulkanDeviceInfo& Info = Out[Index];
		Info = {};
		snprintf(Info.Name, sizeof(Info.Name), "%s", Probe.Capabilities.DeviceName);
		snprintf(Info.Driver, sizeof(Info.Driver), "%s", Probe.Capabilities.DriverName);
		snprintf(Info.Type, sizeof(Info.Type), "%s", TypeName(Probe.Type));
		Info.ApiVersion = Probe.ApiVersion;
		Info.bUsable = Probe.bUsable;
		Info.Rung = Probe.Capabilities.Rung;
		Info.bRayQuery = Probe.Capabilities.bRayQuery;
		Info.bRayTracingPipeline = Probe.Capabilities.bRayTracingPipeline;
		snprintf(Info.Missing, sizeof(Info.Missing), "%s", Probe.Missing.c_str());
		snprintf(Info.Quirks, sizeof(Info.Quirks), "%s", Probe.QuirkText.c_str());
	}
	return Status;
}

} // namespace Lantern
