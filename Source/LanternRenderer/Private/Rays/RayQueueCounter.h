// How many rays the queues really traced, with r.RT.Rays.Count. Nothing waits: the GPU counts, and the CPU reads two frames later.
#pragma once

#include <memory>
#include <vector>

#include "Feedback/ReadbackRing.h"
#include "LanternCore/FrameGraph/FrameGraph.h"
#include "LanternRenderer/Renderer.h"

namespace Lantern
{

/// Belongs to one renderer and serves all of its views. Render thread. A frame: BeginFrame → AddRead for each queue → EndFrame.
class FRayQueueCounter
{
public:
	explicit FRayQueueCounter(IRTDevice& InDevice) : Device(InDevice) {}

	/// r.RT.Rays.Count.
	static bool IsWanted();
	/// FlightIndex: as in TReadbackRing::BeginFrame.
	void BeginFrame(uint32_t FlightIndex);
	/// Takes what is left, after all frames have ended on the GPU.
	void TakeAll();
	struct FQueue
	{
		std::string Pass;      ///< that traces it
		FGraphBuffer Counters; ///< FRayQueueCounters
		uint32_t Capacity = 0; ///< requests
		uint32_t RaysPerSunRequest = 1, RaysPerLocalRequest = 1;
	};
	/// Adds the pass PassName that copies the counters. It runs if a pass declares FPassBuilder::Keep of the buffer that this returns.
	/// Invalid: there is no memory for it, and nothing is counted.
	FGraphBuffer AddRead(FFrameGraph& Graph, const char* PassName, const FQueue& Queue);
	/// bSubmitted: false if the frame never runs.
	void EndFrame(bool bSubmitted);
	const FRayCounts& Get() const { return Counts; }

private:
	using FRing = TReadbackRing<FQueue>;
	struct FPlace
	{
		std::unique_ptr<FRing> Ring;
		bool bWritten = false; ///< in this frame, by a pass that was not culled
	};
	static uint64_t GetRays(const FRing::FEntry& Entry);

	IRTDevice& Device;
	std::vector<std::unique_ptr<FPlace>> Places; // by order of the queues in a frame
	size_t Used = 0;                             // of Places, in this frame
	uint32_t Flight = 0;
	FRayCounts Counts;
};

} // namespace Lantern
