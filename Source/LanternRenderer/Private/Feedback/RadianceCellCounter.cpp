// The counts of radiance cells.
#include "Feedback/RadianceCellCounter.h"

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCount(
    "r.RT.GI.Cells.Count", false, "Counts radiance cells, and what becomes of look-ups. These take longer for it: for measurements only.");

FRadianceCellCounts MakeCounts(const FRadianceCellStatistics& Of)
{
	return {Of.Live, Of.Young, Of.Updated, Of.Full, Of.Found, Of.Coarse, Of.Missed, 0};
}
} // namespace

bool AreRadianceCellsCounted() { return CVarCount.GetOnRenderThread(); }

FRadianceCellCounter::FRadianceCellCounter(IRTDevice& InDevice) : TGpuStatistics(InDevice, "RadianceCellStatistics", MakeCounts) {}

} // namespace Lantern
