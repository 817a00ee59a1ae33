// Priorities of material programs that stand-ins serve for.
#include "Feedback/StandInFeedback.h"

#include <algorithm>

namespace Lantern
{

namespace
{
/// A frame's part of the scene: it takes 20 µs.
constexpr uint32_t ObjectsPerFrame = 2048;
} // namespace

FProgramPriority& FStandInFeedback::PriorityOf(uint32_t Program)
{
	if (Program >= Priorities.size()) { Priorities.resize(Program + 1); }
	return Priorities[Program];
}

void FStandInFeedback::BeginFrame(uint32_t FlightIndex, const FRTScene& Scene)
{
	Counters.BeginFrame(FlightIndex, [&](std::span<const uint32_t> Hits) { Take(Scene, Hits); });
}

FRTStatus FStandInFeedback::Start(const FRTScene& Scene, glm::dvec3 Camera)
{
	LookAtObjects(Scene, Camera);
	const uint32_t Count = Scene.GetMaterials().Num();
	return Count > 0 ? Counters.Start(Count) : FRTStatus::Success();
}

void FStandInFeedback::Take(const FRTScene& Scene, std::span<const uint32_t> Hits)
{
	for (FProgramPriority& Priority : Priorities) { Priority.StandInHits = 0; }
	const size_t Known = std::min<size_t>(Hits.size(), Scene.GetMaterials().Num());
	for (uint32_t Material = 0; Material < Known; ++Material)
	{
		if (Hits[Material] > 0) { PriorityOf(Scene.GetMaterialProgram(Material)).StandInHits += Hits[Material]; }
	}
}

void FStandInFeedback::LookAtObjects(const FRTScene& Scene, glm::dvec3 Camera)
{
	const uint32_t Slots = Scene.GetObjectSlotCount();
	for (const uint32_t End = std::min(Slots, NextObject + ObjectsPerFrame); NextObject < End; ++NextObject)
	{
		const FRTObjectInfo* const Object = Scene.FindObject(NextObject);
		if (!Object) { continue; }
		const float Distance = static_cast<float>(glm::distance(glm::dvec3(Object->Transform[3]), Camera));
		for (const uint32_t Material : Object->Materials)
		{
			const uint32_t Program = Scene.GetMaterialProgram(Material);
			if (Program >= Nearest.size()) { Nearest.resize(Program + 1, FProgramPriority().Distance); }
			Nearest[Program] = std::min(Nearest[Program], Distance);
		}
	}
	if (NextObject < Slots) { return; }
	for (uint32_t Program = 0; Program < Nearest.size(); ++Program) { PriorityOf(Program).Distance = Nearest[Program]; }
	Nearest.clear();
	NextObject = 0;
}

} // namespace Lantern
