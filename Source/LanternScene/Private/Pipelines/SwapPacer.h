// When the next pipeline may take the place of the one in use. Some drivers compile a pipeline when it is first used, and all
// of it anew (lavapipe: seconds for some dozens of materials). A swap for each material that becomes ready would then be all
// that the device ever does.
//
// What a swap costs is learned: the GPU's time for the first frame with the new pipeline, less that of the frames around it.
// The cost of the newest swap sets the wait for the next link, so that swaps take no more than their share of the time.
// Where that wait is longer than a round of compiles, swaps are dear, and a link must also double the programs in use. So n
// programs need O(log n) swaps. Two things end the wait for more: nothing new was asked for during such a wait, or swaps are
// down to 1 % of the time. While programs are being compiled, a dear swap also waits as long as it would take itself: if they
// come meanwhile, one swap does for two, and if not, no more than its own time was lost.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>

namespace Lantern
{

/// Knows no clock: whoever calls says what time it is. One thread at a time.
class FSwapPacer
{
public:
	struct FSwap
	{
		size_t InUse = 0, New = 0; ///< programs that are ready
		bool bMore = false;        ///< others are being compiled
	};
	using FTime = std::chrono::steady_clock::time_point;
	using FSeconds = std::chrono::duration<double>;

	static constexpr double LeastShare = 0.01;

	/// Share: of the time, that swaps may take, LeastShare to 1; 1: all of it. Round: of compiles.
	void SetLimits(double Share, FSeconds Round);
	/// A new pipeline is in use from the next frame on.
	void Swapped() { bSwapped = true; }
	/// Frame: a number that rises. Frames that are lost are not told.
	void FrameSubmitted(uint64_t Frame);
	/// Duration: on the GPU. In the order of the frames; some may be left out.
	void FrameDone(uint64_t Frame, FSeconds Duration, FTime Now);
	/// Something new is to be compiled.
	void ProgramsAsked(FTime Now);
	/// Whether a link that brings nothing but more programs may begin.
	bool MayLink(FTime Now, const FSwap& Swap) const;
	void LinkStarted() { bAsked = false; }
	FSeconds GetCost() const { return Cost; } ///< of the newest swap

private:
	FSeconds GetUsual() const;

	double Share = 1.0;
	FSeconds Round{0.0};
	bool bKnown = false;             ///< any frame's duration was told: else nothing is held back
	bool bSwapped = false;           ///< no frame has been submitted since
	std::deque<uint64_t> Firsts;     ///< frames in flight that are the first with their pipeline
	std::array<FSeconds, 8> Usual{}; ///< of the newest frames that were no first ones
	uint32_t UsualCount = 0;
	FSeconds Cost{0.0};
	FSeconds FirstDuration{0.0};
	bool bRefine = false; ///< the frame after the first has still to say what frames with the new pipeline take
	FTime SwapEnd;
	bool bAsked = false; ///< since the newest link
	FTime FirstAsked, LastAsked;
};

} // namespace Lantern
