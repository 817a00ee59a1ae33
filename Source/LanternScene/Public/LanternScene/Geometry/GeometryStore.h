// All geometries of a scene and the memory of their acceleration structures. Builds are spread over frames by budget and
// priority. Static structures are compacted. Deformed geometry is refitted and rebuilt. Where memory is short, coarser levels
// of detail take the place of what does not fit.
//
// One budget (r.RT.Build.MemoryMB) limits the peak. It counts all structures that live, including those over instances
// (TLAS), and those being built. It also counts copies during compaction, scratch, and released memory that the GPU
// still uses. A build that would exceed the budget waits while other memory is about to be freed. After that its geometry is
// made coarser, or it is left out of the scene until there is room.
//
// Order of a frame: Create, MarkDeformed, … → BeginFrame → Record → submission → EndFrame. Nothing waits for the GPU.
// Threads: render thread, with two exceptions. Any thread may call RaisePriority. Any thread may look up slots between
// BeginFrame and the next change.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "LanternScene/Geometry/Geometry.h"

namespace Lantern
{

/// Bytes are as the device counts them.
struct FGeometryStoreStats
{
	// Now.
	uint64_t LiveBytes = 0; ///< structures, including those that the GPU has yet to let go
	uint64_t ScratchBytes = 0;
	uint64_t PeakBytes = 0;            ///< structures, structures over instances and scratch, since the store was made
	uint64_t CompactionSavedBytes = 0; ///< since the store was made
	uint32_t Pending = 0;              ///< geometries that wait for their data, for a build or for a coarser level
	uint32_t Coarse = 0;               ///< geometries that are a coarser level of detail
	uint32_t Refused = 0;              ///< geometries that are left out because they do not fit into memory
	// In the last frame.
	uint64_t TrianglesBuilt = 0; ///< by builds of static geometry and by rebuilds
	uint32_t Built = 0, Refitted = 0, Rebuilt = 0, Compacted = 0;
	uint32_t WaitingForMemory = 0; ///< builds that were due and had no memory
};

class FGeometryStore
{
public:
	explicit FGeometryStore(IRTDevice& Device);
	~FGeometryStore();
	FGeometryStore(const FGeometryStore&) = delete;
	FGeometryStore& operator=(const FGeometryStore&) = delete;

	/// Queues the build: it runs in one of the next frames. Until then the geometry costs no memory here.
	/// InvalidArgument, with the name and the section: a section has no triangles, or one of its buffers is missing.
	/// Unsupported, with the name: the geometry has more triangles than the device allows. On error nothing has changed.
	FRTStatus Create(FRTGeometryInfo Info, FRTGeometryRef& Out);
	/// Returns the error that Create would return. Any thread.
	static FRTStatus Check(const FRTGeometryInfo& Info, const FRTCapabilities& Capabilities);
	/// Says that the buffers of a geometry with FRTGeometryInfo::bWaitsForData are filled, as seen by commands that Record records.
	void MarkFilled(const FRTGeometryRef& Geometry);
	/// Says that a dynamic geometry's vertices are new in this frame.
	void MarkDeformed(const FRTGeometryRef& Geometry);
	/// Says whether parts follow the opacity classification of their sections. They do at first. If that changes, parts
	/// change at once and the geometry is built anew before all others. Its objects are left out until then.
	/// Must come before BeginFrame.
	void SetOpacityUse(bool bUsed);
	bool IsOpacityUsed() const;
	/// Says that Slot's geometry is used with an alpha test that it was not classified for. Its parts then ignore the
	/// classification for good, with the effects that SetOpacityUse has. Must come before BeginFrame.
	void RefuteOpacity(uint32_t Slot);
	/// Ratio: how much looser the boxes around a dynamic geometry's triangles are than at its last build. The GPU measured
	/// it a few frames ago. If it is above r.RT.Skinning.RebuildQuality, the next deformation rebuilds the geometry.
	void SetRefitQuality(uint32_t Slot, float Ratio);
	bool WantsRefitQuality() const; ///< r.RT.Skinning.RebuildQuality is on; render thread
	/// Number of builds of Slot's structure so far; after EndFrame this includes the frame's own. It tells which build a
	/// measurement belongs to.
	uint32_t GetBuildCount(uint32_t Slot) const;
	/// Frees what owners have let go; BeginFrame does so, too. Returns at once if there is nothing.
	void FreeReleased();
	bool HasReleased() const;
	/// BeginFrame and Record would do something.
	bool NeedsUpdate() const;

	/// Must come at the start of a frame. Takes over what was compacted or made coarser, chooses this frame's builds and
	/// creates their structures. From then on GetAddress says what instances of this frame use.
	/// bBuildAll: builds all that is pending and ignores r.RT.Build.TrianglesPerFrame. What does not fit into memory is made
	/// coarser at once. On error nothing is to be recorded.
	FRTStatus BeginFrame(bool bBuildAll);
	/// Divides this frame's builds and refits into at most about MostParts parts, for RecordPart. Returns how many there are; 0:
	/// too few to divide, and Record does them.
	uint32_t Plan(uint32_t MostParts);
	/// Records a part. Tasks may record several at once, into lists that run in the order of parts, before that of Record.
	void RecordPart(IRTCommandList& List, uint32_t Part) const;
	/// Records builds and refits, unless Plan has divided them, compaction and queries of sizes. Ends with a barrier.
	FRTStatus Record(IRTCommandList& List);
	/// bSubmitted: false if what was recorded never runs. All of it is then recorded again.
	void EndFrame(bool bSubmitted);

	/// Device address of Slot's structure. 0: it is not there (yet), and its objects are left out.
	uint64_t GetAddress(uint32_t Slot) const { return Slot < Addresses.size() ? Addresses[Slot] : 0; }
	/// Makes larger geometries be built sooner. ScreenSize: how large the largest object of the geometry looks, its diameter over its
	/// distance. Any thread, also during BeginFrame.
	void RaisePriority(uint32_t Slot, float ScreenSize);
	/// Slots whose address, parts or index buffer changed since the last call, each once.
	std::vector<uint32_t> TakeChanged();
	/// Null: the slot is free.
	const FRTGeometry* Get(uint32_t Slot) const;
	uint32_t GetSlotCount() const { return static_cast<uint32_t>(Addresses.size()); }
	uint32_t GetDynamicCount() const;
	const FGeometryStoreStats& GetStats() const;
	/// Makes the scratch buffer hold Bytes, for whoever builds after Record in the same frame. Ignores the memory budget;
	/// later frames reserve this amount before they choose their builds.
	FRTStatus ReserveScratch(uint64_t Bytes, IRTBuffer*& Out);

private:
	struct FImpl;
	std::vector<uint64_t> Addresses; ///< of each slot; kept by Impl, here for speed
	std::unique_ptr<FImpl> Impl;
};

} // namespace Lantern
