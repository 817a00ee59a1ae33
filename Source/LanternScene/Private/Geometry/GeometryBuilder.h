// The builds and refits of one frame: it creates structures, divides the scratch buffer and records the commands.
#pragma once

#include <cstdint>
#include <vector>

#include "Geometry/GeometryCompactor.h"
#include "Geometry/GeometryContext.h"
#include "Geometry/GeometryRefits.h"

namespace Lantern
{

/// Order of a frame: AddRefit and AddBuild, GrowForBatches, Record, then Submitted or Lost. Threads: render thread.
class FGeometryBuilder
{
public:
	FGeometryBuilder(FGeometryContext& Context, FGeometryCompactor& Compactor, FGeometryRefits& Refits);

	/// Adds the refit of a built entry, or its rebuild if bUpdate is false. The scratch buffer must hold either.
	void AddRefit(FGeometryEntry& Entry);
	/// Creates the entry's structure if it has none. The entry becomes Building and gets its address. On error it stays
	/// Pending.
	FRTStatus AddBuild(FGeometryEntry& Entry);
	bool HasBuilds() const { return !Builds.empty(); }
	/// Grows the scratch buffer so that many builds overlap, if there is room. Out of memory is no error.
	FRTStatus GrowForBatches();
	/// Copies a coarser level's indices to where its build reads them. Must come before RecordBuilds.
	void RecordStaging(IRTCommandList& List);
	/// Records batches with a barrier behind each. Builds of a batch do not share scratch.
	void RecordBuilds(IRTCommandList& List);
	/// The frame was submitted.
	void Submitted();
	/// The frame never runs: builds are queued again, before all others, and refits too.
	void Lost();

private:
	uint64_t GetScratchBytes(const FGeometryEntry& Entry) const;
	/// Records one batch of builds that starts at Builds[Next]. Returns where the next batch starts.
	size_t RecordBatch(IRTCommandList& List, size_t Next);

	FGeometryContext& Context;
	FGeometryCompactor& Compactor;
	FGeometryRefits& Refits;
	std::vector<FGeometrySlotRef> Builds; ///< refits included
};

} // namespace Lantern
