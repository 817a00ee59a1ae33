// The memory budget of acceleration structures and their builds (r.RT.Build.MemoryMB). It knows what is used, what is left,
// and whether the GPU is about to give some back.
#pragma once

#include <cstdint>

#include "LanternScene/Geometry/GeometryStore.h"

namespace Lantern
{

inline double ToMiB(uint64_t Bytes) { return static_cast<double>(Bytes) / (1 << 20); }

/// Threads: render thread.
class FGeometryMemoryBudget
{
public:
	static constexpr uint64_t Unlimited = ~0ull;

	/// Device and Stats must outlive this. Writes LiveBytes, ScratchBytes and PeakBytes of Stats.
	FGeometryMemoryBudget(IRTDevice& Device, FGeometryStoreStats& Stats);

	/// Frame: a number that rises by 1; the first is 1.
	void BeginFrame(uint64_t InFrame) { Frame = InFrame; }
	/// In bytes; 0: there is none.
	uint64_t GetLimit() const;
	/// Bytes of structures over triangles and over instances, and of scratch, including what the GPU has yet to let go.
	uint64_t GetUsed() const;
	/// Bytes that are left; Unlimited: there is no budget.
	uint64_t GetRoom() const;

	/// Memory was released in this frame. The GPU gives it back once it is done with the frames in flight.
	void NoteRelease() { LastReleaseFrame = Frame; }
	/// Memory that was released may still come back. Releases before the first frame do not count.
	bool IsReleasing() const;

	/// Must follow each allocation, since memory may be freed again in the same frame.
	void UpdatePeak();
	void UpdateStats();

private:
	IRTDevice& Device;
	FGeometryStoreStats& Stats;
	uint64_t Frame = 0, LastReleaseFrame = 0;
};

} // namespace Lantern
