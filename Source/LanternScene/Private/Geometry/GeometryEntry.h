// The state that FGeometryStore keeps for one geometry.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "LanternScene/Geometry/Geometry.h"

namespace Lantern
{

enum class EGeometryState : uint8_t
{
	Free,       ///< The slot has no geometry.
	Filling,    ///< The geometry waits for its data.
	Pending,    ///< The geometry waits for its build.
	Coarsening, ///< The geometry waits for a coarser level.
	Building,   ///< This frame builds the geometry.
	Built,
	Refused, ///< The geometry does not fit into the memory budget.
};

enum class EGeometryCompaction : uint8_t
{
	None,    ///< Compaction is done or not wanted.
	Wanted,  ///< The compacted size is to be queried.
	Queried, ///< The query is recorded.
	Sized,   ///< The size is known; the copy waits for room.
	Copying, ///< This frame copies the structure.
	Copied,  ///< The next frame takes the copy over.
};

/// Names a geometry in a slot. It resolves to nothing after the geometry is gone, even if the slot is used again.
struct FGeometrySlotRef
{
	uint32_t Slot = 0, Generation = 0;
};

/// Its functions are the only ones that change an FRTGeometry's acceleration structure, parts and indices.
struct FGeometryEntry
{
	std::weak_ptr<FRTGeometry> Owner;
	FRTGeometry* Geometry = nullptr; ///< valid until FGeometrySlots::FreeReleased; null: the slot is free
	EGeometryState State = EGeometryState::Free;
	EGeometryCompaction Compaction = EGeometryCompaction::None;
	bool bDeformed = false;    ///< waits for a refit
	bool bLost = false;        ///< was recorded in a frame that was never submitted
	bool bRefuted = false;     ///< its opacity classification is no longer valid
	bool bRebuild = false;     ///< the next refit must be a build
	bool bUpdate = false;      ///< the work of this frame is a refit
	bool bReported = false;    ///< the log has said that it does not fit
	bool bChanged = false;     ///< is in the list of changed slots
	bool bCompactable = false; ///< the structure allows compaction
	bool bCoarse = false;      ///< a coarser level takes its place
	uint32_t Slot = 0;
	uint32_t Generation = 0;
	uint32_t Misfits = 0; ///< frames in which only its size kept it from being built
	uint32_t Waits = 0;   ///< frames in which others waited for it
	uint32_t Coarsenings = 0;
	uint32_t RefitsSinceBuild = 0, Builds = 0;
	uint64_t Age = 0; ///< order of creation
	uint64_t QueuedFrame = 0;
	float ScreenSize = 0.0f; ///< heights of the picture, as seen last
	float RefitRatio = 1.0f; ///< see FGeometryStore::SetRefitQuality
	uint64_t Triangles = 0;  ///< in all parts
	FRTBuildSizes Sizes;
	uint64_t CompactedBytes = 0, RefusedRoom = 0;
	TRTRef<IRTGeometry> Compacted;
	TRTRef<IRTBuffer> Staging; ///< a coarser level's indices, to be copied before the build

	/// Binds a new geometry to this entry.
	void Bind(const std::shared_ptr<FRTGeometry>& NewGeometry, uint32_t NewSlot);
	/// Null drops the structure. The GPU may still use the old one: the device frees it after that.
	void SetStructure(TRTRef<IRTGeometry> Structure);
	void SetBuilt(bool bBuilt);
	/// Ends FRTGeometryInfo::bWaitsForData.
	void SetFilled();
	/// Makes the parts follow the sections' opacity classification, or ignore it.
	void SetClassified(bool bClassified);
	/// Null: no coarser level is being made.
	void SetCoarserLevel(std::unique_ptr<FCoarserLevel> Level);
	FCoarserLevel* GetCoarserLevel() const;
	/// Replaces indices and parts by those of the finished coarser level and drops the level. Indices: uint32_t.
	void UseCoarserLevel(TRTRef<IRTBuffer> Indices);
	/// Describes the structure. The result points to Sections.
	FRTGeometryDesc MakeDesc(const std::vector<FRTGeometrySection>& Sections) const;
	/// Asks the device what a build of the current parts needs.
	void UpdateSizes(IRTDevice& Device);
};

} // namespace Lantern
