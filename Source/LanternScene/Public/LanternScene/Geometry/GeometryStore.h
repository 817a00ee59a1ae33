// All geometries of a scene and the memory of their acceleration structures: builds spread over frames by budget and
// priority, compaction, refits and rebuilds of deformed geometry, coarser levels of detail where memory is short.
//
// One budget (r.RT.Build.MemoryMB) counts the peak: what lives, instances' structures (TLAS) included, what is being built,
// both copies while one is compacted, scratch, and what was released but is still in use by the GPU. A build that would exceed it waits while something is
// about to give memory back; after that its geometry is made coarser, or is left out of the scene until there is room.
//
// Order of a frame: Create, MarkDeformed, … → BeginFrame → Record → submission → EndFrame. Nothing waits for the GPU.
// Threads: render thread, but for RaisePriority, and for the look-ups, which any thread may do between BeginFrame and the
// next change.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "LanternScene/Geometry/Geometry.h"

namespace Lantern
{

struct FGeometryStoreStats
{
	// Now; bytes as the device counts them.
	uint64_t LiveBytes = 0; ///< structures, those that the GPU has yet to let go included
	uint64_t ScratchBytes = 0;
	uint64_t PeakBytes = 0;            ///< of both and structures over instances, since the store was made
	uint64_t CompactionSavedBytes = 0; ///< since the store was made
	uint32_t Pending = 0;              ///< to be built, those in a coarser level's making included
	uint32_t Coarse = 0;               ///< are a coarser level of detail
	uint32_t Refused = 0;              ///< left out for want of memory
	// In the last frame.
	uint64_t TrianglesBuilt = 0; ///< static builds and rebuilds
	uint32_t Built = 0, Refitted = 0, Rebuilt = 0, Compacted = 0;
	uint32_t WaitingForMemory = 0; ///< wanted a build and did not get it for want of memory
};

class FGeometryStore
{
public:
	explicit FGeometryStore(IRTDevice& Device);
	~FGeometryStore();
	FGeometryStore(const FGeometryStore&) = delete;
	FGeometryStore& operator=(const FGeometryStore&) = delete;

	/// Queues the build: it runs in one of the next frames. Until then the geometry costs no memory here.
	/// InvalidArgument, with the name and the section: a section without triangles, or without its buffers.
	/// Unsupported, with the name: more triangles than the device allows. On error nothing has changed.
	FRTStatus Create(FRTGeometryInfo Info, FRTGeometryRef& Out);
	/// A dynamic geometry's vertices are new in this frame.
	void MarkDeformed(const FRTGeometryRef& Geometry);
	/// Whether parts follow the classification of their sections, as they do from the start. Where that changes parts do at
	/// once, and the geometry is built anew before all others; its objects are left out until then. Before BeginFrame.
	void SetOpacityUse(bool bUsed);
	bool IsOpacityUsed() const { return bUseOpacity; }
	/// Slot's geometry is used with an alpha test that it was not classified for: as above, for good.
	void RefuteOpacity(uint32_t Slot);
	/// Measured on the GPU a few frames ago: how much looser the boxes around a dynamic geometry's triangles are than they
	/// were when it was built. Above r.RT.Skinning.RebuildQuality it is rebuilt at its next deformation.
	void SetRefitQuality(uint32_t Slot, float Ratio);
	bool WantsRefitQuality() const; ///< r.RT.Skinning.RebuildQuality is on; render thread
	/// Builds of Slot's structure so far, after EndFrame that frame's too: tells which build a measurement belongs to.
	uint32_t GetBuildCount(uint32_t Slot) const;
	/// Whether BeginFrame and Record would do anything.
	bool NeedsUpdate() const;

	/// Frame start: takes over what was compacted or made coarser, chooses this frame's builds (bBuildAll: all pending,
	/// whatever r.RT.Build.TrianglesPerFrame says; what does not fit into memory is made coarser on the spot) and creates
	/// their structures. From then on GetAddress says what instances of this frame use. On error nothing is to be recorded.
	FRTStatus BeginFrame(bool bBuildAll);
	/// Builds, refits, compaction, queries of sizes. Ends with a barrier.
	FRTStatus Record(IRTCommandList& List);
	/// bSubmitted: false where what was recorded never runs: all of it is recorded again.
	void EndFrame(bool bSubmitted);

	/// 0: not (yet) there; its objects are left out.
	uint64_t GetAddress(uint32_t Slot) const { return Slot < Addresses.size() ? Addresses[Slot] : 0; }
	/// Larger is sooner. ScreenSize: of the geometry's largest object, in heights of the picture. Lock-free; any thread,
	/// also during BeginFrame.
	void RaisePriority(uint32_t Slot, float ScreenSize);
	/// Slots whose address, parts or index buffer changed since the last call, each once.
	std::vector<uint32_t> TakeChanged();
	/// Null: the slot is free.
	const FRTGeometry* Get(uint32_t Slot) const;
	uint32_t GetSlotCount() const { return static_cast<uint32_t>(Entries.size()); }
	uint32_t GetDynamicCount() const { return DynamicCount; }
	const FGeometryStoreStats& GetStats() const { return Stats; }
	/// The scratch buffer, made to hold Bytes: for whoever builds after Record in the same frame. What must be, budget or
	/// not; as much is set aside when later frames choose their builds.
	FRTStatus ReserveScratch(uint64_t Bytes, IRTBuffer*& Out);

private:
	enum class EState : uint8_t
	{
		Free,
		Pending,    ///< waits for its build
		Coarsening, ///< waits for a coarser level
		Building,   ///< this frame
		Built,
		Refused, ///< does not fit
	};
	enum class ECompaction : uint8_t
	{
		None,    ///< not wanted, or done
		Wanted,  ///< its size is to be asked for
		Queried, ///< asked
		Sized,   ///< known; waits for room
		Copying, ///< this frame
		Copied,  ///< taken over in the next frame
	};
	struct FEntry
	{
		std::weak_ptr<FRTGeometry> Owner;
		FRTGeometry* Geometry = nullptr; ///< good where Owner is; null: a free slot
		EState State = EState::Free;
		ECompaction Compaction = ECompaction::None;
		bool bDeformed = false;
		bool bLost = false;        ///< was recorded in a frame that never ran
		bool bRefuted = false;     ///< its classification is no longer right
		bool bRebuild = false;     ///< the next refit must be a build
		bool bUpdate = false;      ///< this frame: a refit
		bool bSaid = false;        ///< that it does not fit
		bool bChanged = false;     ///< is in Changed
		bool bCompactable = false; ///< its structure allows compaction
		uint32_t Generation = 0;
		bool bCoarse = false;
		uint32_t Misfits = 0; ///< frames in which nothing but its size was in the way
		uint32_t Waits = 0;   ///< frames in which others waited for it
		uint32_t Coarsenings = 0;
		uint32_t RefitsSinceBuild = 0, Builds = 0;
		uint64_t Age = 0; ///< order of creation
		uint64_t QueuedFrame = 0;
		float ScreenSize = 0.0f, RefitRatio = 1.0f;
		uint64_t Triangles = 0; ///< in all parts
		FRTBuildSizes Sizes;
		uint64_t CompactedBytes = 0, RefusedRoom = 0;
		TRTRef<IRTGeometry> Compacted;
		TRTRef<IRTBuffer> Staging; ///< indices of a coarser level on their way
	};
	struct FSlotRef
	{
		uint32_t Slot, Generation;
	};
	/// Sizes asked for by one frame.
	struct FSizeBatch
	{
		TRTRef<IRTQueryPool> Queries;
		std::vector<FSlotRef> Items;
		bool bSubmitted = false;
	};
	static constexpr uint32_t ChunkSlots = 4096, MaxChunks = 4096;

	// GeometryStore.cpp
	FRTStatus Check(const FRTGeometryInfo& Info) const;
	uint32_t TakeSlot();
	FEntry* Resolve(FSlotRef Ref); ///< null: it is gone
	FSlotRef MakeRef(const FEntry& Entry) const;
	void DrainReleases();
	void MarkChanged(FEntry& Entry);
	void SetAddress(FEntry& Entry, uint64_t Address);
	void UpdateStats();
	void Submitted();
	void Lost();
	bool IsScratchTooLarge() const;
	void ShrinkScratch();
	// GeometryStoreOpacity.cpp
	void ForgetStructure(FEntry& Entry);
	void ApplyOpacity(FEntry& Entry);
	// GeometryStoreBuilds.cpp
	FRTGeometryDesc MakeDesc(const FEntry& Entry, const std::vector<FRTGeometrySection>& Sections) const;
	void UpdateSizes(FEntry& Entry);
	void Queue(FEntry& Entry);
	FRTStatus ChooseRefits();
	/// Which of Due are built instead; Need: the largest scratch so far.
	void ChooseRebuilds(std::vector<FEntry*>& Due, uint32_t Interval, uint64_t& Need);
	FRTStatus ChooseBuilds(bool bBuildAll);
	void OrderPending(bool bBuildAll);
	FRTStatus ChooseBuild(FEntry& Entry, bool bBuildAll, uint64_t Share, bool& bOutStop);
	FRTStatus Admit(FEntry& Entry);
	FRTStatus GrowScratch(uint64_t Bytes);
	FRTStatus ReserveBatchScratch();
	void RecordStaging(IRTCommandList& List);
	void RecordBuilds(IRTCommandList& List);
	void RecordCompaction(IRTCommandList& List);
	FRTStatus RecordQueries(IRTCommandList& List);
	// GeometryStoreMemory.cpp
	uint64_t GetBudget() const; ///< 0: there is none
	uint64_t GetUsed() const;
	uint64_t GetRoom() const; ///< ~0: there is no budget
	uint64_t GetScratchGrowth(uint64_t Bytes) const;
	bool IsMemoryComing() const;
	void TakeSizes();
	void TakeCompacted();
	bool FitsCompacted(const FEntry& Entry) const;
	FRTStatus ChooseCompactions();
	void ReconsiderRefused();
	FRTStatus TakeCoarser();
	FRTStatus TakeCoarser(FEntry& Entry);
	bool CanCoarsen(const FEntry& Entry) const;
	bool IsWorthAnother(const FEntry& Entry, uint64_t Room) const;
	bool StartCoarser(FEntry& Entry, uint64_t Room);
	void Refuse(FEntry& Entry, uint64_t Room);
	FRTStatus OnMisfit(FEntry& Entry, bool bBuildAll, uint64_t Room);

	IRTDevice& Device;
	std::shared_ptr<FGeometryReleases> Releases;
	std::vector<FEntry> Entries;
	std::vector<uint64_t> Addresses;
	std::vector<uint32_t> FreeSlots, Changed;
	/// Screen sizes as bits of floats, which order as they do. In chunks that never move, since any thread writes.
	std::array<std::unique_ptr<std::atomic<uint32_t>[]>, MaxChunks> Priorities;
	std::vector<FSlotRef> Pending; ///< in order while builds are chosen
	std::vector<FSlotRef> Deformed, Coarsening, Refused, WantSize, Sized;
	std::vector<FSlotRef> Recorded;   ///< builds and refits of this frame
	std::vector<FSlotRef> Copying;    ///< compactions of this frame
	std::vector<FSlotRef> Copied;     ///< and of the frame before, to be taken over
	std::vector<FRTGeometryRef> Held; ///< of this frame
	std::vector<FSizeBatch> Batches;
	TRTRef<IRTBuffer> Scratch;
	uint64_t ScratchNeed = 0, RecentScratchNeed = 0;
	uint64_t SceneScratch = 0, RefitScratch = 0; ///< that the last frame with either could not do without
	uint32_t FramesScratchTooLarge = 0;
	uint64_t Frame = 0, NextAge = 0, LastReleaseFrame = 0;
	uint32_t DynamicCount = 0;
	float CompactedShare = 0.7f; ///< what compaction leaves, as seen so far
	bool bUseOpacity = true;
	FGeometryStoreStats Stats;
};

} // namespace Lantern
