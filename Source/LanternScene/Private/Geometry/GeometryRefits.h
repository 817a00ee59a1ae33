// Deformed geometries: which are refitted in a frame and which are rebuilt instead.
#pragma once

#include <cstdint>
#include <vector>

#include "Geometry/GeometryContext.h"

namespace Lantern
{

/// Threads: render thread.
class FGeometryRefits
{
public:
	explicit FGeometryRefits(FGeometryContext& Context);

	static bool IsQualityWanted(); ///< r.RT.Skinning.RebuildQuality is on
	/// The entry's vertices are new. Adding it twice in a frame changes nothing.
	void Add(FGeometryEntry& Entry);
	bool IsEmpty() const { return Deformed.empty(); }
	/// Appends to OutWork all that was added and is built, and sets bUpdate of each: false for rebuilds.
	/// Rebuilds are due after r.RT.Skinning.RebuildInterval frames, or if boxes are looser than
	/// r.RT.Skinning.RebuildQuality. A frame makes at most 1/RebuildInterval of the dynamic geometries anew, the worst
	/// first. Rebuilds of a lost frame ignore that limit. Makes the scratch buffer hold each refit and rebuild alone.
	/// On error OutWork is complete too.
	FRTStatus Choose(std::vector<FGeometryEntry*>& OutWork);

private:
	void ChooseRebuilds(std::vector<FGeometryEntry*>& Due, uint32_t Interval, uint64_t& ScratchBytes);

	FGeometryContext& Context;
	std::vector<FGeometrySlotRef> Deformed;
};

} // namespace Lantern
