// Where objects were in the frame before: FObjectMotion[], with an entry for each object that moved or was deformed since
// the last submitted frame, and for no other. Costs follow what moves: an object that stands still has no entry, and once
// nothing moves nothing is written.
//
// Transforms are kept as they were on the GPU, relative to their cell, so that a moving origin changes no entry and the
// difference between the two frames is exact wherever in the world they are.
//
// There is one frame before: of a scene that several renderers show in turn, only the one that showed it last may carry
// anything over.
//
// Threads: one at a time.
#pragma once

#include <unordered_map>
#include <vector>

#include "LanternScene/Geometry/Geometry.h"
#include "LanternScene/Memory/GpuTable.h"
#include "SceneTypes.h"

namespace Lantern
{

class FObjectMotions
{
public:
	/// InObjects: whose Motion members are kept up to date; outlives this.
	explicit FObjectMotions(TGpuTable<FObjectData>& InObjects) : Objects(InObjects) {}

	/// A new object: it has no past until a frame has shown it.
	void Add(uint32_t Object, const FRTGeometry& Geometry);
	void Remove(uint32_t Object);
	/// Before the object's transform becomes another. What counts is where the last submitted frame showed it.
	void BeforeMove(uint32_t Object);
	/// The geometry's vertices are new in this frame. Matters where it has FRTGeometryInfo::PreviousPositions.
	void MarkDeformed(const FRTGeometryRef& Geometry);
	/// For FObjectData::Motion.
	uint32_t GetEntry(uint32_t Object) const { return Object < States.size() ? States[Object].Entry : NO_MOTION; }
	/// Forgets objects from Count on, all of which were removed.
	void Truncate(uint32_t Count);

	bool NeedsUpdate(bool bWanted) const { return Table.Num() > 0 || (bWanted && !(Moves.empty() && Deformed.empty())); }
	/// Entries for this frame; none where nobody wants them.
	void Update(bool bWanted);
	/// bSubmitted: the frame is now the one before. Else the one before stays what it was.
	void EndFrame(bool bSubmitted);
	/// Counts frames that were submitted, by whichever renderer: what these motions lead back to is the newest.
	uint32_t GetFrame() const { return Frame; }

	TGpuTable<FObjectMotion>& GetTable() { return Table; }
	const TGpuTable<FObjectMotion>& GetTable() const { return Table; }

private:
	static constexpr uint32_t None = ~0u;
	/// A geometry that keeps its previous positions, and who has it.
	struct FDeformable
	{
		const FRTGeometry* Geometry = nullptr;
		std::vector<uint32_t> Objects;
	};
	struct FState
	{
		FDeformable* Deformable = nullptr;
		uint32_t Member = None;     // place in Deformable's list
		uint32_t Move = None;       // place in Moves
		uint32_t Entry = NO_MOTION; // place in Table
		uint32_t Born = 0;          // Frame when it was added
	};
	struct FMove
	{
		uint32_t Object = 0;
		FObjectMotion Before{};
	};
	static FObjectMotion MakeMotion(const FObjectData& Data);
	static uint64_t FindPreviousPositions(const FState& State);
	bool HasPast(const FState& State) const { return State.Born != Frame; }
	void LeaveDeformable(uint32_t Object);
	void ForgetMove(uint32_t Object);
	void Write(uint32_t Object, FObjectMotion Motion);
	void RemoveEntry(uint32_t Entry);
	void SetEntry(uint32_t Object, uint32_t Entry);

	TGpuTable<FObjectData>& Objects;
	TGpuTable<FObjectMotion> Table{"ObjectMotions"};
	struct FOwner
	{
		uint32_t Object = 0;
		uint32_t Update = 0; // in which the entry was last wanted
	};
	std::vector<FOwner> Owners; // of the entries
	std::vector<FState> States; // by object
	std::vector<FMove> Moves;   // since the last submitted frame, each object once
	std::unordered_map<const FRTGeometry*, FDeformable> Deformables;
	std::vector<FRTGeometryRef> Deformed; // in this frame, each once
	uint32_t Frame = 1;                   // counts submitted ones
	uint32_t UpdateNumber = 0;
	uint32_t MostEntries = 0; // since the table was empty
};

} // namespace Lantern
