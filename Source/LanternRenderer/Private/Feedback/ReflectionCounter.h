// Counts what becomes of the paths of reflections: r.RT.Rays.CountEnds. If it is off, nothing is allocated.
#pragma once

#include "Feedback/GpuStatistics.h"
#include "LanternRenderer/FrameCounts.h"
#include "ReflectionTypes.h"

namespace Lantern
{

/// Whether shaders count.
bool ArePathEndsCounted();

class FReflectionCounter : public TGpuStatistics<FReflectionStatistics, FReflectionCounts>
{
public:
	explicit FReflectionCounter(IRTDevice& InDevice);
};

} // namespace Lantern
