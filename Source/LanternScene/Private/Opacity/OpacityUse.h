// Decides which geometries may use the classification of their triangles. Alpha tests must be on, and all objects of the
// geometry must have the alpha test that it was classified for. A geometry that was once used with another test is never
// trusted again: its texture may have changed behind the same index.
#pragma once

#include "LanternScene/Geometry/GeometryStore.h"
#include "LanternScene/ShaderTable/SectionTable.h"

namespace Lantern
{

/// Tells whether all classified sections have the alpha test of their classification. Materials has one entry a section.
bool HasClassifiedMaterials(const FSectionContext& Context, const FRTGeometry& Geometry, const std::vector<uint32_t>& Materials);

/// Tells whether UpdateOpacityUse would change anything.
bool NeedsOpacityUpdate(const FSectionContext& Context, const FSectionTable& Sections, const FGeometryStore& Store);
/// Tells Store what may be used. Called at frame start, before FGeometryStore::BeginFrame, on the render thread.
void UpdateOpacityUse(const FSectionContext& Context, FSectionTable& Sections, FGeometryStore& Store);

} // namespace Lantern
