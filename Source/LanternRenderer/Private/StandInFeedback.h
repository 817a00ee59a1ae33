// What the RTPSO's compiler is told of material programs that are not ready: how many rays hit their stand-ins, and how
// near they are. Both without waiting: the GPU counts, and is read some frames later; the scene is looked through a part a
// frame. Costs nothing where nothing is missing.
#pragma once

#include "LanternCore/FrameGraph/FrameGraph.h"
#include "LanternScene/Pipelines/RTPSOCompiler.h"
#include "LanternScene/Scene/Scene.h"

namespace Lantern
{

/// Of one renderer. Render thread. A frame: Begin → AddClear before all passes that trace → AddRead behind them →
/// Submitted.
class FStandInFeedback
{
public:
	explicit FStandInFeedback(IRTDevice& InDevice) : Device(InDevice) {}

	/// bMissing: some hit program of the frame is not ready.
	FRTStatus Begin(const FRTScene& Scene, glm::dvec3 Camera, bool bMissing);
	/// For FSceneConstants: a count for each material; 0: nothing counts.
	uint64_t GetAddress() const { return bActive ? Counts->GetDeviceAddress() : 0; }
	void AddClear(FFrameGraph& Graph);
	void AddRead(FFrameGraph& Graph);
	/// Fence 0: the frame never runs.
	void Submitted(FRTFence Fence);
	/// By program, as of the newest that is known.
	const std::vector<FProgramPriority>& GetPriorities() const { return Priorities; }

private:
	struct FReadback
	{
		TRTRef<IRTBuffer> Buffer;
		uint32_t Materials = 0;
		FRTFence Fence = 0;
		bool bPending = false;
	};
	FRTStatus Reserve(uint32_t Materials);
	void TakeCounts(const FRTScene& Scene);
	void LookAtObjects(const FRTScene& Scene, glm::dvec3 Camera);
	FProgramPriority& PriorityOf(uint32_t Program);

	IRTDevice& Device;
	TRTRef<IRTBuffer> Counts;
	uint32_t Capacity = 0, Materials = 0;
	FReadback Readbacks[4]; // more than frames in flight: nobody has to wait
	size_t Current = 0;
	bool bActive = false;
	std::vector<FProgramPriority> Priorities;
	std::vector<float> Nearest; // by program, in the look through the scene that is under way
	uint32_t NextObject = 0;
};

} // namespace Lantern
