#include "SwapPacer.h"

#include <algorithm>

namespace Lantern
{

namespace
{
constexpr double LeastShare = 0.01;
constexpr size_t MostInFlight = 64; // of a caller that never says what is done
} // namespace

void FSwapPacer::SetLimits(double InShare, FSeconds InRound)
{
	Share = std::clamp(InShare, LeastShare, 1.0);
	Round = InRound;
}

void FSwapPacer::Swapped()
{
	bSwapped = bLearning = bReported;
}

void FSwapPacer::FrameSubmitted(FRTFence Fence, FTime Now)
{
	if (Fence == 0)
	{
		return;
	}
	bReported = true;
	InFlight.push_back({Fence, Now, bSwapped});
	bSwapped = false;
	if (InFlight.size() > MostInFlight)
	{
		bLearning &= !InFlight.front().bFirst;
		InFlight.pop_front();
	}
}

void FSwapPacer::FramesDone(FRTFence Completed, FTime Now, bool bWaited)
{
	while (!InFlight.empty() && InFlight.front().Fence <= Completed)
	{
		const FFrame Frame = InFlight.front();
		InFlight.pop_front();
		const bool bExact = bWaited && Frame.Fence == Completed;
		FrameDone(Frame, bExact ? Now : std::max(LastLook, Frame.Submitted), Now);
	}
	LastLook = Now;
}

void FSwapPacer::FrameDone(const FFrame& Frame, FTime Low, FTime High)
{
	// A frame begins when the one before is done. Where that is not known exactly, a swap is given the shorter time and the
	// frames around it the longer: a hitch that was none would hold programs back.
	const FSeconds Shortest = Low - std::max(Frame.Submitted, DoneHigh);
	const FSeconds Longest = High - std::max(Frame.Submitted, DoneLow);
	DoneLow = Low;
	DoneHigh = High;
	if (Frame.bFirst)
	{
		FirstDuration = Shortest;
		Cost = std::max(Shortest - GetUsual(), FSeconds(0.0));
		SwapEnd = High;
		bLearning = bSwapped; // another one may have followed
		bRefine = true;
		return;
	}
	if (bRefine)
	{
		Cost = std::clamp(FirstDuration - Longest, FSeconds(0.0), Cost);
		bRefine = false;
	}
	Usual[UsualCount++ % Usual.size()] = Longest;
}

FSwapPacer::FSeconds FSwapPacer::GetUsual() const
{
	std::array<FSeconds, 8> Sorted = Usual;
	const size_t Count = std::min<size_t>(UsualCount, Sorted.size());
	std::sort(Sorted.begin(), Sorted.begin() + static_cast<ptrdiff_t>(Count));
	return Count > 0 ? Sorted[Count / 2] : FSeconds(0.0);
}

FSwapPacer::FSeconds FSwapPacer::GetHold() const
{
	return Cost * (1.0 / Share - 1.0);
}

bool FSwapPacer::MayLink(FTime Now, bool bMore) const
{
	if (!bReported || Share >= 1.0)
	{
		return true;
	}
	if (bLearning)
	{
		return false;
	}
	FSeconds Hold = GetHold();
	if (bMore && Hold > Round)
	{
		Hold = std::min(Hold * double(1u << Growth), std::max(Hold, Cost * (1.0 / LeastShare - 1.0)));
	}
	return Now - SwapEnd >= Hold;
}

void FSwapPacer::LinkStarted(bool bMore)
{
	constexpr uint32_t MostGrowth = 16; // far beyond where the share ends it
	Growth = bMore && GetHold() > Round ? std::min(Growth + 1, MostGrowth) : 0;
}

} // namespace Lantern
