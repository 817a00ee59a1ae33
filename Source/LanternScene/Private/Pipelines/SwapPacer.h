// When the next pipeline may take the place of the one in use. Some drivers compile a whole pipeline when it is first used
// (lavapipe: seconds for some dozens of materials). A swap for each material that becomes ready would then be all that the
// device ever does.
//
// Cost: the GPU time of the first frame with a new pipeline, less that of the frames around it. The cost of the newest swap
// sets the wait for the next link, so that swaps take no more than their share of the time.
//
// Dear swaps: if that wait is longer than a round of compiles, a link must also double the programs in use. So n programs need
// O(log n) swaps. Two things end the wait for more programs. Either nothing new was asked for during such a wait, or swaps are
// down to 1 % of the time.
//
// Compiles under way: a dear swap also waits for programs that are being compiled, as long as it would take itself. If they
// come meanwhile, one swap does for two. If they do not, the loss is no more than the time of one swap.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>

namespace Lantern
{

/// Knows no clock: the caller says what time it is.
/// Threads: one call at a time.
class FSwapPacer
{
public:
	struct FSwap
	{
		size_t InUse = 0;   ///< programs in the current pipeline
		size_t New = 0;     ///< programs that are ready and not in it
		bool bMore = false; ///< others are being compiled
	};
	using FTime = std::chrono::steady_clock::time_point;
	using FSeconds = std::chrono::duration<double>;

	static constexpr double LeastShare = 0.01;

	/// Share: of the time that swaps may take, LeastShare to 1; 1 holds nothing back. Round: longest duration of a round of compiles.
	void SetLimits(double Share, FSeconds Round);
	/// The next frame is the first with a new pipeline.
	void Swapped() { bSwapped = true; }
	/// Frame: a number that rises. A frame whose submission failed is not reported.
	void FrameSubmitted(uint64_t Frame);
	/// Duration: on the GPU. Frames come in order; some may be left out.
	void FrameDone(uint64_t Frame, FSeconds Duration, FTime Now);
	/// Programs were asked for that are to be compiled.
	void ProgramsAsked(FTime Now);
	/// Whether a link may begin that adds programs and changes nothing else.
	bool MayLink(FTime Now, const FSwap& Swap) const;
	/// Such a link has begun.
	void LinkStarted() { bAsked = false; }
	/// The cost of the newest swap. 0: none, or not known yet.
	FSeconds GetCost() const { return Cost; }

private:
	FSeconds GetUsual() const;

	double Share = 1.0;
	FSeconds Round{0.0};
	bool bKnown = false;             ///< a duration was reported; until then nothing is held back
	bool bSwapped = false;           ///< and no frame has been submitted since
	std::deque<uint64_t> Firsts;     ///< frames in flight that are the first ones with their pipeline
	std::array<FSeconds, 8> Usual{}; ///< durations of the newest frames that were not the first with their pipeline
	uint32_t UsualCount = 0;
	FSeconds Cost{0.0};
	FSeconds FirstDuration{0.0};
	bool bRefine = false; ///< the next frame tells what frames with the new pipeline take
	FTime SwapEnd;
	bool bAsked = false; ///< programs were asked for since the newest link
	FTime FirstAsked, LastAsked;
};

} // namespace Lantern
