// Counts how often alpha tests run under rays: r.RT.Opacity.Count. If it is off, shaders do not contain it and nothing is
// allocated.
#pragma once

#include "Feedback/GpuCounters.h"
#include "LanternRenderer/Renderer.h"

namespace Lantern
{

/// Belongs to one renderer, which calls it as FGpuCounters says. Render thread.
class FAnyHitCounter
{
public:
	explicit FAnyHitCounter(IRTDevice& InDevice) : Counters(InDevice, "AnyHits") {}

	/// Returns the defines of all shaders that have alpha tests: with them they count.
	static std::vector<std::pair<std::string, std::string>> GetDefines();

	void BeginFrame(uint32_t FlightIndex);
	/// Counts in this frame, if r.RT.Opacity.Count is on. OutOfMemory: nothing is counted.
	FRTStatus Start() { return IsWanted() ? Counters.Start(1) : FRTStatus::Success(); }
	FGpuCounters& GetCounters() { return Counters; }
	/// Counts frames that are still in flight, after they have ended on the GPU.
	void TakeAll();
	const FAnyHitCounts& Get() const { return Counts; }

private:
	static bool IsWanted();
	void Take(std::span<const uint32_t> Frame);

	FGpuCounters Counters;
	FAnyHitCounts Counts;
};

} // namespace Lantern
