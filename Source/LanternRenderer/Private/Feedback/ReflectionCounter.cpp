// The counts of reflections.
#include "Feedback/ReflectionCounter.h"

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCount("r.RT.Rays.CountEnds", false,
    "Counts the pixels whose reflections are traced, and how their paths end. These take longer for it: for measurements only.");

FReflectionCounts MakeCounts(const FReflectionStatistics& Of)
{
	return {Of.Mirrors, Of.Sharp, Of.Wide, Of.Further, Of.Lit, Of.Ends[PATH_END_SKY], Of.Ends[PATH_END_CELL], Of.Ends[PATH_END_STAND_IN],
	    Of.Ends[PATH_END_DARK], Of.Ends[PATH_END_NONE], 0};
}
} // namespace

bool ArePathEndsCounted() { return CVarCount.GetOnRenderThread(); }

FReflectionCounter::FReflectionCounter(IRTDevice& InDevice) : TGpuStatistics(InDevice, "ReflectionStatistics", MakeCounts) {}

} // namespace Lantern
