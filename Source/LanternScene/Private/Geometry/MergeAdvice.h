// Small meshes that would better be one: each costs an acceleration structure, an instance and a box that overlaps its
// neighbours'.
#pragma once

#include <cstdint>
#include <functional>

#include "LanternScene/Scene/Object.h"

namespace Lantern
{

struct FMergeAdvice
{
	/// Fewer triangles than this are small.
	static constexpr uint64_t SmallTriangles = 64;
	uint32_t Objects = 0;   ///< small, static, of one section, each the only one of its geometry, with a material in common
	uint32_t Materials = 0; ///< different ones among them: as many meshes would be left
};

/// ForEach calls what it is given with every object.
FMergeAdvice FindMergeable(const std::function<void(const std::function<void(const FRTObjectInfo&)>&)>& ForEach);

} // namespace Lantern
