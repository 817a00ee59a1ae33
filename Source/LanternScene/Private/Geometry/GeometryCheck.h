// Refuses geometry that no acceleration structure can be built from.
#pragma once

#include <cstdint>

#include "LanternScene/Geometry/Geometry.h"

namespace Lantern
{

/// Errors as FGeometryStore::Create. MaxPrimitives: the device's limit, in all sections together.
FRTStatus CheckGeometry(const FRTGeometryInfo& Info, uint64_t MaxPrimitives);

} // namespace Lantern
