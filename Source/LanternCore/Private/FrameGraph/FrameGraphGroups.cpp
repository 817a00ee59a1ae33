// Groups of passes that may run at the same time: they are moved together, and no barrier lies between them.
#include <algorithm>

#include "FrameGraph/FrameGraphImpl.h"
#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarGroups("r.RT.FrameGraph.Groups", true,
    "Passes of rays that do not need each other run at the same time on one queue, without barriers between them. A few long paths then "
    "keep no others waiting. They have one time together, by the name of their group. Off: one after the other, and each has its own.");

/// Whether one state of a resource serves both uses, in any order. bOneGroup: their passes are of one.
bool CanShareState(const FGraphResource& Resource, const FPassUse& A, const FPassUse& B, bool bOneGroup)
{
	if (!IsWrite(A.GetAccess()) && !IsWrite(B.GetAccess())) { return SharesLayout(Resource, A.GetAccess(), B.GetAccess()); }
	return bOneGroup && AreApart(A, B);
}
} // namespace

bool FFrameGraph::FImpl::AreOrdered(const FGraphPass& Earlier, const FGraphPass& Later) const
{
	const bool bOneGroup = !Earlier.Group.empty() && Earlier.Group == Later.Group;
	for (const FPassUse& Use : Earlier.Uses)
	{
		const FPassUse* const Other = Later.Find(Use.Resource);
		if (Other && !CanShareState(Resources[Use.Resource], Use, *Other, bOneGroup)) { return true; }
	}
	return AreOrderedByTokens(Earlier, Later);
}

bool FFrameGraph::FImpl::JoinGroup(FGroupRun& Run, uint32_t Joining)
{
	// What the pass needs of the passes in between goes before the group.
	std::vector<uint32_t> Moved{Joining};
	for (uint32_t Between = Joining; --Between > Run.Last;)
	{
		const FGraphPass& Pass = Passes[Between];
		const auto Needs = [&](uint32_t Index) { return AreOrdered(Pass, Passes[Index]); };
		if (!Pass.bCulled && std::any_of(Moved.begin(), Moved.end(), Needs)) { Moved.push_back(Between); }
	}
	for (uint32_t Member = Run.First; Member <= Run.Last; ++Member)
	{
		const auto Needs = [&](uint32_t Index) { return AreOrdered(Passes[Member], Passes[Index]); };
		if (std::any_of(Moved.begin(), Moved.end(), Needs)) { return false; }
	}
	std::sort(Moved.begin(), Moved.end());
	std::vector<FGraphPass> Order;
	Order.reserve(Joining + 1 - Run.First);
	const auto Take = [&](uint32_t Index) { Order.push_back(std::move(Passes[Index])); };
	for (const uint32_t Index : Moved)
	{
		if (Index != Joining) { Take(Index); }
	}
	for (uint32_t Index = Run.First; Index <= Run.Last; ++Index) { Take(Index); }
	Take(Joining);
	for (uint32_t Index = Run.Last + 1; Index < Joining; ++Index)
	{
		if (!std::binary_search(Moved.begin(), Moved.end(), Index)) { Take(Index); }
	}
	std::move(Order.begin(), Order.end(), Passes.begin() + Run.First);
	const auto Before = static_cast<uint32_t>(Moved.size() - 1);
	Run.First += Before;
	Run.Last += Before + 1;
	return true;
}

void FFrameGraph::FImpl::GatherGroups()
{
	if (bAnyAsync || !CVarGroups.GetOnRenderThread()) { return; } // another queue's passes are waited for by submissions
	for (uint32_t First = AheadCount; First < Passes.size(); ++First)
	{
		if (Passes[First].bCulled || Passes[First].Group.empty()) { continue; }
		FGroupRun Run{First, First};
		for (uint32_t Next = First + 1; Next < Passes.size(); ++Next)
		{
			if (Passes[Next].bCulled || Passes[Next].Group != Passes[Run.First].Group) { continue; }
			(void)JoinGroup(Run, Next); // one that cannot runs where it was
		}
		if (Run.Last > Run.First) { GroupRuns.push_back(Run); }
		First = Run.Last;
	}
}

const FGroupRun* FFrameGraph::FImpl::FindRun(uint32_t Pass) const
{
	const auto It = std::find_if(GroupRuns.begin(), GroupRuns.end(), [&](const FGroupRun& Run) { return Run.Contains(Pass); });
	return It != GroupRuns.end() ? &*It : nullptr;
}

void FFrameGraph::FImpl::HoistBarriersOfGroups()
{
	for (const FGroupRun& Run : GroupRuns)
	{
		std::vector<FGraphBarrier>& All = Passes[Run.First].Barriers;
		for (uint32_t Index = Run.First + 1; Index <= Run.Last; ++Index)
		{
			std::vector<FGraphBarrier>& Own = Passes[Index].Barriers;
			All.insert(All.end(), Own.begin(), Own.end());
			Own.clear();
		}
	}
}

} // namespace Lantern
