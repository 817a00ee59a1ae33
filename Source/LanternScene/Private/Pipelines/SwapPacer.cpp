// What a swap has cost, and when the next link may begin.
#include "Pipelines/SwapPacer.h"

#include <algorithm>
#include <utility>

namespace Lantern
{

void FSwapPacer::SetLimits(double InShare, FSeconds InRound)
{
	Share = std::clamp(InShare, LeastShare, 1.0);
	Round = InRound;
}

void FSwapPacer::FrameSubmitted(uint64_t Frame)
{
	if (!std::exchange(bSwapped, false)) { return; }
	constexpr size_t MostInFlight = 8; // for a device that never reports durations
	Firsts.push_back(Frame);
	if (Firsts.size() > MostInFlight) { Firsts.pop_front(); }
}

void FSwapPacer::FrameDone(uint64_t Frame, FSeconds Duration, FTime Now)
{
	bKnown = true;
	// A later frame is done: the duration of this one will not come.
	while (!Firsts.empty() && Firsts.front() < Frame) { Firsts.pop_front(); }
	if (!Firsts.empty() && Firsts.front() == Frame)
	{
		Firsts.pop_front();
		FirstDuration = Duration;
		Cost = std::max(Duration - GetUsual(), FSeconds(0.0));
		SwapEnd = Now;
		bRefine = true;
		return;
	}
	if (std::exchange(bRefine, false))
	{
		// Frames that take longer from now on show more. That is no cost of the swap.
		Cost = std::clamp(FirstDuration - Duration, FSeconds(0.0), Cost);
	}
	Usual[UsualCount++ % Usual.size()] = Duration;
}

FSwapPacer::FSeconds FSwapPacer::GetUsual() const
{
	std::array<FSeconds, 8> Sorted = Usual;
	const size_t Count = std::min<size_t>(UsualCount, Sorted.size());
	std::sort(Sorted.begin(), Sorted.begin() + static_cast<ptrdiff_t>(Count));
	return Count > 0 ? Sorted[Count / 2] : FSeconds(0.0);
}

void FSwapPacer::ProgramsAsked(FTime Now)
{
	FirstAsked = std::exchange(bAsked, true) ? FirstAsked : Now;
	LastAsked = Now;
}

bool FSwapPacer::MayLink(FTime Now, const FSwap& Swap) const
{
	if (!bKnown || Share >= 1.0) { return true; }
	if (bSwapped || !Firsts.empty())
	{
		return false; // the cost of the swap before is not known yet
	}
	const FSeconds Wait = Cost * (1.0 / Share - 1.0);
	if (Now - SwapEnd < Wait) { return false; }
	// The cost is taken to grow with the size, within limits: a small pipeline is no measure of one a hundred times as large.
	constexpr double MostGrowth = 16.0;
	const double Growth = double(Swap.InUse + Swap.New) / double(std::max<size_t>(Swap.InUse, 1));
	const FSeconds Expected = Cost * std::min(Growth, MostGrowth);
	if (Swap.bMore && Expected > Round && Now - FirstAsked < Expected) { return false; }
	const bool bCheap = Wait <= Round;
	const bool bDoubles = Swap.New >= Swap.InUse;
	const bool bQuiet = Now - LastAsked >= Wait;
	return bCheap || bDoubles || bQuiet || Now - SwapEnd >= Cost * (1.0 / LeastShare - 1.0);
}

} // namespace Lantern
