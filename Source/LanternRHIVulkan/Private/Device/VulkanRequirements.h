// Implementation of IRTVulkanRequirements.
#pragma once

#include "Device/VulkanCapabilities.h"
#include "LanternRHICommon/RefCounted.h"
#include "LanternRHIVulkan/VulkanInterop.h"

namespace Lantern
{

class FVulkanRequirements final : public TRefCounted<IRTVulkanRequirements>
{
public:
	/// Desc: checked.
	FVulkanRequirements(const FVulkanProbe& InProbe, const FRTVulkanRequirementsDesc& Desc);

	uint32_t GetExtensionCount() const override { return static_cast<uint32_t>(Extensions.size()); }
	const char* const* GetExtensions() const override { return Extensions.data(); }
	const void* MergeFeatures() override;
	const FRTCapabilities& GetCapabilities() const override { return Probe.Capabilities; }

	FVulkanProbe Probe;

private:
	~FVulkanRequirements() override = default;

	std::vector<std::string> Names; ///< the engine's extensions, then ours
	std::vector<const char*> Extensions;
	void* EngineChain = nullptr;
	VkPhysicalDeviceFeatures* EngineFeatures = nullptr;
	const void* Head = nullptr; ///< null before MergeFeatures
};

/// "NAME (DRIVER) lacks A: …; B: …"
std::string DescribeProbe(const FVulkanProbe& Probe);

} // namespace Lantern
