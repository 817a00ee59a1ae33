// Measures how good a refitted acceleration structure still is, from the deformed triangles alone.
//
// A refit keeps the tree and moves its boxes, so that "the quality of such a refitted tree can degrade rapidly" (Kopta et al.,
// "Fast, Effective BVH Updates for Animated Scenes", I3D 2012). Rebuilding a tree that has degraded beats rebuilding at fixed
// times. Lauterbach et al. ("RT-DEFORM: Interactive Ray Tracing of Dynamic Scenes using BVHs", 2006) compare surface areas of
// parents and children for that.
//
// Rays visit a box in proportion to its surface (surface area heuristic). The driver's boxes cannot be read. But leaves hold
// neighbouring triangles, and neighbours follow each other in index buffers. The measure therefore sums the surface of the boxes
// around each 32 consecutive triangles, after skinning.
//
// The sum is divided by the area of the triangles, because a rebuild does not help a figure that merely grows. It is also divided
// by its value at the last build, so that meshes in any order can be compared. It does not see parts that touched when the tree
// was built, are no neighbours in the index buffer, and have come apart since. r.RT.Skinning.RebuildInterval is there for those.
//
// The sums come back two frames later (TReadbackRing); nothing waits for them.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "Feedback/ReadbackRing.h"
#include "LanternRenderer/Renderer.h"
#include "LanternScene/Geometry/GeometryStore.h"
#include "RefitQualityTypes.h"

namespace Lantern
{

class FRefitQuality
{
public:
	/// Geometries measured in a frame, in turn: hundreds of characters must not cost hundreds of dispatches more.
	static constexpr size_t PerFrame = 16;

	explicit FRefitQuality(IRTDevice& InDevice) : Ring(InDevice, "RefitQuality", ERTBufferUsage::Storage) {}
	/// FlightIndex: as in TReadbackRing::BeginFrame. Tells the store what the frame FramesInFlight before measured. If that frame
	/// was of another scene, its results wait for the next frame of that scene.
	void BeginFrame(uint32_t FlightIndex, FGeometryStore& Store);
	/// What is to be dispatched behind the skinning of Items in this frame, and the buffer for its results. Empty if the store
	/// wants nothing measured, or if there is no memory for results.
	struct FWork
	{
		std::vector<FRefitQualityConstants> Dispatches;
		TRTRef<IRTBuffer> Results;
	};
	FWork Prepare(FGeometryStore& Store, const std::vector<FSkinningInputs>& Items);
	/// bSubmitted: false if the frame never runs.
	void EndFrame(const FGeometryStore& Store, bool bSubmitted);

	static uint32_t CountGroups(uint32_t Triangles);
	/// Returns the surface of boxes over the area of triangles, summed over one geometry; 0: it has no area.
	static float ComputeLooseness(const FRefitQualitySum* Sums, uint32_t Count);

private:
	struct FItem
	{
		std::weak_ptr<FRTGeometry> Geometry;
		uint32_t Slot = 0, Builds = 0;
		uint32_t First = 0, Count = 0; // sums
	};
	using FRing = TReadbackRing<std::vector<FItem>>;
	/// The looseness of a geometry after one of its builds.
	struct FMeasure
	{
		std::weak_ptr<FRTGeometry> Geometry;
		uint32_t Builds = 0; // 0: none
		float Looseness = 0.0f;
	};
	/// Returns false if the geometry is another store's.
	bool Deliver(FGeometryStore& Store, const FMeasure& Measure);
	void DropExpired();

	FRing Ring;
	std::unordered_map<const FRTGeometry*, FMeasure> Baselines; // some may have expired
	std::vector<FMeasure> Waiting;                              // for a frame of their scene
	size_t MostBaselines = 64;                                  // before expired ones go
	size_t Next = 0;
};

} // namespace Lantern
