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
	/// Marks the list as out of date: an emissive object moved, or its triangles changed.
	void MarkTriangles() { bStale = true; }
	/// Marks the list as out of date: an object or a material began, ceased or changed to emit.
	void MarkObjects() { bStale = bObjectsStale = true; }
	/// Tells whether something was marked since the last Update.
	bool NeedsUpdate() const { return bStale; }
	/// Makes the list anew. It has the triangles of sections with SECTION_LIGHT whose area is not zero, in the order of objects.
	void Update(const FSceneObjects& Objects, const FSceneMaterials& Materials);

	/// Sum of area (m²) × FMaterialData::EmissiveWeight over the list.
	float GetPower() const { return Power; }
	TGpuTable<FEmissiveTriangle>& GetTable() { return Table; }
	const TGpuTable<FEmissiveTriangle>& GetTable() const { return Table; }

private:
	struct FList
	{
		std::vector<FEmissiveTriangle> Triangles;
		std::vector<double> Cumulative; // power up to and including each triangle
		double Power = 0.0;
	};
	void ListObjects(const FSceneObjects& Objects, const FSceneMaterials& Materials);
	static void AddTriangles(uint32_t Object, const FSceneObjects& Objects, const FSceneMaterials& Materials, FList& Out);

	TGpuTable<FEmissiveTriangle> Table{"EmissiveTriangles"};
	std::vector<uint32_t> EmissiveObjects; // ascending
	float Power = 0.0f;
	bool bStale = true, bObjectsStale = true;
};

} // namespace Lantern
