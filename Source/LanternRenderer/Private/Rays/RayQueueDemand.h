// How many rays frames ask for, so that a queue that was too small grows. Nothing waits: the GPU counts, and the CPU reads two frames
// later. A queue that has room for all that can be asked for costs nothing here.
#pragma once

#include "Feedback/ReadbackRing.h"
#include "LanternCore/FrameGraph/FrameGraph.h"

namespace Lantern
{

/// Belongs to one renderer and serves all of its views. Render thread. A frame: BeginFrame → AddRead, if its queue may overflow →
/// EndFrame.
class FRayQueueDemand
{
public:
	explicit FRayQueueDemand(IRTDevice& Device) : Ring(Device, "RayQueueDemand", ERTBufferUsage::CopyDest) {}

	/// FlightIndex: as in TReadbackRing::BeginFrame. Warns once if rays had no room.
	void BeginFrame(uint32_t FlightIndex);
	/// Returns the requests per pixel that a queue should have room for: PerPixel, or more if earlier frames with the same PerPixel
	/// asked for more.
	double GetRoom(double PerPixel);
	struct FQueue
	{
		FGraphBuffer Counters; ///< FRayQueueCounters
		uint32_t Capacity = 0; ///< requests
		uint64_t Pixels = 0;
	};
	/// Adds the pass PassName that copies what the tiles asked for. It runs if a pass declares FPassBuilder::Keep of the buffer that
	/// this returns. Invalid: there is no memory for it, and nothing is counted.
	FGraphBuffer AddRead(FFrameGraph& Graph, const char* PassName, const FQueue& Queue);
	/// bSubmitted: false if the frame never runs.
	void EndFrame(bool bSubmitted) { Ring.EndFrame(bSubmitted && bWritten); }

private:
	struct FNotes
	{
		uint32_t Capacity = 0;
		uint64_t Pixels = 0;
	};
	TReadbackRing<FNotes> Ring;
	double Set = 0.0;      // GetRoom's last argument
	double Room = 0.0;     // that frames with it have asked for; 0: all rays had room
	bool bWritten = false; // in this frame, by a pass that was not culled
};

} // namespace Lantern
