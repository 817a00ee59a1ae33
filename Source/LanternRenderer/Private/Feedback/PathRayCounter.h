// Counts the rays that paths trace: r.RT.Rays.CountPaths. If it is off, nothing is allocated.
#pragma once

#include "Feedback/GpuStatistics.h"
#include "LanternRenderer/FrameCounts.h"
#include "SceneTypes.h"

namespace Lantern
{

/// Whether shaders count.
bool ArePathRaysCounted();

class FPathRayCounter : public TGpuStatistics<FPathRayStatistics, FPathRayCounts>
{
public:
	explicit FPathRayCounter(IRTDevice& InDevice);
};

} // namespace Lantern
