// From the states of units to the plan of a link, and how two plans differ.
#include "Pipelines/RTPSOPlan.h"

#include <algorithm>
#include <map>

namespace Lantern
{

namespace
{
/// False: some ray type is not compiled.
bool TakeBuilds(const FHitUnits& Hit, std::vector<FPipelineBuildRef>& Out)
{
	for (const FUnitStateRef& State : Hit.Types)
	{
		if (State && !State->Ready) { return false; }
		Out.push_back(State ? State->Ready : nullptr);
	}
	return true;
}

void AddGeneral(const FWantedUnits& Units, const FRTPSODesc& Desc, FLinkPlan& Plan)
{
	for (size_t I = 0; I < Units.RayGens.size(); ++I)
	{
		if (!Units.RayGens[I]->Ready) { continue; }
		Plan.RayGens.push_back(Units.RayGens[I]->Ready);
		Plan.RayGenSources.push_back(Desc.RayGens[I]);
	}
	for (const FUnitStateRef& State : Units.Misses)
	{
		Plan.Misses.push_back(State->Ready);
		Plan.bComplete &= State->Ready != nullptr;
	}
	for (const FUnitStateRef& State : Units.Callables)
	{
		const bool bRefused = !State->Ready && State->IsSettled();
		Plan.Callables.push_back(bRefused ? Units.EmptyCallable->Ready : State->Ready);
		Plan.bComplete &= Plan.Callables.back() != nullptr;
	}
	Plan.bComplete &= !Plan.RayGens.empty();
}

void AddHits(const FWantedUnits& Units, FLinkPlan& Plan)
{
	for (const FHitUnits& Hit : Units.StandIns)
	{
		FLinkPlan::FHit Entry{Hit.Program, ERTHitState::StandIn, {}};
		if (TakeBuilds(Hit, Entry.Builds)) { Plan.StandIns.push_back(std::move(Entry)); }
		else
		{
			// A pipeline without a stand-in that is still to come would leave holes. A stand-in that does not compile delays nothing.
			const auto IsSettled = [](const FUnitStateRef& State) { return !State || State->IsSettled(); };
			Plan.bComplete &= std::all_of(Hit.Types.begin(), Hit.Types.end(), IsSettled);
		}
	}
	for (const FHitUnits& Hit : Units.Hits)
	{
		FLinkPlan::FHit Entry{Hit.Program, ERTHitState::Ready, {}};
		if (!TakeBuilds(Hit, Entry.Builds)) { Entry = {Hit.Program, ERTHitState::Missing, {}}; }
		Plan.Hits.push_back(std::move(Entry));
	}
}

void AppendKey(FLinkPlan& Plan, const std::vector<FPipelineBuildRef>& Builds)
{
	Plan.Key.push_back(Builds.size());
	for (const FPipelineBuildRef& Build : Builds) { Plan.Key.push_back(Build ? Build->Id : 0); }
}

void AppendKey(FLinkPlan& Plan, const std::vector<FLinkPlan::FHit>& Hits)
{
	Plan.Key.push_back(Hits.size());
	for (const FLinkPlan::FHit& Hit : Hits)
	{
		Plan.Key.push_back(uint64_t(Hit.Program.Program) * 16 + uint64_t(Hit.Program.Class) * 4 + uint64_t(Hit.State));
		AppendKey(Plan, Hit.Builds);
	}
}
} // namespace

FLinkPlan MakeLinkPlan(const FWantedUnits& Units, const FRTPSODesc& Desc, bool bStandardServes)
{
	FLinkPlan Plan;
	Plan.PayloadBytes = GetPayloadBytes(Desc);
	Plan.bStandardServes = bStandardServes;
	Plan.bComplete = !Units.Misses.empty();
	AddGeneral(Units, Desc, Plan);
	AddHits(Units, Plan);
	Plan.Key.push_back(bStandardServes);
	for (const auto* List : {&Plan.RayGens, &Plan.Misses, &Plan.Callables}) { AppendKey(Plan, *List); }
	for (const auto* List : {&Plan.StandIns, &Plan.Hits}) { AppendKey(Plan, *List); }
	return Plan;
}

bool CoversFrame(const FLinkPlan& Made, const FLinkPlan& Plan)
{
	if (Made.bStandardServes != Plan.bStandardServes || Made.Misses != Plan.Misses || Made.Callables != Plan.Callables ||
	    Made.StandIns.size() != Plan.StandIns.size())
	{
		return false;
	}
	for (const FPipelineBuildRef& Build : Plan.RayGens)
	{
		if (std::find(Made.RayGens.begin(), Made.RayGens.end(), Build) == Made.RayGens.end()) { return false; }
	}
	for (size_t I = 0; I < Plan.StandIns.size(); ++I)
	{
		if (Made.StandIns[I].Program != Plan.StandIns[I].Program || Made.StandIns[I].Builds != Plan.StandIns[I].Builds) { return false; }
	}
	return true;
}

size_t CountNewPrograms(const FLinkPlan& Made, const FLinkPlan& Plan)
{
	std::map<FHitProgram, const FLinkPlan::FHit*> Hits;
	for (const FLinkPlan::FHit& Hit : Made.Hits) { Hits[Hit.Program] = &Hit; }
	const auto IsNew = [&](const FLinkPlan::FHit& Hit) {
		const auto Found = Hits.find(Hit.Program);
		return Hit.State == ERTHitState::Ready && (Found == Hits.end() || Found->second->Builds != Hit.Builds);
	};
	return static_cast<size_t>(std::count_if(Plan.Hits.begin(), Plan.Hits.end(), IsNew));
}

} // namespace Lantern
