// FindMergeable: counts small meshes that share a material.
#include "Geometry/MergeAdvice.h"

#include <unordered_map>

namespace Lantern
{

FMergeAdvice FindMergeable(const std::function<void(const std::function<void(const FRTObjectInfo&)>&)>& ForEach)
{
	std::unordered_map<const FRTGeometry*, uint32_t> Uses;
	ForEach([&](const FRTObjectInfo& Object) { ++Uses[Object.Geometry.get()]; });
	std::unordered_map<uint32_t, uint32_t> SmallByMaterial;
	ForEach([&](const FRTObjectInfo& Object) {
		const FRTGeometry& Geometry = *Object.Geometry;
		const bool bSingle = Geometry.GetSectionCount() == 1 && Uses[&Geometry] == 1;
		const bool bMerges = !Geometry.GetInfo().bDynamic && !Geometry.GetInfo().Sections[0].bProcedural;
		if (bSingle && bMerges && Geometry.GetPrimitiveCount() < FMergeAdvice::SmallTriangles) { ++SmallByMaterial[Object.Materials[0]]; }
	});
	FMergeAdvice Advice;
	for (const auto& [Material, Count] : SmallByMaterial)
	{
		Advice.Objects += Count > 1 ? Count : 0;
		Advice.Materials += Count > 1 ? 1 : 0;
	}
	return Advice;
}

} // namespace Lantern
