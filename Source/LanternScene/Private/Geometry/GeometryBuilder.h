// The builds and refits of one frame: it creates structures, divides the scratch buffer and records the commands.
#pragma once

#include <cstdint>
#include <vector>

#include "Geometry/GeometryCompactor.h"
#include "Geometry/GeometryContext.h"
#include "Geometry/GeometryRefits.h"

namespace Lantern
{

/// Order of a frame: AddRefit and AddBuild, GrowForBatches, Plan, recording, then Submitted or Lost. Threads: render thread, but
/// parts may be recorded by tasks at once.
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
	/// Divides the scratch buffer among the builds, and the builds into parts of at least FewestPerPart. Returns how many parts
	/// there are: at most MostParts, unless batches end between them, and 0 if there is nothing to build.
	uint32_t Plan(uint32_t MostParts);
	/// Copies a coarser level's indices to where its build reads them. Must come before the first part.
	void RecordStaging(IRTCommandList& List) const;
	/// Records a part of Plan. Builds of a batch do not share scratch; a barrier stands behind the last of each.
	void RecordPart(IRTCommandList& List, uint32_t Part) const;
	/// The frame was submitted.
	void Submitted();
	/// The frame never runs: builds are queued again, before all others, and refits too.
	void Lost();

	static constexpr uint32_t FewestPerPart = 64; ///< below it a command list costs more than it saves

private:
	uint64_t GetScratchBytes(const FGeometryEntry& Entry) const;

	struct FPart
	{
		size_t First = 0, End = 0; // in Builds
		bool bEndsBatch = false;
	};

	FGeometryContext& Context;
	FGeometryCompactor& Compactor;
	FGeometryRefits& Refits;
	std::vector<FGeometrySlotRef> Builds; ///< refits included
	// Of Plan. What builds after this in the frame may replace the scratch buffer while parts are being recorded.
	std::vector<FPart> Parts;
	std::vector<uint64_t> ScratchOffsets; // by build
	TRTRef<IRTBuffer> PlannedScratch;
};

} // namespace Lantern
