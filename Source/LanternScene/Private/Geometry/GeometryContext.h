// What the parts of FGeometryStore share.
#pragma once

#include <vector>

#include "Geometry/BuildScratch.h"
#include "Geometry/GeometryBuildQueue.h"
#include "Geometry/GeometryMemoryBudget.h"
#include "Geometry/GeometrySlots.h"

namespace Lantern
{

/// Each part counts its work in Stats. Threads: render thread.
struct FGeometryContext
{
	/// Device and Addresses must outlive this. Addresses: see FGeometrySlots.
	FGeometryContext(IRTDevice& InDevice, std::vector<uint64_t>& Addresses) : Device(InDevice), Slots(Addresses) {}
	FGeometryContext(const FGeometryContext&) = delete;
	FGeometryContext& operator=(const FGeometryContext&) = delete;

	IRTDevice& Device;
	FGeometryStoreStats Stats;
	FGeometrySlots Slots;
	FGeometryMemoryBudget Memory{Device, Stats};
	FBuildScratch Scratch{Device, Slots, Memory};
	FGeometryBuildQueue Queue{Slots, Stats};
};

} // namespace Lantern
