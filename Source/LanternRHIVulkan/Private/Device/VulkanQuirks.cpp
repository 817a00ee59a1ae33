// The table of known faults of drivers.
#include "Device/VulkanQuirks.h"

#include <cstdio>

namespace Lantern
{

namespace
{

struct FQuirk
{
	VkDriverId Driver;
	uint32_t FirstVersion; ///< as the driver packs it
	uint32_t FixedVersion; ///< first without the fault, or ~0u if none is known
	EVulkanQuirk Flag;
	const char* Reason;
};

constexpr FQuirk Quirks[] = {
    {VK_DRIVER_ID_MESA_LLVMPIPE, 0, VK_MAKE_API_VERSION(0, 26, 2, 0), EVulkanQuirk::LinkedPushConstantsLost,
        "push constants read as zero when every group of a ray-tracing pipeline comes from libraries (seen in 25.0.7, "
        "right in 26.2): ray generation and miss shaders are compiled in the final link"},
    {VK_DRIVER_ID_MESA_LLVMPIPE, 0, ~0u, EVulkanQuirk::CrashWithoutHitShaders,
        "a ray that hits crashes the process when no hit group of its pipeline has a shader (seen in 25.0.7 with LLVM 19, "
        "not with LLVM 15): such pipelines get an empty closest-hit shader that nothing runs"},
    {VK_DRIVER_ID_MESA_LLVMPIPE, 0, ~0u, EVulkanQuirk::SizesAlwaysAvailable,
        "queries of compacted sizes are available from the start, and resets leave them (seen in 25.0.7): they count as "
        "written when the list that does so has finished"},
    {VK_DRIVER_ID_MESA_LLVMPIPE, 0, ~0u, EVulkanQuirk::TimestampsWait,
        "asking whether a timestamp is there waits for the frame that writes it (seen in 25.0.7): it is asked for when the "
        "list that writes it has finished"},
};

} // namespace

uint32_t FindQuirks(VkDriverId Driver, uint32_t DriverVersion, char* OutText, size_t TextSize)
{
	uint32_t Flags = 0;
	size_t Length = 0;
	if (OutText && TextSize) { OutText[0] = 0; }
	for (const FQuirk& Quirk : Quirks)
	{
		if (Quirk.Driver != Driver || DriverVersion < Quirk.FirstVersion || DriverVersion >= Quirk.FixedVersion) { continue; }
		Flags |= static_cast<uint32_t>(Quirk.Flag);
		if (OutText && Length < TextSize)
		{
			Length += static_cast<size_t>(snprintf(OutText + Length, TextSize - Length, "%s%s", Length ? "\n" : "", Quirk.Reason));
		}
	}
	return Flags;
}

} // namespace Lantern
