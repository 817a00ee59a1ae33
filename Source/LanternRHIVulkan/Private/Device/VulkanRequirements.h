#pragma once

#include "Device/VulkanCapabilities.h"
#include "LanternRHIVulkan/VulkanInterop.h"

#include <atomic>

namespace Lantern
{

class FVulkanRequirements final : public IRTVulkanRequirements
{
public:
	explicit FVulkanRequirements(const FVulkanProbe& InProbe) : Probe(InProbe) { Probe.Features.Link(Probe.Extensions); }

	uint32_t AddRef() override { return References.fetch_add(1) + 1; }
	uint32_t Release() override;
	uint32_t GetExtensionCount() const override { return static_cast<uint32_t>(Probe.Extensions.size()); }
	const char* const* GetExtensions() const override { return Probe.Extensions.data(); }
	const VkPhysicalDeviceFeatures2* GetFeatures() const override { return &Probe.Features.Core; }
	void MergeInto(VkPhysicalDeviceFeatures2* EngineChain) override;
	const FRTCapabilities& GetCapabilities() const override { return Probe.Capabilities; }

	FVulkanProbe Probe;

private:
	~FVulkanRequirements() override = default;
	std::atomic<uint32_t> References{1};
};

/// "NAME (DRIVER) lacks A: …; B: …"
std::string DescribeProbe(const FVulkanProbe& Probe);

} // namespace Lantern
