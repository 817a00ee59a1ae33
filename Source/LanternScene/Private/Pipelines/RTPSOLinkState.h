// The link that is under way, and the pipelines that earlier ones have made.
#pragma once

#include <deque>
#include <list>
#include <memory>
#include <vector>

#include "Pipelines/RTPSOPlan.h"

namespace Lantern
{

struct FLinkedRTPSO
{
	std::shared_ptr<const FRTPSO> Pipeline;
	FLinkPlan Plan;
	bool bExact = false;   ///< asked for by FRTPSOCompiler::Finish
	uint64_t LastUsed = 0; ///< frame
};

/// At most one link at a time: Ask, Begin, End, Take.
/// Threads: the caller holds the lock of the RTPSO compiler. Begin and End are for the background thread, the rest is for any.
class FRTPSOLinkState
{
public:
	bool IsIdle() const { return State == EState::Idle; }
	bool IsAsked() const { return State == EState::Asked; }
	bool IsUnderWay() const { return State == EState::Asked || State == EState::Linking; }

	/// Only when idle. True: a thread must link. False: a kept pipeline is the one, and Take can follow.
	bool Ask(FLinkPlan Plan, bool bExact);
	/// Returns the plan to link, without the lock.
	FLinkPlan Begin();
	/// Pipeline: null on an error. A failed plan is remembered, unless the device is lost.
	void End(const FRTStatus& Result, std::shared_ptr<const FRTPSO> Pipeline, FLinkPlan Plan, uint64_t Frame);
	/// A link has ended and was not taken yet.
	bool IsDone() const { return State == EState::Done; }
	/// Only when done. Makes the new pipeline the current one. False: the link has failed, and the current one stays.
	bool Take(uint64_t Frame);

	/// Pipeline is null before the first link was taken.
	const FLinkedRTPSO& GetCurrent() const { return Current; }
	const FRTStatus& GetStatus() const { return Status; } ///< of the newest link that ended
	bool HasFailed(const FLinkPlan& Plan) const { return Plan.Key == FailedKey; }
	void ForgetFailure() { FailedKey.clear(); }

	/// Drops pipelines that no frame in flight can hold any more.
	void DropRetired(uint64_t Frame, FTrash& Trash);
	/// Drops pipelines of Finish that were not used for KeepFrames frames.
	void DropOld(uint64_t Frame, uint64_t KeepFrames, FTrash& Trash);

private:
	enum class EState : uint8_t
	{
		Idle,
		Asked,
		Linking,
		Done
	};
	void RetireCurrent(uint64_t Frame);

	EState State = EState::Idle;
	FLinkPlan AskedPlan;
	bool bAskedExact = false;
	FRTStatus Status;
	FLinkedRTPSO Linked; ///< when done, without an error
	std::vector<uint64_t> FailedKey;
	FLinkedRTPSO Current;
	std::list<FLinkedRTPSO> Recent;   ///< made for Finish, newest first: a setting that is switched back needs no link
	std::deque<FLinkedRTPSO> Retired; ///< oldest first; frames in flight may still hold them
};

} // namespace Lantern
