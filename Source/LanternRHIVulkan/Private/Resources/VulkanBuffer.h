// Buffers with their memory and address.
#pragma once

#include "Device/VulkanDeviceImpl.h"

#include <string>

namespace Lantern
{

/// A VkBuffer with its memory and address. Buffers, acceleration structures and shader tables are made of it.
class FVulkanBlock
{
public:
	FVulkanBlock() = default;
	FVulkanBlock(const FVulkanBlock&) = delete;
	FVulkanBlock& operator=(const FVulkanBlock&) = delete;
	~FVulkanBlock() { Destroy(); }

	FRTStatus Create(FVulkanDevice& InDevice, uint64_t Size, VkBufferUsageFlags Usage, ERTMemory InMemory, uint64_t Alignment,
	    EVulkanMemoryKind InKind, const char* Name);
	void Destroy();

	VkBuffer Handle = VK_NULL_HANDLE;
	VkDeviceAddress Address = 0;
	FVulkanAllocation Allocation;

private:
	FVulkanDevice* Device = nullptr;
	EVulkanMemoryKind Kind = EVulkanMemoryKind::Buffer;
};

/// A block that lists keep. Whoever made it may let go of it earlier.
class FVulkanKeptBlock final : public TVulkanObject<IRTRefCounted>
{
public:
	using TVulkanObject::TVulkanObject;
	FVulkanBlock Block;
	uint64_t Size = 0;
};

class FVulkanBuffer final : public TVulkanObject<IRTBuffer>
{
public:
	using TVulkanObject::TVulkanObject;
	~FVulkanBuffer() override;
	FRTStatus Initialise(const FRTBufferDesc& InDesc);
	/// Arguments: checked.
	FRTStatus Import(const FRTBufferDesc& InDesc, const FRTNativeBuffer& Native);

	const FRTBufferDesc& GetDesc() const override { return Desc; }
	uint64_t GetDeviceAddress() const override { return Imported.Address != 0 ? Imported.Address : Block.Address; }
	void* GetMapped() override { return Desc.Memory == ERTMemory::Device ? nullptr : Block.Allocation.Mapped; }
	uint64_t GetNative(ERTNative Kind) const override { return Kind == ERTNative::Buffer ? ToNative(GetHandle()) : 0; }
	VkBuffer GetHandle() const { return Imported.Handle != 0 ? (VkBuffer)Imported.Handle : Block.Handle; }

private:
	void SetDesc(const FRTBufferDesc& InDesc);

	FVulkanBlock Block;
	FRTNativeBuffer Imported; ///< the engine's memory, in place of Block
	FRTBufferDesc Desc;
	std::string Name;
};

} // namespace Lantern
