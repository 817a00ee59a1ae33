// Tells the RTPSO's compiler which material programs matter most among those that are not ready. It knows how many rays hit
// their stand-ins, and how near their objects are. Nothing waits: the GPU counts and is read two frames later, and each frame
// looks at a part of the scene. It costs nothing while nothing is missing.
#pragma once

#include "Feedback/GpuCounters.h"
#include "LanternScene/Pipelines/RTPSOCompiler.h"
#include "LanternScene/Scene/Scene.h"

namespace Lantern
{

/// Belongs to one renderer, which calls GetCounters() as FGpuCounters says. Render thread.
class FStandInFeedback
{
public:
	explicit FStandInFeedback(IRTDevice& InDevice) : Counters(InDevice, "StandInHits") {}

	/// FlightIndex: as in TReadbackRing::BeginFrame.
	void BeginFrame(uint32_t FlightIndex, const FRTScene& Scene);
	/// Counts in this frame, of which some hit program is not ready, and looks at a part of the scene. OutOfMemory: nothing is
	/// counted.
	FRTStatus Start(const FRTScene& Scene, glm::dvec3 Camera);
	/// Has a count for each material of the scene.
	FGpuCounters& GetCounters() { return Counters; }
	/// By program, as of the newest counts.
	const std::vector<FProgramPriority>& GetPriorities() const { return Priorities; }

private:
	void Take(const FRTScene& Scene, std::span<const uint32_t> Hits);
	void LookAtObjects(const FRTScene& Scene, glm::dvec3 Camera);
	FProgramPriority& PriorityOf(uint32_t Program);

	FGpuCounters Counters;
	std::vector<FProgramPriority> Priorities;
	std::vector<float> Nearest; // by program, in the look through the scene that is under way
	uint32_t NextObject = 0;
};

} // namespace Lantern
