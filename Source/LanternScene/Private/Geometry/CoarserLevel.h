// A coarser level of detail: fewer triangles over the same vertices, simplified by a task beside the frame.
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
	/// Share: the most that stays of each section's triangles, 0 to 1. Each section keeps at least one triangle. The task
	/// reads Info and its CPU data until it is done, or until the destructor, which waits for the current section.
	FCoarserLevel(const FRTGeometryInfo& Info, double Share);
	~FCoarserLevel() { bCancel = true; }
	FCoarserLevel(const FCoarserLevel&) = delete;
	FCoarserLevel& operator=(const FCoarserLevel&) = delete;

	bool IsDone() const { return bDone.load(std::memory_order_acquire); }
	void Wait() { Task.Wait(); }
	/// Ends the task with its current section.
	void Cancel() { bCancel = true; }

	// Valid once the level is done.
	/// Empty: there was no memory for the level.
	const std::vector<uint32_t>& GetIndices() const { return Indices; }
	/// One part for each section; ranges count GetIndices().
	const std::vector<FRTGeometryPart>& GetParts() const { return Parts; }

private:
	void Make(const FRTGeometryInfo& Info, double Share);

	std::vector<uint32_t> Indices;
	std::vector<FRTGeometryPart> Parts;
	std::atomic<bool> bDone{false}, bCancel{false};
	FTaskGroup Task; // last: its destructor waits before the rest goes
};

} // namespace Lantern
