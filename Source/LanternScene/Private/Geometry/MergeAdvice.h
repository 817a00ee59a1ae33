// Advice to merge small meshes. Each of them costs an acceleration structure, an instance and a box that overlaps those of its
// neighbours.
#pragma once

#include <cstdint>
#include <functional>

#include "LanternScene/Scene/Object.h"

namespace Lantern
{

struct FMergeAdvice
{
	/// A mesh with fewer triangles than this is small.
	static constexpr uint64_t SmallTriangles = 64;
	/// Objects that are small and static, have one section, are the only one of their geometry and share a material with
	/// another such object.
	uint32_t Objects = 0;
	/// Different materials among them: this many meshes would be left.
	uint32_t Materials = 0;
};

/// ForEach calls the function that it is given with every object. It is called twice.
FMergeAdvice FindMergeable(const std::function<void(const std::function<void(const FRTObjectInfo&)>&)>& ForEach);

} // namespace Lantern
