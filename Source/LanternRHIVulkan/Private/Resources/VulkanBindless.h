// The one descriptor set, with bindings as in LanternRHI/RTInterfaces.h, and its indices. An object gives its index back in its
// destructor, which runs when the GPU has finished with it.
#pragma once

#include "Device/VulkanTranslate.h"
#include "LanternRHICommon/IndexAllocator.h"

#include <mutex>

namespace Lantern
{

inline constexpr uint32_t NoBindlessIndex = FIndexAllocator::None;

class FVulkanBindless
{
public:
	enum EBinding : uint32_t
	{
		Sampled,
		Storage,
		Sampler,
		Scene,
		BindingCount,
	};

	/// Capacities: descriptors of each binding; 0 leaves the binding out.
	VkResult Create(
	    VkDevice Device, const FVulkanDeviceApi& Api, const uint32_t (&Capacities)[BindingCount], const FVulkanCapabilityBits& Bits);
	void Destroy();

	// These return NoBindlessIndex if all indices are in use.
	uint32_t AddImage(EBinding Binding, VkImageView View);
	uint32_t AddSampler(VkSampler Sampler);
	uint32_t AddScene(VkAccelerationStructureKHR Scene);
	void Remove(EBinding Binding, uint32_t Index);

	VkDescriptorSet Set = VK_NULL_HANDLE;
	VkPipelineLayout PipelineLayout = VK_NULL_HANDLE;
	VkDescriptorSetLayout SetLayout = VK_NULL_HANDLE;

private:
	/// Writes the descriptor of Info at a free index. Returns the index.
	uint32_t Add(EBinding Binding, VkWriteDescriptorSet& Info);

	VkDevice Device = VK_NULL_HANDLE;
	const FVulkanDeviceApi* Api = nullptr;
	VkDescriptorPool Pool = VK_NULL_HANDLE;
	std::mutex Mutex;
	FIndexAllocator Indices[BindingCount];
};

} // namespace Lantern
