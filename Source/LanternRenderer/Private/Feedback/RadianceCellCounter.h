// Counts what becomes of radiance cells, and of look-ups: r.RT.GI.Cells.Count. If it is off, nothing is allocated.
#pragma once

#include "Feedback/GpuStatistics.h"
#include "LanternRenderer/FrameCounts.h"
#include "RadianceCellTypes.h"

namespace Lantern
{

/// Whether shaders count.
bool AreRadianceCellsCounted();

class FRadianceCellCounter : public TGpuStatistics<FRadianceCellStatistics, FRadianceCellCounts>
{
public:
	explicit FRadianceCellCounter(IRTDevice& InDevice);
};

} // namespace Lantern
