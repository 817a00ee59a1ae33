// FEmissiveTriangles lists the triangles of a scene that emit, for light sampling. Each has the share of the scene's
// power up to and including it, so that a binary search picks triangles in proportion to their power.
#pragma once

#include <cstdint>
#include <vector>

#include "LanternScene/Memory/GpuTable.h"
#include "SceneTypes.h"

namespace Lantern
{

class FSceneMaterials;
class FSceneObjects;

/// Threads: one at a time.
class FEmissiveTriangles
{
public:
	/// Marks the list as out of date: triangles of emissive objects changed.
	void MarkTriangles() { bStale = true; }
	/// Marks the triangles of an emissive object as out of date: it moved. The cost follows the object if its areas stay.
	void MarkMoved(uint32_t Object);
	/// Marks the list as out of date: an object or a material began, ceased or changed to emit.
	void MarkObjects() { bStale = bObjectsStale = true; }
	/// Tells whether something was marked since the last Update.
	bool NeedsUpdate() const { return bStale || !Moved.empty(); }
	/// Brings the list up to date. It has the triangles of sections with SECTION_LIGHT whose area is not zero, in the order of objects.
	void Update(const FSceneObjects& Objects, const FSceneMaterials& Materials);

	/// Sum of area (m²) × FMaterialData::EmissiveWeight over the list.
	float GetPower() const { return Power; }
	/// Triangles that the last Update computed.
	uint32_t GetVisited() const { return Visited; }
	TGpuTable<FEmissiveTriangle>& GetTable() { return Table; }
	const TGpuTable<FEmissiveTriangle>& GetTable() const { return Table; }
	/// Groups of consecutive triangles, in their order. Each is of one object.
	TGpuTable<FEmissiveCluster>& GetClusters() { return Clusters; }
	const TGpuTable<FEmissiveCluster>& GetClusters() const { return Clusters; }

private:
	struct FList
	{
		std::vector<FEmissiveTriangle> Triangles;
		std::vector<double> Cumulative; // power up to and including each triangle
		double Power = 0.0;
	};
	/// An object's triangles in the list.
	struct FSource
	{
		uint32_t Object = 0, First = 0, Count = 0;
		double Power = 0.0;
	};
	/// False: the list must be made anew.
	bool UpdateMoved(const FSceneObjects& Objects, const FSceneMaterials& Materials);
	void ListObjects(const FSceneObjects& Objects, const FSceneMaterials& Materials);
	void MakeClusters(FList& InOut);
	static uint32_t FindClusterEnd(const FList& List, uint32_t First, const FSource& Source, uint32_t Size);
	static void AddTriangles(uint32_t Object, const FSceneObjects& Objects, const FSceneMaterials& Materials, FList& Out);

	TGpuTable<FEmissiveTriangle> Table{"EmissiveTriangles"};
	TGpuTable<FEmissiveCluster> Clusters{"EmissiveClusters"};
	std::vector<uint32_t> EmissiveObjects; // ascending
	std::vector<FSource> Sources;          // as listed, ascending
	std::vector<uint32_t> Moved;
	uint32_t Visited = 0;
	float Power = 0.0f;
	bool bStale = true, bObjectsStale = true;
};

} // namespace Lantern
