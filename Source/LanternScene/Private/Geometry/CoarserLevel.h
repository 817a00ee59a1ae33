// A coarser level of detail in the making: fewer triangles over the same vertices, simplified beside the frame.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "LanternCore/Tasks/Tasks.h"
#include "LanternScene/Geometry/Geometry.h"

namespace Lantern
{

class FCoarserLevel
{
public:
	/// Share: of each section's triangles, at most; each keeps one at least. Reads Info's CPU data until it is done or
	/// destroyed, which waits for the section in hand.
	FCoarserLevel(const FRTGeometryInfo& Info, double Share);
	~FCoarserLevel() { bCancel = true; }
	FCoarserLevel(const FCoarserLevel&) = delete;
	FCoarserLevel& operator=(const FCoarserLevel&) = delete;

	bool IsDone() const { return bDone.load(std::memory_order_acquire); }
	void Wait() { Task.Wait(); }
	// Once done.
	/// Empty: there was no memory to make it.
	const std::vector<uint32_t>& GetIndices() const { return Indices; }
	/// One for each section, ranges of GetIndices().
	const std::vector<FRTGeometryPart>& GetParts() const { return Parts; }

private:
	void Make(const FRTGeometryInfo& Info, double Share);

	std::vector<uint32_t> Indices;
	std::vector<FRTGeometryPart> Parts;
	std::atomic<bool> bDone{false}, bCancel{false};
	FTaskGroup Task; // last: waits before the rest goes
};

} // namespace Lantern
