// Counters that shaders add to by the members of a structure, and the counts of the newest frame that has arrived.
#pragma once

#include <cassert>
#include <cstring>

#include "Feedback/GpuCounters.h"

namespace Lantern
{

/// TStatistics: of words, as shaders have it. TCounts: what the CPU shows of it, with a number of Frames.
/// Belongs to one renderer, which calls it as FGpuCounters says. Render thread.
template <class TStatistics, class TCounts>
class TGpuStatistics
{
public:
	using FConvert = TCounts (*)(const TStatistics& Of);

	/// Name: as in FGpuCounters.
	TGpuStatistics(IRTDevice& InDevice, const char* Name, FConvert InConvert) : Counters(InDevice, Name), Convert(InConvert) {}

	void BeginFrame(uint32_t FlightIndex)
	{
		Counters.BeginFrame(FlightIndex, [this](std::span<const uint32_t> Frame) { Take(Frame); });
	}
	/// Counts in this frame, if bCounts. OutOfMemory: nothing is counted.
	FRTStatus Start(bool bCounts) { return bCounts ? Counters.Start(Words) : FRTStatus::Success(); }
	FGpuCounters& GetCounters() { return Counters; }
	/// Takes the counts of frames that are still in flight, after they have ended on the GPU.
	void TakeAll()
	{
		Counters.TakeAll([this](std::span<const uint32_t> Frame) { Take(Frame); });
	}
	const TCounts& Get() const { return Counts; }

private:
	static constexpr uint32_t Words = sizeof(TStatistics) / sizeof(uint32_t);

	void Take(std::span<const uint32_t> Frame)
	{
		assert(Frame.size() == Words);
		TStatistics Of;
		std::memcpy(&Of, Frame.data(), sizeof(Of));
		const uint32_t Before = Counts.Frames;
		Counts = Convert(Of);
		Counts.Frames = Before + 1;
	}

	FGpuCounters Counters;
	FConvert Convert;
	TCounts Counts;
};

} // namespace Lantern
