// Copies static acceleration structures to as little memory as they need. Nothing waits for the GPU: sizes are queried, read
// frames later, and a copy is taken over in the frame after it was made.
#pragma once

#include <cstdint>
#include <vector>

#include "Geometry/GeometryContext.h"

namespace Lantern
{

/// Order of a frame: TakeCopies, TakeSizes, Choose, Want for each build, RecordCopies and RecordQueries behind the builds,
/// then Submitted or Lost. Threads: render thread.
class FGeometryCompactor
{
public:
	explicit FGeometryCompactor(FGeometryContext& Context);

	static bool IsOn(); ///< r.RT.Build.Compaction
	/// The entry's build was submitted, with a structure that allows compaction: the next frame asks for its size.
	void Want(FGeometryEntry& Entry);
	/// The entry's structure is gone: sizes that were queried for it no longer count.
	void Forget(FGeometryEntry& Entry);

	/// Replaces structures by the copies that the last submitted frame made.
	void TakeCopies();
	/// Reads sizes whose queries the GPU has finished. A copy that would save less than a tenth is not made.
	void TakeSizes();
	/// Creates structures for this frame's copies, the smallest first, as far as the budget and a limit of bytes in a frame
	/// allow. Out of memory is no error: the copies wait.
	FRTStatus Choose();

	bool HasCopies() const { return !Copying.empty(); }
	bool HasCommands() const { return !Copying.empty() || !Wanted.empty(); }
	/// The caller puts a barrier for BuildRead and BuildWrite before and behind.
	void RecordCopies(IRTCommandList& List);
	/// Queries the sizes of what earlier frames have built. Out of memory is no error.
	FRTStatus RecordQueries(IRTCommandList& List);
	/// The frame was submitted.
	void Submitted();
	/// The frame never runs: copies and queries are recorded again.
	void Lost();

	/// A frame has something to do here.
	bool NeedsUpdate() const;
	/// Compaction is about to give memory back.
	bool IsBusy() const { return !Batches.empty() || HasCommands(); }
	/// Share of a structure's bytes that compaction leaves, as seen so far, 0 to 1.
	float GetExpectedShare() const { return ExpectedShare; }

private:
	/// Queries of one frame.
	struct FSizeBatch
	{
		TRTRef<IRTQueryPool> Queries;
		std::vector<FGeometrySlotRef> Items;
		bool bSubmitted = false;
	};
	bool Fits(const FGeometryEntry& Entry) const;
	void TakeSize(FGeometrySlotRef Ref, uint64_t Bytes);
	void DropUnwanted();
	FRTStatus CreateCopy(FGeometryEntry& Entry);

	FGeometryContext& Context;
	std::vector<FGeometrySlotRef> Wanted, Sized;
	std::vector<FGeometrySlotRef> Copying; ///< this frame
	std::vector<FGeometrySlotRef> Copied;  ///< submitted, to be taken over
	std::vector<FSizeBatch> Batches;
	float ExpectedShare = 0.7f;
};

} // namespace Lantern
