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
	explicit FVulkanRequirements(const FVulkanProbe& InProbe) : Probe(InProbe) { Probe.Features.Link(Probe.Extensions); }

	uint32_t GetExtensionCount() const override { return static_cast<uint32_t>(Probe.Extensions.size()); }
	const char* const* GetExtensions() const override { return Probe.Extensions.data(); }
	const VkPhysicalDeviceFeatures2* GetFeatures() const override { return &Probe.Features.Core; }
	void MergeInto(VkPhysicalDeviceFeatures2* EngineChain) override;
	const FRTCapabilities& GetCapabilities() const override { return Probe.Capabilities; }

	FVulkanProbe Probe;

private:
	~FVulkanRequirements() override = default;
};

/// "NAME (DRIVER) lacks A: …; B: …"
std::string DescribeProbe(const FVulkanProbe& Probe);

} // namespace Lantern
