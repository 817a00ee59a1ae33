// Compiles declarations to a plan: reports errors, culls passes, computes lifetimes, and places barriers.
#include <algorithm>

#include "FrameGraph/FrameGraphImpl.h"
#include "FrameGraph/FrameGraphPoison.h"

namespace Lantern
{

FRTStatus FFrameGraph::FImpl::ValidateUse(const FGraphPass& Pass, const FPassUse& Use, const std::vector<bool>& Written) const
{
	const FGraphResource& Resource = Resources[Use.Resource];
	const ERTAccess Access = Use.GetAccess();
	const auto Fail = [&](const char* Why) {
		return FRTStatus::Error(ERTResult::InvalidArgument, "Frame graph: pass '%s', %s: %s (%s)", Pass.Name.c_str(),
		    Resource.Describe().c_str(), Why, ToString(Access).c_str());
	};
	if (IsWrite(Use.Read)) { return Fail("declares a writing access with Read()"); }
	if (Use.Write != ERTAccess::None && !IsWrite(Use.Write)) { return Fail("declares a reading access with Write()"); }
	if (!CanCombine(Access)) { return Fail("combines accesses that exclude each other"); }
	if (HasAny(Access, Resource.bTexture ? BufferOnlyAccesses : TextureOnlyAccesses))
	{
		return Fail(Resource.bTexture ? "uses a texture as only a buffer can be" : "uses a buffer as only a texture can be");
	}
	if (!Resource.bImported && HasAny(Access, ERTAccess::HostRead))
	{
		return Fail("reads a transient buffer on the host; import a readback buffer");
	}
	// An imported buffer in None may have been filled by the host; a texture cannot.
	const bool bFilled = Written[Use.Resource] || (Resource.bImported && (!Resource.bTexture || Resource.Current != ERTAccess::None));
	if (Use.Read != ERTAccess::None && !bFilled) { return Fail("reads what no pass before it writes"); }
	return FRTStatus::Success();
}

FRTStatus FFrameGraph::FImpl::Validate() const
{
	std::vector<bool> Written(Resources.size(), false);
	for (const FGraphPass& Pass : Passes)
	{
		if (!Pass.BadUse.empty())
		{
			return FRTStatus::Error(ERTResult::InvalidArgument, "Frame graph: pass '%s' %s", Pass.Name.c_str(), Pass.BadUse.c_str());
		}
		for (const uint32_t Kept : Pass.Keeps)
		{
			if (!Resources[Kept].bForLater)
			{
				return FRTStatus::Error(ERTResult::InvalidArgument,
				    "Frame graph: pass '%s' keeps %s, which MarkForLater was not called for", Pass.Name.c_str(),
				    Resources[Kept].Describe().c_str());
			}
		}
		for (const FPassUse& Use : Pass.Uses)
		{
			const FRTStatus Status = ValidateUse(Pass, Use, Written);
			if (!Status) { return Status; }
		}
		for (const FPassUse& Use : Pass.Uses) { Written[Use.Resource] = Written[Use.Resource] || Use.Write != ERTAccess::None; }
	}
	return FRTStatus::Success();
}

FRTStatus FFrameGraph::FImpl::AddPoison()
{
	FPoisonPass Poison(Resources);
	const FRTStatus Status = Poison.Find(Shared.Poison);
	if (!Status || Poison.IsEmpty()) { return Status; }
	FGraphPass& Pass = *Passes.insert(Passes.begin(), Poison.Make());
	for (uint32_t Token = 0; Token < TokenCount; ++Token) { Pass.TokensUnused.push_back(Token); }
	return Status;
}

void FFrameGraph::FImpl::Cull()
{
	// A resource that a pass keeps for the next frame is needed at the end of this one. A pass that writes it may keep more
	// resources, hence the loop until nothing is added.
	std::vector<bool> Kept(Resources.size(), false);
	for (bool bChanged = true; bChanged;)
	{
		CullWhatNobodyReads(Kept);
		bChanged = false;
		for (const FGraphPass& Pass : Passes)
		{
			for (const uint32_t Resource : Pass.Keeps)
			{
				bChanged |= !Pass.bCulled && !Kept[Resource];
				Kept[Resource] = Kept[Resource] || !Pass.bCulled;
			}
		}
	}
	DropUnreadOutputs();
	ReportWritten();
}

void FFrameGraph::FImpl::CullWhatNobodyReads(std::vector<bool> Needed)
{
	// Backwards: a pass runs if a later pass that runs reads what it writes. Earlier writes stay needed, since a write may cover
	// only a part.
	const auto IsWanted = [&](const FPassUse& Use) {
		const FGraphResource& Resource = Resources[Use.Resource];
		const bool bSeenOutside = Resource.bImported && !Resource.bForLater;
		return Use.Write != ERTAccess::None && (bSeenOutside || Needed[Use.Resource]);
	};
	for (auto Pass = Passes.rbegin(); Pass != Passes.rend(); ++Pass)
	{
		Pass->bCulled = !Pass->bNeverCull && std::none_of(Pass->Uses.begin(), Pass->Uses.end(), IsWanted);
		for (const FPassUse& Use : Pass->Uses)
		{
			Needed[Use.Resource] = Needed[Use.Resource] || (!Pass->bCulled && Use.Read != ERTAccess::None);
		}
	}
}

void FFrameGraph::FImpl::DropUnreadOutputs()
{
	std::vector<bool> Needed(Resources.size(), false);
	for (auto Pass = Passes.rbegin(); Pass != Passes.rend(); ++Pass)
	{
		if (Pass->bCulled) { continue; }
		const auto IsUnread = [&](const FPassUse& Use) {
			// A resource that the pass itself reads must keep its content.
			const bool bOutput = Use.bIfRead && Use.Read == ERTAccess::None && !Resources[Use.Resource].bImported;
			const bool bDrop = bOutput && !Needed[Use.Resource];
			if (bDrop) { Pass->Dropped.push_back(Use.Resource); }
			return bDrop;
		};
		std::erase_if(Pass->Uses, IsUnread);
		for (const FPassUse& Use : Pass->Uses)
		{
			Needed[Use.Resource] = true; // also what is written once more: by then it must be there
		}
	}
}

void FFrameGraph::FImpl::ReportWritten() const
{
	for (uint32_t Index = 0; Index < Resources.size(); ++Index)
	{
		if (!Resources[Index].OutWritten) { continue; }
		const auto Writes = [&](const FGraphPass& Pass) {
			const FPassUse* const Use = Pass.Find(Index);
			return !Pass.bCulled && Use && Use->Write != ERTAccess::None;
		};
		*Resources[Index].OutWritten = std::any_of(Passes.begin(), Passes.end(), Writes);
	}
}

void FFrameGraph::FImpl::FindLifetimes()
{
	for (uint32_t Index = 0; Index < Passes.size(); ++Index)
	{
		for (const FPassUse& Use : Passes[Index].Uses)
		{
			FGraphResource& Resource = Resources[Use.Resource];
			if (!Passes[Index].bCulled)
			{
				Resource.FirstPass = std::min(Resource.FirstPass, Index);
				Resource.LastPass = Index;
				Resource.AllAccess |= Use.GetAccess();
			}
		}
	}
}

FRTStatus FFrameGraph::FImpl::Allocate()
{
	for (uint32_t Index = 0; Index < Passes.size(); ++Index)
	{
		if (Passes[Index].bCulled) { continue; }
		for (const FPassUse& Use : Passes[Index].Uses)
		{
			FGraphResource& Resource = Resources[Use.Resource];
			if (Resource.bImported || Resource.FirstPass != Index) { continue; }
			const FRTStatus Status = Shared.Acquire(Resource.MakeKey(), Resource.Name, this, Resource.Pooled);
			if (!Status)
			{
				return FRTStatus::Error(Status.Code, "Frame graph: cannot create %s for pass '%s': %s", Resource.Describe().c_str(),
				    Passes[Index].Name.c_str(), Status.Message);
			}
		}
		// No member of a group may have the memory of another.
		const FGroupRun* const Run = FindRun(Index);
		if (!Run) { ReleaseBehind(Index, Index); }
		else if (Run->Last == Index) { ReleaseBehind(Run->First, Run->Last); }
	}
	return FRTStatus::Success();
}

void FFrameGraph::FImpl::ReleaseBehind(uint32_t First, uint32_t Last)
{
	for (uint32_t Index = First; Index <= Last; ++Index)
	{
		for (const FPassUse& Use : Passes[Index].Uses)
		{
			const FGraphResource& Resource = Resources[Use.Resource];
			if (!Resource.bImported && Resource.LastPass <= Last) { Resource.Pooled->bBusy = false; }
		}
	}
}

bool SharesLayout(const FGraphResource& Resource, ERTAccess A, ERTAccess B)
{
	return !Resource.bTexture || GetLayoutClass(A) == GetLayoutClass(B);
}

void FFrameGraph::FImpl::PlaceBarriers()
{
	std::vector<std::vector<FStateUse>> Uses(Resources.size());
	// In order of first use, so that the earlier of two users of one pooled resource comes first.
	std::vector<uint32_t> Order;
	for (uint32_t Index = 0; Index < Passes.size(); ++Index)
	{
		for (const FPassUse& Use : Passes[Index].Uses)
		{
			if (Passes[Index].bCulled) { continue; }
			if (Uses[Use.Resource].empty()) { Order.push_back(Use.Resource); }
			Uses[Use.Resource].push_back({Index, Use});
		}
	}
	for (const uint32_t Resource : Order) { PlaceBarriersOf(Resource, Uses[Resource]); }
	for (uint32_t Index = 0; Index < Resources.size(); ++Index)
	{
		if (Uses[Index].empty() && Resources[Index].bImported) { PlaceBarriersOf(Index, {}); }
	}
	HoistBarriersOfGroups();
	for (FGraphPass& Pass : Passes)
	{
		std::sort(Pass.Barriers.begin(), Pass.Barriers.end(),
		    [](const FGraphBarrier& A, const FGraphBarrier& B) { return A.Resource < B.Resource; });
	}
}

void FFrameGraph::FImpl::PlaceBarriersOf(uint32_t Index, const std::vector<FStateUse>& Uses)
{
	const FGraphResource& Resource = Resources[Index];

	// The old content of a pooled resource is discarded, but the work of its previous user must have finished.
	ERTAccess State = Resource.Current;
	FStateUsers OwnUsers;
	FStateUsers& Users = Resource.Pooled ? PooledUsers[Resource.Pooled.get()] : OwnUsers;
	if (Resource.Pooled)
	{
		const auto Known = PooledAccess.try_emplace(Resource.Pooled.get(), Resource.Pooled->LastAccess);
		State = Known.first->second;
	}
	for (size_t Begin = 0; Begin < Uses.size();)
	{
		// Consecutive reads become one state, which one barrier enters.
		ERTAccess Access = Uses[Begin].GetAccess();
		size_t End = Begin + 1;
		while (!IsWrite(Access) && End < Uses.size() && !IsWrite(Uses[End].GetAccess()) &&
		       SharesLayout(Resource, Access, Uses[End].GetAccess()))
		{
			Access |= Uses[End++].GetAccess();
		}
		const FGroupRun* const Run = FindRun(Uses[Begin].Pass);
		while (Run && End < Uses.size() && Run->Contains(Uses[End].Pass) && AreApart(Uses[Begin].Use, Uses[End].Use)) { ++End; }
		const bool bCovered = !IsWrite(State) && !IsWrite(Access) && Contains(State, Access) && SharesLayout(Resource, State, Access);
		const bool bFresh = State == ERTAccess::None && !Resource.bTexture;
		if (!bCovered)
		{
			const bool bOtherQueue = EnterState(Users, Uses[Begin].Pass);
			if (!bFresh) { Passes[Uses[Begin].Pass].Barriers.push_back({Index, State, Access, bOtherQueue}); }
			State = Access;
		}
		for (; Begin < End; ++Begin) { UseState(Users, Uses[Begin].Pass); }
	}
	if (Resource.Pooled) { PooledAccess[Resource.Pooled.get()] = State; }
	// Leaves exactly After, even if the current state includes it: the engine's next barrier names After alone.
	const bool bNothingToWaitFor = State == ERTAccess::None && !Resource.bTexture;
	if (Resource.bImported && Resource.After != ERTAccess::None && (Resource.After != State || State == ERTAccess::External) &&
	    !bNothingToWaitFor)
	{
		const auto IsAsync = [&](uint32_t Pass) { return Passes[Pass].Queue != ERTQueue::Graphics; };
		FinalBarriers.push_back({Index, State, Resource.After, std::any_of(Users.Passes.begin(), Users.Passes.end(), IsAsync)});
	}
}

} // namespace Lantern
