// The plain gather: one loop over all objects. It is the oracle of the tests of FInstanceGather and the baseline of
// `lantern bench gather`; r.RT.Scene.Gather=0 runs it in a scene.
#pragma once

#include "LanternRHI/RTTypes.h"
#include "LanternScene/Instances/Gather.h"

namespace Lantern
{

/// Writes to Out the instances that FInstanceGather writes, in the order of objects, and returns their number. Reads the
/// records of the store and the objects' entries of the GPU table, not the buckets. Out needs room for all objects.
uint32_t GatherStraightforward(const FInstanceStore& Store, const TPagedArray<FObjectData>& Objects, const FCullingRule& Rule,
    const glm::dvec3& Origin, FRTInstance* Out, const FMissingGeometrySink& Missing = {});

} // namespace Lantern
