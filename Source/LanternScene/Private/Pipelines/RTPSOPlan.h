// What a link is to consist of.
#pragma once

#include <vector>

#include "Pipelines/RTPSOUnitSet.h"

namespace Lantern
{

/// The builds of a link. Holds no unit, so that a thread without the lock can use it.
struct FLinkPlan
{
	struct FHit
	{
		FHitProgram Program;
		ERTHitState State = ERTHitState::Missing;
		std::vector<FPipelineBuildRef> Builds; ///< by ray type; null: the group runs nothing
	};
	std::vector<FShaderSource> RayGenSources; ///< of RayGens
	std::vector<FPipelineBuildRef> RayGens, Misses, Callables;
	std::vector<FHit> Hits, StandIns;
	uint32_t PayloadBytes = 0;
	bool bStandardServes = false; ///< see FRTPSOLayout
	std::vector<uint64_t> Key;    ///< two plans with equal keys make the same pipeline
	bool bComplete = false;       ///< a pipeline can be linked from it
};

/// The plan of what is compiled now. Units and Desc: of the same FRTPSOUnitSet, under its lock.
FLinkPlan MakeLinkPlan(const FWantedUnits& Units, const FRTPSODesc& Desc, bool bStandardServes);

/// Whether a pipeline of Made serves a frame that Plan is for, hit programs left aside.
bool CoversFrame(const FLinkPlan& Made, const FLinkPlan& Plan);

/// Counts the hit programs that are ready in Plan and are missing or older in Made.
size_t CountNewPrograms(const FLinkPlan& Made, const FLinkPlan& Plan);

} // namespace Lantern
