// FObjectMotions keeps where objects were in the viewer's previous frame: FObjectMotion[]. An object has an entry only if it moved
// or was deformed since then. Costs follow what moves: once nothing moves, nothing is written.
//
// Transforms are kept as they were on the GPU, relative to their cell. A moving origin therefore changes no entry, and the
// difference between two frames is exact everywhere in the world.
//
// A viewer is whoever keeps something from frame to frame, such as a view of a renderer. Each viewer has a previous frame of its
// own. A shape has one: a geometry keeps the vertices of one earlier frame.
//
// Threads: one at a time.
#pragma once

#include <deque>
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
	/// Call this before the object's transform changes. The motion leads to where each viewer's last submitted frame showed it.
	/// O(viewers).
	void BeforeMove(uint32_t Object);
	/// Tells that the geometry's vertices are new in this frame. Has no effect without FRTGeometryInfo::PreviousPositions.
	void MarkDeformed(const FRTGeometryRef& Geometry);
	/// Returns the value for FObjectData::Motion.
	uint32_t GetEntry(uint32_t Object) const { return Object < States.size() ? States[Object].Entry : NO_MOTION; }
	/// Forgets objects from Count on. All of them must have been removed.
	void Truncate(uint32_t Count);

	/// Says whose frame the next one is, until another call; 0 at first. Viewers are told apart by any numbers. One whose frames
	/// KeptFrames of others have followed is forgotten. Returns whether motions lead back to this viewer's own last frame. They
	/// do not if it has none, or if a geometry was deformed in a frame of another viewer since.
	bool SetViewer(uint64_t Viewer);
	static constexpr uint32_t KeptFrames = 64;
	/// Tells whether Update would do anything.
	bool NeedsUpdate(bool bWanted) const { return Table.Num() > 0 || (bWanted && !(GetMoves().empty() && Deformed.empty())); }
	/// Makes the entries of this frame; none if not bWanted.
	void Update(bool bWanted);
	/// If bSubmitted, this frame becomes the viewer's previous one. Otherwise the previous one stays.
	void EndFrame(bool bSubmitted);

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
		uint32_t Entry = NO_MOTION; // place in Table
		uint32_t Born = 0;          // Frame when it was added
	};
	struct FMove
	{
		uint32_t Object = 0;
		FObjectMotion Before{};
	};
	struct FViewer
	{
		uint64_t Id = 0;
		uint32_t LastFrame = 0;       // value of Frame after its last one; 0: there is none
		uint32_t IdleFrames = 0;      // of others since then
		std::vector<FMove> Moves;     // since then, each object once
		std::vector<uint32_t> Places; // in Moves, by object; shorter if no later object has moved
		uint32_t FindPlace(uint32_t Object) const { return Object < Places.size() ? Places[Object] : None; }
		void Add(uint32_t Object, const FObjectMotion& Before);
		void Forget(uint32_t Object);
		void Clear();
	};
	static FObjectMotion MakeMotion(const FObjectData& Data);
	static uint64_t FindPreviousPositions(const FState& State);
	static bool HasPast(const FState& State, const FViewer& Viewer) { return State.Born < Viewer.LastFrame; }
	FViewer& GetViewer() { return Viewers[Current]; }
	const std::vector<FMove>& GetMoves() const { return Viewers[Current].Moves; }
	void JoinDeformable(uint32_t Object, const FRTGeometry& Geometry);
	void LeaveDeformable(uint32_t Object);
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
	std::deque<FState> States;  // by object; grows without moving what is there
	std::vector<FViewer> Viewers = std::vector<FViewer>(1);
	size_t Current = 0; // of Viewers
	std::unordered_map<const FRTGeometry*, FDeformable> Deformables;
	std::vector<FRTGeometryRef> Deformed; // in this frame, each once
	uint32_t Frame = 1;                   // counts submitted ones
	uint32_t LastDeformed = 0;            // number of the last frame in which something was deformed
	uint32_t UpdateNumber = 0;
	uint32_t MostEntries = 0; // since the table was empty
};

} // namespace Lantern
