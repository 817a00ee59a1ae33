// FEmissiveTriangles knows which triangles of a scene emit, for light sampling. Where they lie and how much each shines is found on the
// GPU (EmissiveTriangles.comp), from the vertices that rays meet. The CPU keeps what follows from objects and sections alone.
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "LanternScene/Memory/GpuTable.h"
#include "LightTypes.h"
#include "SceneTypes.h"

namespace Lantern
{

class FSceneMaterials;
class FSceneObjects;

/// What EmissiveTriangles.comp has to do in a frame. Buffers are null where there is nothing.
struct FEmissiveWork
{
	IRTBuffer* Triangles = nullptr;
	IRTBuffer* Powers = nullptr;
	IRTBuffer* Bounds = nullptr;
	const std::vector<uint32_t>* Clusters = nullptr; ///< those to do, ascending; empty: all
	uint32_t Count = 0;                              ///< number of clusters to do
};

/// Threads: one at a time.
class FEmissiveTriangles
{
public:
	/// Marks the lists as out of date: geometry of emissive objects changed.
	void MarkLists() { bStale = true; }
	/// Marks the triangles of an emissive object: it moved. Costs follow its clusters.
	void MarkMoved(uint32_t Object) { Mark(Objects, Object); }
	/// Marks the triangles of an emissive object: its vertices are others.
	void MarkDeformed(uint32_t Object);
	/// Notes an object that came, or has other materials, one for each section.
	void SetObject(uint32_t Object, const std::vector<uint32_t>& OfSections);
	void RemoveObject(uint32_t Object);
	/// Notes a new material, which may have the index of one that is gone.
	void AddMaterial(uint32_t Material, bool bEmits);
	/// Notes that a material shines otherwise than before. What has ceased to emit stays listed, without power: a sign that blinks costs
	/// its own clusters. bUsed: objects have the material.
	void ChangeMaterial(uint32_t Material, bool bEmits, bool bUsed);
	/// Returns whether objects are listed, or may be.
	bool HasObjects() const { return bObjectsStale || !EmissiveObjects.empty(); }
	/// Tells whether something was marked since the last Update, or the GPU has not done what it found.
	bool NeedsUpdate() const { return bStale || !Objects.empty() || !Materials.empty() || bAllWanted || !Wanted.empty(); }
	/// Brings the lists up to date. They have the triangles of sections whose material emits or did, in the order of objects, up to
	/// r.RT.Lights.EmissiveTriangles. A light's number has no room for more than MostTriangles.
	FRTStatus Update(IRTDevice& Device, const FSceneObjects& InObjects, const FSceneMaterials& InMaterials);
	static constexpr uint32_t MostTriangles = 1u << (LIGHT_INDEX_BITS - 1);

	FEmissiveWork GetWork() const;
	/// Counts the updates that found something to do: whoever has seen the count knows of the rest.
	uint64_t GetChangeCount() const { return ChangeCount; }
	/// bSubmitted: the GPU does what GetWork returned.
	void EndFrame(bool bSubmitted);

	/// Returns whether shaders may read the lists in this frame: they are up to date, and the GPU has done or does what they need. Lists
	/// that are not may lead to sections and vertices that are gone.
	bool IsUsable() const { return !bStale && (bGiven || !bAllWanted); }
	/// Triangles on the lists. Slots of FEmissiveTriangle[] stay whose they are until lists are made anew.
	uint32_t GetTriangleCount() const { return TriangleCount; }
	/// Names nothing while IsUsable is false.
	void FillConstants(FSceneConstants& Out) const;
	/// Groups of consecutive triangles, in their order. Each is of one object.
	TGpuTable<FEmissiveCluster>& GetClusters() { return Clusters; }
	const TGpuTable<FEmissiveCluster>& GetClusters() const { return Clusters; }
	/// One for each section that emits, and an empty one behind them.
	TGpuTable<FEmissiveRange>& GetRanges() { return Ranges; }
	const TGpuTable<FEmissiveRange>& GetRanges() const { return Ranges; }

private:
	/// An object's place in the lists.
	struct FSource
	{
		uint32_t Object = 0;
		uint32_t FirstRange = 0;
		uint32_t First = 0, Count = 0; // triangles
		uint32_t FirstCluster = 0, ClusterCount = 0;
	};
	void Mark(std::vector<uint32_t>& List, uint32_t Index);
	bool HasEmitted(uint32_t Material) const { return Material < Emitted.size() && Emitted[Material]; }
	bool HasEmitter(const std::vector<uint32_t>& OfSections) const;
	void ListObjects(const FSceneObjects& InObjects);
	void ListRanges(const FSceneObjects& InObjects, const FSceneMaterials& InMaterials);
	void ListClusters(const FSceneObjects& InObjects);
	void WantMarked();
	void WantClusters(const FSource& Source);
	FRTStatus Reserve(IRTDevice& Device);

	TGpuTable<FEmissiveCluster> Clusters{"EmissiveClusters"};
	TGpuTable<FEmissiveRange> Ranges{"EmissiveRanges"};
	TRTRef<IRTBuffer> Triangles, Powers, Bounds;
	std::vector<bool> Emitted;                        // by material: it emits, or did
	std::set<uint32_t> EmissiveObjects;               // with such a material
	std::vector<FSource> Sources;                     // as listed, ascending
	std::vector<std::pair<uint32_t, uint32_t>> Users; // materials and the sources that have them, ascending
	std::vector<uint32_t> Objects, Materials;         // marked
	std::vector<uint32_t> Wanted;                     // clusters that the GPU has to do
	uint32_t TriangleCount = 0;
	uint64_t ChangeCount = 0;
	bool bAllWanted = false;
	bool bStale = true, bObjectsStale = true;
	bool bGiven = false; // GetWork is about this frame
};

} // namespace Lantern
