// A coarser level of detail in the making: fewer triangles over the same vertices, simplified beside the frame.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "LanternCore/Tasks.h"
#include "LanternScene/Geometry.h"

namespace Lantern
{

/// Reads the geometry's CPU data until it is destroyed, which waits for the section in hand.
struct FCoarserLevel
{
	std::vector<uint32_t> Indices;      ///< once bDone
	std::vector<FRTGeometryPart> Parts; ///< ranges of Indices
	std::atomic<bool> bDone{false};
	std::atomic<bool> bCancel{false};
	FTaskGroup Task; // last: waits before the rest goes

	~FCoarserLevel() { bCancel = true; }
};

} // namespace Lantern
