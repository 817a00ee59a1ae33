// Makes coarser levels of detail of geometries that do not fit into memory, beside the frame.
#pragma once

#include <cstdint>
#include <vector>

#include "Geometry/GeometryContext.h"
#include "Geometry/GeometryRefusals.h"

namespace Lantern
{

/// Threads: render thread; levels are simplified by tasks.
class FGeometryCoarsener
{
public:
	FGeometryCoarsener(FGeometryContext& Context, FGeometryRefusals& Refusals);

	/// Coarser levels are on, the geometry is static and consists of triangles that the CPU has, and it has not been
	/// made coarser too often.
	static bool CanCoarsen(const FGeometryEntry& Entry);
	/// Starts a level that should fit into Room bytes; the entry becomes Coarsening and gives its structure back.
	/// False, and nothing has changed: it cannot be made coarser, or the level would be no picture of the geometry.
	bool Start(FGeometryEntry& Entry, uint64_t Room);
	/// Queues geometries whose level is done, with a warning for each, and refuses those for whose level the CPU had no
	/// memory. Out of device memory is no error: the level is taken in the next frame.
	FRTStatus TakeDone();
	/// Waits until the entry's level is done, then does as TakeDone.
	FRTStatus Finish(FGeometryEntry& Entry);
	bool IsAnyDone() const;
	/// Number of levels that are being made.
	uint32_t GetCount() const { return static_cast<uint32_t>(Coarsening.size()); }

private:
	FRTStatus Take(FGeometryEntry& Entry);
	FRTStatus CreateBuffers(const FGeometryEntry& Entry, uint64_t Bytes, TRTRef<IRTBuffer>& Indices, TRTRef<IRTBuffer>& Staging);

	FGeometryContext& Context;
	FGeometryRefusals& Refusals;
	std::vector<FGeometrySlotRef> Coarsening;
};

} // namespace Lantern
