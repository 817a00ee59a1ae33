// FObjectMotions keeps where objects were in the previous frame: FObjectMotion[]. An object has an entry only if it moved
// or was deformed since the last submitted frame. Costs follow what moves: once nothing moves, nothing is written.
//
// Transforms are kept as they were on the GPU, relative to their cell. A moving origin therefore changes no entry, and the
// difference between two frames is exact everywhere in the world.
//
// There is only one previous frame. If several renderers show a scene in turn, only the one that showed it last may
// reuse its history.
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
	/// Keeps the Motion members of InObjects up to date. InObjects outlives this.
	explicit FObjectMotions(TGpuTable<FObjectData>& InObjects) : Objects(InObjects) {}

	/// Adds an object. It has no motion until a submitted frame has shown it.
	void Add(uint32_t Object, const FRTGeometry& Geometry);
	void Remove(uint32_t Object);
	/// Tells that the object has another geometry from now on. Its own motion stays.
	void SetGeometry(uint32_t Object, const FRTGeometry& Geometry);
	/// Call this before the object's transform changes. The motion leads to where the last submitted frame showed it.
	void BeforeMove(uint32_t Object);
	/// Tells that the geometry's vertices are new in this frame. Has no effect without FRTGeometryInfo::PreviousPositions.
	void MarkDeformed(const FRTGeometryRef& Geometry);
	/// Returns the value for FObjectData::Motion.
	uint32_t GetEntry(uint32_t Object) const { return Object < States.size() ? States[Object].Entry : NO_MOTION; }
	/// Forgets objects from Count on. All of them must have been removed.
	void Truncate(uint32_t Count);

	/// Tells whether Update would do anything.
	bool NeedsUpdate(bool bWanted) const { return Table.Num() > 0 || (bWanted && !(Moves.empty() && Deformed.empty())); }
	/// Makes the entries of this frame; none if not bWanted.
	void Update(bool bWanted);
	/// If bSubmitted, this frame becomes the previous one. Otherwise the previous one stays.
	void EndFrame(bool bSubmitted);
	/// Counts the frames that any renderer submitted. The motions lead back to the newest of them.
	uint32_t GetFrame() const { return Frame; }
	/// Whether a frame after number Since was the first that showed something move. Whoever showed the scene at Since, and not since
	/// then, would take the motion of this frame for that since its own.
	bool HasMovedSince(uint32_t Since) const { return LastMoved > Since; }

	TGpuTable<FObjectMotion>& GetTable() { return Table; }
	const TGpuTable<FObjectMotion>& GetTable() const { return Table; }

private:
	static constexpr uint32_t None = ~0u;
	/// A geometry that keeps its previous positions, and the objects that have it.
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
	void JoinDeformable(uint32_t Object, const FRTGeometry& Geometry);
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
	uint32_t LastMoved = 0;               // number of the last frame in which something moved
	uint32_t UpdateNumber = 0;
	uint32_t MostEntries = 0; // since the table was empty
};

} // namespace Lantern
