// The frames' part of `lantern bench rtpso`: how long they take while every material of the scene is being compiled.
#pragma once

#include <vector>

#include "Bench/BenchWorstFrames.h"
#include "LanternHost/SampleEngine.h"

namespace Lantern
{

/// A frame by the clock, and what of it the render thread had a processor for. The rest is waiting: for the GPU, for a
/// lock, or for other programs on a busy machine.
struct FFrameTime
{
	double Ms = 0.0, ProcessorMs = 0.0;
};

struct FHitchRun
{
	std::vector<FFrameTime> Idle;      ///< frames before anything is to be compiled
	std::vector<FFrameTime> Compiling; ///< frames from the moment all materials change until all are ready
	uint32_t Ready = 0;                ///< materials that are, at the end
	uint64_t Swaps = 0;                ///< of pipelines, until then
	double ArrivedSeconds = 0.0;       ///< until then, and the GPU is done
	/// Duration of one frame that waits until all materials are compiled, to its end on the GPU. They differ in one constant
	/// from those of Compiling.
	double OnceSeconds = 0.0;
	FWorstFrames Worst; ///< of Compiling, if a trace is recorded
};

/// Threads: of the compiler; 0: its own choice. Frames begin PaceMs apart, or as soon as the one before is done.
FRTStatus MeasureHitches(IRTDevice& Device, const FRendererDesc& Desc, uint32_t Materials, uint32_t Threads, double PaceMs, FHitchRun& Out);

} // namespace Lantern
