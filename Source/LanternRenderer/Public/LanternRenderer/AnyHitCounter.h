// How often alpha tests run under rays: r.RT.Opacity.Count. Off, shaders do not contain it and nothing is allocated.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "LanternCore/FrameGraph/FrameGraph.h"
#include "LanternScene/Memory/GpuTable.h"

namespace Lantern
{

struct FAnyHitCounts
{
	uint64_t LastFrame = 0; ///< of the newest frame that the GPU has finished; modulo 2³²
	uint64_t Total = 0;     ///< of all counted frames
	uint32_t Frames = 0;    ///< counted and finished
};

/// Of one renderer. Render thread. A frame: Begin → AddClear before all passes that trace → AddRead behind them →
/// Submitted.
class FAnyHitCounter
{
public:
	explicit FAnyHitCounter(IRTDevice& InDevice) : Device(InDevice) {}
	FAnyHitCounter(const FAnyHitCounter&) = delete;
	FAnyHitCounter& operator=(const FAnyHitCounter&) = delete;

	/// Whether this frame's alpha tests are to count: shaders that have them are compiled with GetDefines.
	static bool IsWanted();
	static std::vector<std::pair<std::string, std::string>> GetDefines();

	FRTStatus Begin();
	/// For FSceneConstants; 0 where nothing counts.
	uint64_t GetAddress() const { return bActive ? Counter->GetDeviceAddress() : 0; }
	void AddClear(FFrameGraph& Graph);
	void AddRead(FFrameGraph& Graph);
	/// Fence 0: the frame never runs.
	void Submitted(FRTFence Fence);
	/// Without waiting.
	const FAnyHitCounts& Get();

private:
	struct FReadback
	{
		TRTRef<IRTBuffer> Buffer;
		FRTFence Fence = 0;
		bool bPending = false;
	};
	IRTDevice& Device;
	TRTRef<IRTBuffer> Counter;
	FReadback Readbacks[4]; // more than frames in flight: nobody has to wait
	size_t Current = 0;
	bool bActive = false;
	FAnyHitCounts Counts;
};

} // namespace Lantern
