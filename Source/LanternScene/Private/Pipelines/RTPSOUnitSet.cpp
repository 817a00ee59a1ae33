// Which units a description consists of, and what is known of each.
#include "Pipelines/RTPSOUnitSet.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace Lantern
{

bool FRTPSOUnitSet::SetWanted(const FRTPSODesc& Desc, bool bMayUseLibraries, std::optional<bool> StandIns, uint64_t Frame)
{
	const bool bLibraries = Capabilities.bPipelineLibraries && bMayUseLibraries;
	const bool bSame = Desc == WantedDesc && Programs.GetEdits() == WantedEdits && bLibraries == bWantedLibraries && !Wanted.All.empty();
	const bool bStandIns = StandIns.value_or(bSame && bWantedStandIns);
	if (bSame && bStandIns == bWantedStandIns) { return false; }
	const bool bSameGroups = Desc.RayTypes == WantedDesc.RayTypes && Programs.GetEdits() == WantedEdits && bLibraries == bWantedLibraries;
	if (!bSameGroups) { HitUnits.clear(); }
	WantedDesc = Desc;
	WantedEdits = Programs.GetEdits();
	bWantedLibraries = bLibraries;
	bWantedStandIns = bStandIns;
	CollectWanted(Frame);
	return true;
}

FUnitStateRef FRTPSOUnitSet::FindUnit(FPipelineUnit Unit, bool bHit, bool bEmptyGroup)
{
	const bool bLibrary = bWantedLibraries && (bHit || Capabilities.bLibraryOnlyPipelines);
	const uint32_t PayloadBytes = GetPayloadBytes(WantedDesc);
	const std::string Key =
	    (bLibrary ? "library " + std::to_string(PayloadBytes) : std::string("code")) + (bEmptyGroup ? " + " : " ") + Unit.Key;
	FUnitStateRef& State = Units[Key];
	if (!State)
	{
		State = std::make_shared<FUnitState>();
		State->bLibrary = bLibrary;
		State->bEmptyGroup = bLibrary && bEmptyGroup;
		State->PayloadBytes = PayloadBytes;
	}
	State->Unit = std::move(Unit);
	return State;
}

FHitUnits FRTPSOUnitSet::FindHitUnits(FHitProgram Program)
{
	const auto [It, bNew] = HitUnits.try_emplace(Program);
	if (!bNew) { return It->second; }
	It->second.Program = Program;
	for (uint32_t Type = 0; Type < WantedDesc.RayTypes.size(); ++Type)
	{
		FPipelineUnit Unit = MakeHitUnit(WantedDesc, Type, Program, Programs);
		FUnitStateRef& State = It->second.Types.emplace_back();
		if (Unit.Shaders.empty()) { continue; }
		State = FindUnit(std::move(Unit), true, false);
		State->Program = Program.Program;
		State->bEssential |= Program.Program == StandardProgram; // a unit that programs share is essential if it is for any
	}
	return It->second;
}

FHitUnits FRTPSOUnitSet::FindStandInUnits(ERTHitClass Class)
{
	FHitUnits StandIn;
	StandIn.Program = {StandardProgram, Class};
	for (uint32_t Type = 0; Type < WantedDesc.RayTypes.size(); ++Type)
	{
		FPipelineUnit Unit = MakeStandInUnit(WantedDesc, Type, Class, Programs);
		FUnitStateRef& State = StandIn.Types.emplace_back();
		if (Unit.Shaders.empty()) { continue; }
		State = FindUnit(std::move(Unit), true, false);
		State->bEssential = true;
	}
	return StandIn;
}

void FRTPSOUnitSet::CollectGeneral(uint64_t Frame)
{
	const auto Take = [&](FPipelineUnit Unit, bool bEmptyGroup, bool bEssential) {
		FUnitStateRef State = FindUnit(std::move(Unit), false, bEmptyGroup);
		State->bEssential = bEssential;
		Want(State, Frame);
		return State;
	};
	for (uint32_t I = 0; I < WantedDesc.RayGens.size(); ++I) { Wanted.RayGens.push_back(Take(MakeRayGenUnit(WantedDesc, I), false, true)); }
	for (uint32_t I = 0; I < WantedDesc.RayTypes.size(); ++I) { Wanted.Misses.push_back(Take(MakeMissUnit(WantedDesc, I), I == 0, true)); }
	for (uint32_t I = 0; I < WantedDesc.Callables.size(); ++I)
	{
		Wanted.Callables.push_back(Take(MakeCallableUnit(WantedDesc, I), false, false));
	}
	if (!WantedDesc.Callables.empty()) { Wanted.EmptyCallable = Take(MakeEmptyCallableUnit(), false, true); }
}

void FRTPSOUnitSet::Want(const FUnitStateRef& State, uint64_t Frame)
{
	if (!State || State->bWanted) { return; }
	State->bWanted = true;
	State->LastWanted = Frame;
	Wanted.All.push_back(State);
}

void FRTPSOUnitSet::CollectWanted(uint64_t Frame)
{
	for (const FUnitStateRef& State : Wanted.All) { State->bWanted = false; }
	Wanted = {};
	CollectGeneral(Frame);
	bool bClasses[HitClassCount] = {};
	for (const FHitProgram Program : WantedDesc.HitPrograms)
	{
		Wanted.Hits.push_back(FindHitUnits(Program));
		for (const FUnitStateRef& State : Wanted.Hits.back().Types) { Want(State, Frame); }
		bClasses[static_cast<uint32_t>(Program.Class)] = true;
	}
	for (uint32_t Class = 0; bWantedStandIns && Class < HitClassCount; ++Class)
	{
		if (!bClasses[Class]) { continue; }
		Wanted.StandIns.push_back(FindStandInUnits(static_cast<ERTHitClass>(Class)));
		for (const FUnitStateRef& State : Wanted.StandIns.back().Types) { Want(State, Frame); }
	}
}

bool FRTPSOUnitSet::ComesBefore(const FUnitState& A, const FUnitState& B) const
{
	if (A.bEssential != B.bEssential) { return A.bEssential; }
	static const FProgramPriority None;
	const FProgramPriority& PriorityA = A.Program < Priorities.size() ? Priorities[A.Program] : None;
	const FProgramPriority& PriorityB = B.Program < Priorities.size() ? Priorities[B.Program] : None;
	if (PriorityA.StandInHits != PriorityB.StandInHits) { return PriorityA.StandInHits > PriorityB.StandInHits; }
	if (PriorityA.Distance != PriorityB.Distance) { return PriorityA.Distance < PriorityB.Distance; }
	return A.Program < B.Program;
}

std::vector<FUnitStateRef> FRTPSOUnitSet::FindMissing(uint64_t Frame) const
{
	std::vector<FUnitStateRef> Missing;
	std::copy_if(Wanted.All.begin(), Wanted.All.end(), std::back_inserter(Missing),
	    [&](const FUnitStateRef& State) { return State->NeedsCompile(Frame); });
	std::stable_sort(Missing.begin(), Missing.end(), [&](const FUnitStateRef& A, const FUnitStateRef& B) { return ComesBefore(*A, *B); });
	return Missing;
}

bool FRTPSOUnitSet::AreHitsReady() const
{
	const auto IsMissing = [](const FUnitStateRef& State) { return State && !State->Ready; };
	return std::none_of(Wanted.Hits.begin(), Wanted.Hits.end(),
	    [&](const FHitUnits& Hit) { return std::any_of(Hit.Types.begin(), Hit.Types.end(), IsMissing); });
}

bool FRTPSOUnitSet::IsAnyToCome(uint64_t Frame) const
{
	return std::any_of(Wanted.All.begin(), Wanted.All.end(),
	    [&](const FUnitStateRef& State) { return State->Work != EUnitWork::Idle || State->NeedsCompile(Frame); });
}

size_t FRTPSOUnitSet::CountSettled() const
{
	const auto IsSettled = [](const FUnitStateRef& State) { return State->IsSettled(); };
	return static_cast<size_t>(std::count_if(Wanted.All.begin(), Wanted.All.end(), IsSettled));
}

FRTStatus FRTPSOUnitSet::FindFatalError() const
{
	for (const FUnitStateRef& State : Wanted.All)
	{
		const bool bFailed = !State->Ready && !State->Error.IsOk();
		const bool bShortage = bFailed && State->FailedVersion != State->GetVersion();
		if (bFailed && (State->bEssential || bShortage)) { return State->Error; }
	}
	return FRTStatus::Success();
}

void FRTPSOUnitSet::ForgetShortages()
{
	for (const FUnitStateRef& State : Wanted.All)
	{
		State->RetryAt = 0;
		State->bBeganBefore = State->Work == EUnitWork::Compiling;
		if (State->FailedVersion != State->GetVersion()) { State->Error = FRTStatus::Success(); }
	}
}

std::vector<FUnitLook> FRTPSOUnitSet::ListSettled() const
{
	std::vector<FUnitLook> Looks;
	for (const auto& [Key, State] : Units)
	{
		if (State->IsSettled()) { Looks.push_back({State, State->Unit, State->ContentKey, State->GetVersion()}); }
	}
	return Looks;
}

bool FRTPSOUnitSet::Reload(const std::vector<FUnitLook>& Edited)
{
	bool bAny = false;
	for (const FUnitLook& Look : Edited)
	{
		if (Look.State->GetVersion() != Look.Version) { continue; }
		++Look.State->Reloads;
		bAny = true;
	}
	return bAny;
}

void FRTPSOUnitSet::DropOld(uint64_t Frame, uint64_t KeepFrames, FTrash& Trash)
{
	for (const FUnitStateRef& State : Wanted.All) { State->LastWanted = Frame; }
	const size_t Dropped = std::erase_if(Units, [&](const auto& Entry) {
		const FUnitState& State = *Entry.second;
		if (State.bWanted || State.Work != EUnitWork::Idle || Frame - State.LastWanted <= KeepFrames) { return false; }
		Trash.Discard(FUnitStateRef(Entry.second));
		return true;
	});
	if (Dropped > 0) { Trash.Discard(std::exchange(HitUnits, {})); }
}

void FRTPSOUnitSet::Count(FRTPSOCompilerStats& Out) const
{
	for (const FUnitStateRef& State : Wanted.All)
	{
		++Out.Wanted;
		Out.Ready += State->Ready ? 1 : 0;
		Out.Failed += !State->Ready && State->FailedVersion == State->GetVersion() ? 1 : 0;
	}
	for (const auto& [Key, State] : Units) { Out.Kept += State->Ready ? 1 : 0; }
}

} // namespace Lantern
