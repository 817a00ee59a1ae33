// Counts what becomes of radiance cells, and of look-ups: r.RT.GI.Cells.Count. If it is off, nothing is allocated.
#pragma once

#include "Feedback/GpuCounters.h"
#include "LanternRenderer/Renderer.h"

namespace Lantern
{

/// Belongs to one renderer, which calls it as FGpuCounters says. Render thread.
class FRadianceCellCounter
{
public:
	explicit FRadianceCellCounter(IRTDevice& InDevice) : Counters(InDevice, "RadianceCellStatistics") {}

	void BeginFrame(uint32_t FlightIndex);
	/// Counts in this frame, if r.RT.GI.Cells.Count is on. OutOfMemory: nothing is counted.
	FRTStatus Start();
	FGpuCounters& GetCounters() { return Counters; }
	/// Takes the counts of frames that are still in flight, after they have ended on the GPU.
	void TakeAll();
	const FRadianceCellCounts& Get() const { return Counts; }

private:
	void Take(std::span<const uint32_t> Frame);

	FGpuCounters Counters;
	FRadianceCellCounts Counts;
};

} // namespace Lantern
