// Known faults of drivers, in one table, each with its reason and what Lantern does instead.
#pragma once

#include "Device/VulkanApi.h"

namespace Lantern
{

enum class EVulkanQuirk : uint32_t
{
	None = 0,
	/// Ray generation and miss shaders must be in the final link of a ray-tracing pipeline, not in libraries.
	LinkedPushConstantsLost = 1 << 0,
	/// A ray-tracing pipeline must have a hit shader, even one that no record reaches.
	CrashWithoutHitShaders = 1 << 1,
	/// Queries of compacted sizes are always available: fences must say whether a size has been written.
	SizesAlwaysAvailable = 1 << 2,
	/// Asking for a timestamp waits for the GPU: fences must say whether it has been written.
	TimestampsWait = 1 << 3,
};

constexpr bool HasQuirk(uint32_t Flags, EVulkanQuirk Flag) { return (Flags & static_cast<uint32_t>(Flag)) != 0; }

/// Returns the flags of EVulkanQuirk that hold for the driver. OutText: one line for each quirk; may be null.
uint32_t FindQuirks(VkDriverId Driver, uint32_t DriverVersion, char* OutText, size_t TextSize);

} // namespace Lantern
