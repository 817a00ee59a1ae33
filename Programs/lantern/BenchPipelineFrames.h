// The frames' part of `lantern bench rtpso`: how long they take while every material of the scene is being compiled.
#pragma once

#include <vector>

#include "LanternHost/SampleEngine.h"

namespace Lantern
{

struct FHitchRun
{
	std::vector<double> IdleMs;      ///< frames before anything is to be compiled
	std::vector<double> CompilingMs; ///< frames from the moment all materials change until all are ready
	uint32_t Ready = 0;              ///< materials that are, at the end
};

/// Threads: of the compiler; 0: its own choice. Frames begin PaceMs apart, or as soon as the one before is done.
FRTStatus MeasureHitches(IRTDevice& Device, const FRendererDesc& Desc, uint32_t Materials, uint32_t Threads, double PaceMs, FHitchRun& Out);

} // namespace Lantern
