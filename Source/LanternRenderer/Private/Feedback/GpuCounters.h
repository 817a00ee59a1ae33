// An array of counters that shaders add to during a frame, read by the CPU TReadbackRing::FramesInFlight frames later.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "Feedback/ReadbackRing.h"
#include "LanternCore/FrameGraph/FrameGraph.h"

namespace Lantern
{

/// Belongs to one renderer. Render thread. A frame: BeginFrame → Start, if anything is to be counted → AddClear before all
/// passes that trace → AddRead behind them → EndFrame.
class FGpuCounters
{
public:
	/// Gets a frame's counts, modulo 2³².
	using FTake = std::function<void(std::span<const uint32_t> Counts)>;

	/// Name: of the buffer; passes are "Clear<Name>" and "Read<Name>".
	FGpuCounters(IRTDevice& InDevice, const char* InName);

	/// FlightIndex: as in TReadbackRing::BeginFrame. Take gets the counts of the frame FramesInFlight before, if it counted.
	void BeginFrame(uint32_t FlightIndex, const FTake& Take);
	/// Gives Take what is left, oldest first, after all frames have ended on the GPU.
	void TakeAll(const FTake& Take);
	/// Counts in this frame, with Count counters. OutOfMemory: nothing is counted.
	FRTStatus Start(uint32_t Count);
	/// For FSceneConstants; 0: nothing is counted in this frame.
	uint64_t GetAddress() const { return bActive ? Counters->GetDeviceAddress() : 0; }
	void AddClear(FFrameGraph& Graph);
	void AddRead(FFrameGraph& Graph);
	/// bSubmitted: false if the frame never runs.
	void EndFrame(bool bSubmitted);

private:
	using FRing = TReadbackRing<uint32_t>; ///< notes: number of counters

	IRTDevice& Device;
	std::string Name;
	FRing Ring;
	TRTRef<IRTBuffer> Counters;
	bool bActive = false;
};

} // namespace Lantern
