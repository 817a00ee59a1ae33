// What is wanted, in which order, and when rounds begin and end.
#include <algorithm>
#include <cassert>
#include <utility>

#include "LanternCore/Config/ConsoleVariables.h"
#include "Pipelines/RTPSOCompilerImpl.h"

namespace Lantern
{

void FRTPSOCompiler::FImpl::SetWanted(const FRTPSODesc& Desc, std::optional<bool> StandIns)
{
	const bool bLibraries = Device.GetCapabilities().bPipelineLibraries && AreLibrariesOn();
	const bool bSame = Desc == WantedDesc && Programs.GetEdits() == WantedEdits && bLibraries == bWantedLibraries && !Wanted.All.empty();
	const bool bStandIns = StandIns.value_or(bSame && bWantedStandIns);
	if (bSame && bStandIns == bWantedStandIns) { return; }
	const bool bSameGroups = Desc.RayTypes == WantedDesc.RayTypes && Programs.GetEdits() == WantedEdits && bLibraries == bWantedLibraries;
	if (!bSameGroups) { HitSlots.clear(); }
	WantedDesc = Desc;
	WantedEdits = Programs.GetEdits();
	bWantedLibraries = bLibraries;
	bWantedStandIns = bStandIns;
	CollectWanted();
	bDirty = true;
	bFinished = false;
}

FPipelineSlotRef FRTPSOCompiler::FImpl::FindSlot(FPipelineUnit Unit, bool bHit, bool bEmptyGroup)
{
	const bool bLibrary = bWantedLibraries && (bHit || Device.GetCapabilities().bLibraryOnlyPipelines);
	const uint32_t PayloadBytes = GetPayloadBytes(WantedDesc);
	const std::string Key =
	    (bLibrary ? "library " + std::to_string(PayloadBytes) : std::string("code")) + (bEmptyGroup ? " + " : " ") + Unit.Key;
	FPipelineSlotRef& Slot = Slots[Key];
	if (!Slot)
	{
		Slot = std::make_shared<FPipelineSlot>();
		Slot->bLibrary = bLibrary;
		Slot->bEmptyGroup = bLibrary && bEmptyGroup;
		Slot->PayloadBytes = PayloadBytes;
	}
	Slot->Unit = std::move(Unit);
	return Slot;
}

FHitSlots FRTPSOCompiler::FImpl::FindHitSlots(FHitProgram Program)
{
	const auto [It, bNew] = HitSlots.try_emplace(Program);
	if (!bNew) { return It->second; }
	It->second.Program = Program;
	for (uint32_t Type = 0; Type < WantedDesc.RayTypes.size(); ++Type)
	{
		FPipelineUnit Unit = MakeHitUnit(WantedDesc, Type, Program, Programs);
		FPipelineSlotRef& Slot = It->second.Types.emplace_back();
		if (Unit.Shaders.empty()) { continue; }
		Slot = FindSlot(std::move(Unit), true, false);
		Slot->Program = Program.Program;
		Slot->bEssential |= Program.Program == StandardProgram; // what programs share is as essential as the most so
	}
	return It->second;
}

FHitSlots FRTPSOCompiler::FImpl::FindStandInSlots(ERTHitClass Class)
{
	FHitSlots StandIn;
	StandIn.Program = {StandardProgram, Class};
	for (uint32_t Type = 0; Type < WantedDesc.RayTypes.size(); ++Type)
	{
		FPipelineUnit Unit = MakeStandInUnit(WantedDesc, Type, Class, Programs);
		FPipelineSlotRef& Slot = StandIn.Types.emplace_back();
		if (Unit.Shaders.empty()) { continue; }
		Slot = FindSlot(std::move(Unit), true, false);
		Slot->bEssential = true;
	}
	return StandIn;
}

void FRTPSOCompiler::FImpl::CollectGeneral()
{
	const auto Want = [&](FPipelineUnit Unit, bool bEmptyGroup, bool bEssential) {
		FPipelineSlotRef Slot = FindSlot(std::move(Unit), false, bEmptyGroup);
		Slot->bEssential = bEssential;
		WantSlot(Slot);
		return Slot;
	};
	for (uint32_t I = 0; I < WantedDesc.RayGens.size(); ++I) { Wanted.RayGens.push_back(Want(MakeRayGenUnit(WantedDesc, I), false, true)); }
	for (uint32_t I = 0; I < WantedDesc.RayTypes.size(); ++I) { Wanted.Misses.push_back(Want(MakeMissUnit(WantedDesc, I), I == 0, true)); }
	for (uint32_t I = 0; I < WantedDesc.Callables.size(); ++I)
	{
		Wanted.Callables.push_back(Want(MakeCallableUnit(WantedDesc, I), false, false));
	}
	if (!WantedDesc.Callables.empty()) { Wanted.EmptyCallable = Want(MakeEmptyCallableUnit(), false, true); }
}

void FRTPSOCompiler::FImpl::WantSlot(const FPipelineSlotRef& Slot)
{
	if (!Slot || Slot->bWanted) { return; }
	Slot->bWanted = true;
	Slot->LastWanted = Frame;
	Wanted.All.push_back(Slot);
}

void FRTPSOCompiler::FImpl::CollectWanted()
{
	for (const FPipelineSlotRef& Slot : Wanted.All) { Slot->bWanted = false; }
	Wanted = {};
	CollectGeneral();
	bool bClasses[HitClassCount] = {};
	for (const FHitProgram Program : WantedDesc.HitPrograms)
	{
		Wanted.Hits.push_back(FindHitSlots(Program));
		for (const FPipelineSlotRef& Slot : Wanted.Hits.back().Types) { WantSlot(Slot); }
		bClasses[static_cast<uint32_t>(Program.Class)] = true;
	}
	for (uint32_t Class = 0; bWantedStandIns && Class < HitClassCount; ++Class)
	{
		if (!bClasses[Class]) { continue; }
		Wanted.StandIns.push_back(FindStandInSlots(static_cast<ERTHitClass>(Class)));
		for (const FPipelineSlotRef& Slot : Wanted.StandIns.back().Types) { WantSlot(Slot); }
	}
}

bool FRTPSOCompiler::FImpl::NeedsCompile(const FPipelineSlot& Slot) const
{
	return Slot.State == ESlotState::Idle && !Slot.IsSettled() && Frame >= Slot.RetryAt;
}

bool FRTPSOCompiler::FImpl::ComesBefore(const FPipelineSlot& A, const FPipelineSlot& B) const
{
	if (A.bEssential != B.bEssential) { return A.bEssential; }
	static const FProgramPriority None;
	const FProgramPriority& PriorityA = A.Program < Priorities.size() ? Priorities[A.Program] : None;
	const FProgramPriority& PriorityB = B.Program < Priorities.size() ? Priorities[B.Program] : None;
	if (PriorityA.StandInHits != PriorityB.StandInHits) { return PriorityA.StandInHits > PriorityB.StandInHits; }
	if (PriorityA.Distance != PriorityB.Distance) { return PriorityA.Distance < PriorityB.Distance; }
	return A.Program < B.Program;
}

void FRTPSOCompiler::FImpl::StartRound(bool bAppend)
{
	if (bRound && !bAppend) { return; }
	std::vector<FPipelineSlotRef> Missing;
	std::copy_if(Wanted.All.begin(), Wanted.All.end(), std::back_inserter(Missing),
	    [&](const FPipelineSlotRef& Slot) { return NeedsCompile(*Slot); });
	if (Missing.empty()) { return; }
	Pacer.ProgramsAsked(Time());
	std::stable_sort(
	    Missing.begin(), Missing.end(), [&](const FPipelineSlotRef& A, const FPipelineSlotRef& B) { return ComesBefore(*A, *B); });
	for (const FPipelineSlotRef& Slot : Missing)
	{
		Slot->State = ESlotState::Queued;
		Queue.push_back(Slot);
	}
	if (!bRound)
	{
		bRound = true;
		++Stats.Rounds;
		RoundEnd = Time() + std::chrono::milliseconds(RoundMs);
	}
	WorkAdded.notify_all();
}

void FRTPSOCompiler::FImpl::EndRoundIfOver()
{
	if (!bRound) { return; }
	const bool bDone = IsQueueEmpty() && Running == 0;
	const bool bLate = !bNoDeadline && Time() >= RoundEnd;
	if (!bDone && !bLate) { return; }
	for (; NextQueued < Queue.size(); ++NextQueued) { Queue[NextQueued]->State = ESlotState::Idle; }
	Queue.clear();
	NextQueued = 0;
	Discard(std::exchange(Shared, {}));
	bRound = false;
	bDirty = true;
	if (!bNoDeadline) { StartLink(false); }
}

bool FRTPSOCompiler::FImpl::AreHitsCompiled() const
{
	for (const FHitSlots& Hit : Wanted.Hits)
	{
		if (std::any_of(Hit.Types.begin(), Hit.Types.end(), [](const FPipelineSlotRef& Slot) { return Slot && !Slot->Ready; }))
		{
			return false;
		}
	}
	return true;
}

void FRTPSOCompiler::FImpl::StartLink(bool bExact)
{
	if (bLinkWanted || bLinking || bLinkDone || (bRound && !bExact)) { return; }
	bHeld = false;
	FLinkPlan Plan = MakePlan();
	if (!Plan.bComplete) { return; }
	const auto IsCovered = [&] { return CoversFrame(Current.Plan, Plan) && CountNewPrograms(Current.Plan, Plan) == 0; };
	if (Current.Pipeline && (bExact ? Current.Plan.Key == Plan.Key : IsCovered())) { return; }
	if (!bExact && (Plan.Key == FailedLink || HoldBack(Plan))) { return; }
	const auto Found = std::find_if(Recent.begin(), Recent.end(), [&](const FLinkedPipeline& Entry) { return Entry.Plan.Key == Plan.Key; });
	if (Found != Recent.end())
	{
		Linked = std::move(*Found);
		Recent.erase(Found);
		LinkStatus = FRTStatus::Success();
		bLinkDone = true;
		return;
	}
	LinkPlan = std::move(Plan);
	bLinkExact = bExact;
	bLinkWanted = true;
	WorkAdded.notify_all();
}

bool FRTPSOCompiler::FImpl::HoldBack(const FLinkPlan& Plan)
{
	// Where nothing stands in for what is missing, there would be holes meanwhile.
	if (!Current.Pipeline || !bStandardServes || !CoversFrame(Current.Plan, Plan)) { return false; }
	const auto IsReady = [](const FLinkPlan::FHit& Hit) { return Hit.State == ERTHitState::Ready; };
	const auto IsToCome = [&](const FPipelineSlotRef& Slot) { return Slot->State != ESlotState::Idle || NeedsCompile(*Slot); };
	HeldSwap.InUse = static_cast<size_t>(std::count_if(Current.Plan.Hits.begin(), Current.Plan.Hits.end(), IsReady));
	HeldSwap.New = CountNewPrograms(Current.Plan, Plan);
	HeldSwap.bMore = std::any_of(Wanted.All.begin(), Wanted.All.end(), IsToCome);
	bHeld = !Pacer.MayLink(Time(), HeldSwap);
	if (!bHeld) { Pacer.LinkStarted(); }
	return bHeld;
}

void FRTPSOCompiler::FImpl::RetireCurrent()
{
	if (!Current.Pipeline) { return; }
	Current.LastUsed = Frame;
	// Those that were made by and by are not wanted again; those of settings that are switched to and fro are.
	constexpr size_t MostRecent = 8;
	if (!Current.bExact)
	{
		Old.push_back(std::move(Current));
		return;
	}
	Recent.push_front(std::move(Current));
	if (Recent.size() <= MostRecent) { return; }
	Old.push_back(std::move(Recent.back()));
	Recent.pop_back();
}

void FRTPSOCompiler::FImpl::DropOld()
{
	constexpr uint64_t HeldFrames = 4;
	for (; !Old.empty() && Frame - Old.front().LastUsed > HeldFrames; Old.pop_front()) { Discard(std::move(Old.front())); }
	if (!Trash.empty()) { WorkAdded.notify_all(); }
	constexpr uint64_t Interval = 16; // frames; to look at all slots in each would be a waste
	if (Frame % Interval != 0) { return; }
	for (const FPipelineSlotRef& Slot : Wanted.All) { Slot->LastWanted = Frame; }
	const auto IsOld = [&](uint64_t LastUsed) { return Frame - LastUsed > static_cast<uint64_t>(KeepFrames); };
	const size_t Dropped = std::erase_if(Slots, [&](auto& Entry) {
		FPipelineSlot& Slot = *Entry.second;
		if (Slot.bWanted || Slot.State != ESlotState::Idle || !IsOld(Slot.LastWanted)) { return false; }
		Discard(std::move(Entry.second));
		return true;
	});
	Stats.Dropped += Dropped;
	if (Dropped > 0) { Discard(std::exchange(HitSlots, {})); }
	for (; !Recent.empty() && IsOld(Recent.back().LastUsed); Recent.pop_back()) { Discard(std::move(Recent.back())); }
}

} // namespace Lantern
