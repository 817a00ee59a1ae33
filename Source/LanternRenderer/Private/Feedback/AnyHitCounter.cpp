// The count of alpha tests under rays.
#include "Feedback/AnyHitCounter.h"

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCount(
    "r.RT.Opacity.Count", false, "Counts how often alpha tests run under rays. Each test takes longer for it: for measurements only.");
} // namespace

std::vector<std::pair<std::string, std::string>> FAnyHitCounter::GetDefines()
{
	if (!IsWanted()) { return {}; }
	return {{"COUNT_ANY_HITS", "1"}};
}

bool FAnyHitCounter::IsWanted() { return CVarCount.GetOnRenderThread(); }

void FAnyHitCounter::BeginFrame(uint32_t FlightIndex)
{
	Counters.BeginFrame(FlightIndex, [this](std::span<const uint32_t> Frame) { Take(Frame); });
}

void FAnyHitCounter::TakeAll()
{
	Counters.TakeAll([this](std::span<const uint32_t> Frame) { Take(Frame); });
}

void FAnyHitCounter::Take(std::span<const uint32_t> Frame)
{
	Counts.LastFrame = Frame[0];
	Counts.Total += Frame[0];
	++Counts.Frames;
}

} // namespace Lantern
