// When the next pipeline may take the place of the one in use. Some drivers compile a pipeline when it is first used, all of
// it anew, however much of it was in the one before (lavapipe: tens of seconds for some dozens of materials). A swap is then
// as dear as it is useful, and one for each material that becomes ready would be all that the device ever does.
//
// What a swap costs is learned: the time that the first frame with the new pipeline takes, less that of the frames around it.
// The next link then waits until swaps take no more than their share of the time. Where that is longer than a round of
// compiles and more programs are on their way, each wait is twice as long as the one before: n programs need O(log n) swaps.
// That ends where swaps are 1 % of the time. A cheap swap (1.1 ms on NVIDIA) is waited for by less than a frame.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// Knows no clock: whoever calls says what time it is. One thread at a time.
class FSwapPacer
{
public:
	using FTime = std::chrono::steady_clock::time_point;
	using FSeconds = std::chrono::duration<double>;

	/// Share: of the time, that swaps may take; 1: all of it. Round: of compiles.
	void SetLimits(double Share, FSeconds Round);
	/// A new pipeline is in use from the next frame on.
	void Swapped();
	/// Fence 0: the frame was lost.
	void FrameSubmitted(FRTFence Fence, FTime Now);
	/// All frames up to Completed are done. bWaited: the caller waited for that one; otherwise it may have been done for a while.
	void FramesDone(FRTFence Completed, FTime Now, bool bWaited);
	/// Whether a link that brings nothing but more programs may begin. bMore: others are still being compiled.
	bool MayLink(FTime Now, bool bMore) const;
	/// Such a link begins.
	void LinkStarted(bool bMore);
	FSeconds GetCost() const { return Cost; } ///< of the last swap

private:
	struct FFrame
	{
		FRTFence Fence = 0;
		FTime Submitted;
		bool bFirst = false; ///< with a new pipeline
	};
	void FrameDone(const FFrame& Frame, FTime Low, FTime High);
	FSeconds GetHold() const; ///< without growth
	FSeconds GetUsual() const;

	double Share = 1.0;
	FSeconds Round{0.0};
	std::deque<FFrame> InFlight;
	bool bReported = false; ///< any frame was: else nothing is known and nothing is held back
	bool bSwapped = false;  ///< no frame has been submitted since
	bool bLearning = false; ///< the first frame of the newest swap is in flight, or not even submitted
	FTime LastLook;
	FTime DoneLow, DoneHigh;         ///< when the newest frame was done: not before, not after
	std::array<FSeconds, 8> Usual{}; ///< of the newest frames that were no first ones
	uint32_t UsualCount = 0;
	FSeconds Cost{0.0};
	FSeconds FirstDuration{0.0};
	bool bRefine = false; ///< the frame after the first has still to say what frames with the new pipeline take
	FTime SwapEnd;
	uint32_t Growth = 0; ///< links since one after which nothing more was to come
};

} // namespace Lantern
