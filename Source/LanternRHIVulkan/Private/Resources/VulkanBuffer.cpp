// FVulkanBlock and FVulkanBuffer: buffers with their memory.
#include "Resources/VulkanBuffer.h"

#include <algorithm>
#include <cassert>

#include "LanternRHI/RTText.h"

namespace Lantern
{

FRTStatus FVulkanBlock::Create(FVulkanDevice& InDevice, uint64_t Size, VkBufferUsageFlags Usage, ERTMemory InMemory, uint64_t Alignment,
    EVulkanMemoryKind InKind, const char* Name)
{
	assert(!Handle && Size > 0);
	Kind = InKind;
	if (Size > InDevice.Probe.MaxBufferBytes)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "Buffer '%s' of %llu bytes; the device's limit is %llu", FRTShown(Name).Text,
		    static_cast<unsigned long long>(Size), static_cast<unsigned long long>(InDevice.Probe.MaxBufferBytes));
	}
	VkBufferCreateInfo Info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
	Info.size = Size;
	Info.usage = Usage | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
	if (InDevice.QueueFamilies.size() > 1)
	{
		Info.sharingMode = VK_SHARING_MODE_CONCURRENT;
		Info.queueFamilyIndexCount = static_cast<uint32_t>(InDevice.QueueFamilies.size());
		Info.pQueueFamilyIndices = InDevice.QueueFamilies.data();
	}
	VkResult Result = InDevice.Memory.CreateBuffer(Info, InMemory, Alignment, &Handle, &Allocation);
	if (Result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
	{
		InDevice.CollectGarbage(); // what was released may already be free
		Result = InDevice.Memory.CreateBuffer(Info, InMemory, Alignment, &Handle, &Allocation);
	}
	if (InDevice.Check(Result) != VK_SUCCESS)
	{
		Handle = VK_NULL_HANDLE;
		FRTStatus Status = MakeStatus(Result, "Creating buffer", Name);
		return Status.Code == ERTResult::OutOfDeviceMemory
		           ? FRTStatus::Error(Status.Code, "Creating buffer '%s' of %llu bytes: %s", FRTShown(Name).Text,
		                 static_cast<unsigned long long>(Size), ToString(Result))
		           : Status;
	}
	Device = &InDevice;
	Device->Account(Kind, static_cast<int64_t>(Allocation.Bytes));
	Device->SetName(VK_OBJECT_TYPE_BUFFER, ToNative(Handle), Name);
	VkBufferDeviceAddressInfo AddressInfo{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
	AddressInfo.buffer = Handle;
	Address = Device->Api.GetBufferDeviceAddress(Device->Handle, &AddressInfo);
	return {};
}

void FVulkanBlock::Destroy()
{
	if (Handle)
	{
		Device->Memory.DestroyBuffer(Handle, Allocation);
		Device->Account(Kind, -static_cast<int64_t>(Allocation.Bytes));
		Handle = VK_NULL_HANDLE;
	}
}

FVulkanBuffer::~FVulkanBuffer()
{
	if (Imported.Released != nullptr) { Imported.Released(Imported.User); }
}

void FVulkanBuffer::SetDesc(const FRTBufferDesc& InDesc)
{
	Desc = InDesc;
	Name = InDesc.Name ? InDesc.Name : "";
	Desc.Name = Name.c_str();
}

FRTStatus FVulkanBuffer::Import(const FRTBufferDesc& InDesc, const FRTNativeBuffer& Native)
{
	SetDesc(InDesc);
	Desc.Memory = ERTMemory::Device;
	Imported = Native;
	if (Imported.Address != 0) { return {}; }
	VkBufferDeviceAddressInfo Info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
	Info.buffer = (VkBuffer)Native.Handle;
	Imported.Address = Device.Api.GetBufferDeviceAddress(Device.Handle, &Info);
	return {};
}

FRTStatus FVulkanBuffer::Initialise(const FRTBufferDesc& InDesc)
{
	SetDesc(InDesc);
	const FRTCapabilities& Caps = Device.GetCapabilities();
	const bool bScratch = HasAny(Desc.Usage, ERTBufferUsage::Scratch);
	// An acceleration structure build reads addresses that are multiples of 16 at most; shader tables and scratch say
	// what they need.
	uint64_t Alignment = 16;
	if (bScratch) { Alignment = std::max<uint64_t>(Alignment, Caps.ScratchAlignment); }
	if (HasAny(Desc.Usage, ERTBufferUsage::ShaderTable)) { Alignment = std::max<uint64_t>(Alignment, Caps.ShaderGroupBaseAlignment); }
	return Block.Create(Device, Desc.Size, BufferUsageOf(Desc.Usage, Device.Bits), Desc.Memory, Alignment,
	    bScratch ? EVulkanMemoryKind::Scratch : EVulkanMemoryKind::Buffer, Desc.Name);
}

} // namespace Lantern
