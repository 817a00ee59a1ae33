// The states of a link, and which of the pipelines before it are kept.
#include "Pipelines/RTPSOLinkState.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace Lantern
{

bool FRTPSOLinkState::Ask(FLinkPlan Plan, bool bExact)
{
	assert(IsIdle() && Plan.bComplete);
	const auto Found = std::find_if(Recent.begin(), Recent.end(), [&](const FLinkedRTPSO& Entry) { return Entry.Plan.Key == Plan.Key; });
	if (Found != Recent.end())
	{
		Linked = std::move(*Found);
		Recent.erase(Found);
		Status = FRTStatus::Success();
		State = EState::Done;
		return false;
	}
	AskedPlan = std::move(Plan);
	bAskedExact = bExact;
	State = EState::Asked;
	return true;
}

FLinkPlan FRTPSOLinkState::Begin()
{
	assert(IsAsked());
	State = EState::Linking;
	return std::exchange(AskedPlan, {});
}

void FRTPSOLinkState::End(const FRTStatus& Result, std::shared_ptr<const FRTPSO> Pipeline, FLinkPlan Plan, uint64_t Frame)
{
	assert(State == EState::Linking && Result.IsOk() == (Pipeline != nullptr));
	State = EState::Done;
	Status = Result;
	if (Result) { Linked = {std::move(Pipeline), std::move(Plan), bAskedExact, Frame}; }
	else if (Result.Code != ERTResult::DeviceLost) { FailedKey = std::move(Plan.Key); }
}

bool FRTPSOLinkState::Take(uint64_t Frame)
{
	assert(IsDone());
	State = EState::Idle;
	if (!Status) { return false; }
	RetireCurrent(Frame);
	Current = std::exchange(Linked, {});
	Current.LastUsed = Frame;
	return true;
}

void FRTPSOLinkState::RetireCurrent(uint64_t Frame)
{
	if (!Current.Pipeline) { return; }
	Current.LastUsed = Frame;
	// A pipeline on the way to a complete one is not wanted again. Those of settings that are switched to and fro are.
	constexpr size_t MostRecent = 8;
	if (!Current.bExact)
	{
		Retired.push_back(std::move(Current));
		return;
	}
	Recent.push_front(std::move(Current));
	if (Recent.size() <= MostRecent) { return; }
	Retired.push_back(std::move(Recent.back()));
	Recent.pop_back();
}

void FRTPSOLinkState::DropRetired(uint64_t Frame, FTrash& Trash)
{
	constexpr uint64_t HeldFrames = 4;
	for (; !Retired.empty() && Frame - Retired.front().LastUsed > HeldFrames; Retired.pop_front())
	{
		Trash.Discard(std::move(Retired.front()));
	}
}

void FRTPSOLinkState::DropOld(uint64_t Frame, uint64_t KeepFrames, FTrash& Trash)
{
	for (; !Recent.empty() && Frame - Recent.back().LastUsed > KeepFrames; Recent.pop_back()) { Trash.Discard(std::move(Recent.back())); }
}

} // namespace Lantern
