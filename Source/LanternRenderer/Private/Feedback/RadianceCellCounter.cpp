// The counts of radiance cells.
#include "Feedback/RadianceCellCounter.h"

#include <cassert>
#include <cstring>

#include "LanternCore/Config/ConsoleVariables.h"
#include "RadianceCellTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCount(
    "r.RT.GI.Cells.Count", false, "Counts radiance cells, and what becomes of look-ups. These take longer for it: for measurements only.");
constexpr uint32_t Words = sizeof(FRadianceCellStatistics) / sizeof(uint32_t);
} // namespace

void FRadianceCellCounter::BeginFrame(uint32_t FlightIndex)
{
	Counters.BeginFrame(FlightIndex, [this](std::span<const uint32_t> Frame) { Take(Frame); });
}

FRTStatus FRadianceCellCounter::Start() { return CVarCount.GetOnRenderThread() ? Counters.Start(Words) : FRTStatus::Success(); }

void FRadianceCellCounter::TakeAll()
{
	Counters.TakeAll([this](std::span<const uint32_t> Frame) { Take(Frame); });
}

void FRadianceCellCounter::Take(std::span<const uint32_t> Frame)
{
	assert(Frame.size() == Words);
	FRadianceCellStatistics Of;
	std::memcpy(&Of, Frame.data(), sizeof(Of));
	Counts = {Of.Live, Of.Young, Of.Updated, Of.Full, Of.Found, Of.Coarse, Of.Missed, Counts.Frames + 1};
}

} // namespace Lantern
