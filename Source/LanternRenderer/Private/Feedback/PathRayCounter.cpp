// The counts of rays that paths trace.
#include "Feedback/PathRayCounter.h"

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCount("r.RT.Rays.CountPaths", false,
    "Counts the rays that paths trace: global illumination, updates of radiance cells, reflections and what light shines through. Each "
    "takes longer for it: for measurements only.");

FPathRayCounts MakeCounts(const FPathRayStatistics& Of)
{
	return {Of.Rays[PATH_RAY_SURFACE], Of.Rays[PATH_RAY_LIGHT], Of.Rays[PATH_RAY_CHECK], 0};
}
} // namespace

bool ArePathRaysCounted() { return CVarCount.GetOnRenderThread(); }

FPathRayCounter::FPathRayCounter(IRTDevice& InDevice) : TGpuStatistics(InDevice, "PathRayStatistics", MakeCounts) {}

} // namespace Lantern
