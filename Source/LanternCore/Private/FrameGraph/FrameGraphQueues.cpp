// Which queue each pass runs on, which passes of other queues it needs, and what is submitted together.
#include <algorithm>
#include <array>

#include "FrameGraph/FrameGraphImpl.h"
#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<std::string> CVarAsync("r.RT.Async", "",
    "Passes that run on the device's compute queue beside the others, by name, with commas between. *: all that can. Empty: none. "
    "A device without such a queue runs all on one.");

bool HasToken(const std::vector<uint32_t>& Tokens, uint32_t Token)
{
	return std::find(Tokens.begin(), Tokens.end(), Token) != Tokens.end();
}

bool IsNamed(const std::string& List, const std::string& Name)
{
	for (size_t Begin = 0; Begin < List.size();)
	{
		const size_t End = std::min(List.find_first_of(", ", Begin), List.size());
		const std::string Item = List.substr(Begin, End - Begin);
		if (Item == "*" || Item == Name) { return true; }
		Begin = End + 1;
	}
	return false;
}
} // namespace

bool AreOrderedByTokens(const FGraphPass& Earlier, const FGraphPass& Later)
{
	const auto Touches = [](const FGraphPass& Pass, uint32_t Token) {
		return HasToken(Pass.TokenWrites, Token) || !HasToken(Pass.TokensUnused, Token);
	};
	const auto WritesUsed = [&](const FGraphPass& Writer, const FGraphPass& User) {
		return std::any_of(Writer.TokenWrites.begin(), Writer.TokenWrites.end(), [&](uint32_t Token) { return Touches(User, Token); });
	};
	return WritesUsed(Earlier, Later) || WritesUsed(Later, Earlier);
}

ERTQueue FindAheadQueue(const IRTDevice& Device)
{
	const bool bAsync = Device.GetCapabilities().bAsyncComputeQueue && !CVarAsync.GetOnRenderThread().empty();
	return bAsync ? ERTQueue::AsyncCompute : ERTQueue::Graphics;
}

void FFrameGraph::FImpl::ChooseAhead()
{
	const std::string& Wanted = CVarAsync.GetOnRenderThread();
	std::vector<const FGraphPass*> Behind;
	for (FGraphPass& Pass : Passes)
	{
		if (Pass.bCulled) { continue; }
		const bool bMay = Pass.bAllowAsync && Pass.Uses.empty() && (AheadQueue == ERTQueue::Graphics || IsNamed(Wanted, Pass.Name));
		Pass.bAhead =
		    bMay && std::none_of(Behind.begin(), Behind.end(), [&](const FGraphPass* Other) { return AreOrderedByTokens(*Other, Pass); });
		if (!Pass.bAhead)
		{
			Behind.push_back(&Pass);
			continue;
		}
		Pass.Queue = AheadQueue;
		bAnyAsync |= AheadQueue != ERTQueue::Graphics;
		++AheadCount;
	}
	std::stable_partition(Passes.begin(), Passes.end(), [](const FGraphPass& Pass) { return Pass.bAhead; });
}

void FFrameGraph::FImpl::AssignQueues()
{
	if (bAhead) { return ChooseAhead(); }
	const std::string& Wanted = CVarAsync.GetOnRenderThread();
	if (!bAsync || Wanted.empty()) { return; }
	for (FGraphPass& Pass : Passes)
	{
		if (Pass.bCulled || !Pass.bAllowAsync || !IsNamed(Wanted, Pass.Name)) { continue; }
		Pass.Queue = ERTQueue::AsyncCompute;
		bAnyAsync = true;
	}
}

bool FFrameGraph::FImpl::EnterState(FStateUsers& Users, uint32_t Pass)
{
	// What an earlier graph did is ordered before all of this one, by a semaphore where the queue is not graphics.
	bool bOther = Users.Passes.empty() && Passes[Pass].Queue != ERTQueue::Graphics;
	for (const uint32_t User : Users.Passes)
	{
		if (!IsOnOtherQueue(User, Pass)) { continue; }
		Passes[Pass].Needs.push_back(User);
		bOther = true;
	}
	Users = {{}, Pass};
	return bOther;
}

void FFrameGraph::FImpl::UseState(FStateUsers& Users, uint32_t Pass)
{
	const bool bNeedsEntry = Users.Entered != NoPass && IsOnOtherQueue(Users.Entered, Pass);
	if (bNeedsEntry) { Passes[Pass].Needs.push_back(Users.Entered); }
	Users.Passes.push_back(Pass);
}

void FFrameGraph::FImpl::OrderTokens()
{
	if (!bAnyAsync) { return; }
	for (uint32_t Token = 0; Token < TokenCount; ++Token)
	{
		FStateUsers Users;
		for (uint32_t Index = 0; Index < Passes.size(); ++Index)
		{
			const FGraphPass& Pass = Passes[Index];
			const bool bWrites = HasToken(Pass.TokenWrites, Token);
			if (Pass.bCulled || (!bWrites && HasToken(Pass.TokensUnused, Token))) { continue; }
			if (bWrites) { (void)EnterState(Users, Index); }
			UseState(Users, Index);
		}
	}
}

std::vector<FFrameGraph::FImpl::FSegment> FFrameGraph::FImpl::MakeSegments(bool bTasks)
{
	std::vector<std::vector<FSegment>> Segments; // by submission
	std::vector<uint32_t> SubmissionOf(Passes.size(), NoPass);
	std::array<uint32_t, PassQueueCount> Open = {NoPass, NoPass}; // submissions that passes may still join, by queue
	const auto Begin = [&](ERTQueue Queue) {
		Open[static_cast<size_t>(Queue)] = static_cast<uint32_t>(Submissions.size());
		Submissions.push_back({Queue, 0, {}, Queue != ERTQueue::Graphics});
		Segments.emplace_back();
		return Open[static_cast<size_t>(Queue)];
	};
	for (uint32_t Index = 0; Index < Passes.size(); ++Index)
	{
		const FGraphPass& Pass = Passes[Index];
		if (Index == AheadCount) { Open.fill(NoPass); }
		if (Pass.bCulled) { continue; }
		uint32_t& Mine = Open[static_cast<size_t>(Pass.Queue)];
		// A submission waits before it begins, and is waited for when it ends. An engine's list is one submission.
		if (Mine == NoPass || (!Pass.Needs.empty() && !bAhead)) { Begin(Pass.Queue); }
		for (const uint32_t Need : Pass.Needs)
		{
			const uint32_t Other = SubmissionOf[Need];
			uint32_t& OpenThere = Open[static_cast<size_t>(Passes[Need].Queue)];
			if (OpenThere == Other) { OpenThere = NoPass; }
			std::vector<uint32_t>& Waits = Submissions[Mine].Waits;
			if (std::find(Waits.begin(), Waits.end(), Other) == Waits.end()) { Waits.push_back(Other); }
		}
		SubmissionOf[Index] = Mine;
		const bool bOnTask = bTasks && Pass.bOnTask && (!bAhead || Pass.bAhead); // an engine's list is one
		std::vector<FSegment>& Lists = Segments[Mine];
		if (Lists.empty() || bOnTask || Lists.back().bOnTask) { Lists.push_back({nullptr, {}, bOnTask}); }
		Lists.back().Passes.push_back(Index);
	}
	// The last submission is the graphics queue's, and it ends when all have ended.
	uint32_t LastAsync = NoPass;
	for (uint32_t Index = 0; Index < Submissions.size(); ++Index)
	{
		if (Submissions[Index].Queue != ERTQueue::Graphics) { LastAsync = Index; }
	}
	const bool bNothingBehind =
	    bAhead && std::all_of(Passes.begin() + AheadCount, Passes.end(), [](const FGraphPass& Pass) { return Pass.bCulled; });
	const bool bGraphicsLast = !Submissions.empty() && Submissions.back().Queue == ERTQueue::Graphics && !bNothingBehind;
	const bool bWaits = bGraphicsLast && std::count(Submissions.back().Waits.begin(), Submissions.back().Waits.end(), LastAsync) > 0;
	if (!bGraphicsLast || (LastAsync != NoPass && !bWaits)) { Begin(ERTQueue::Graphics); }
	if (LastAsync != NoPass && !bWaits) { Submissions.back().Waits.push_back(LastAsync); }
	// The last barriers are this thread's.
	if (Segments.back().empty() || Segments.back().back().bOnTask) { Segments.back().emplace_back(); }
	std::vector<FSegment> All;
	for (uint32_t Index = 0; Index < Submissions.size(); ++Index)
	{
		Submissions[Index].ListCount = static_cast<uint32_t>(Segments[Index].size());
		All.insert(All.end(), Segments[Index].begin(), Segments[Index].end());
	}
	return All;
}

} // namespace Lantern
