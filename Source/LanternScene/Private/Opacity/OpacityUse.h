// Which geometries may use the classification of their triangles: those all of whose objects test alpha as it was when
// they were classified, while alpha tests run at all. What was once used with another test is never trusted again: its
// texture may have changed behind the same index.
#pragma once

#include "LanternScene/Geometry/GeometryStore.h"
#include "LanternScene/ShaderTable/SectionTable.h"

namespace Lantern
{

/// Whether every classified section of the geometry has the alpha test that it was classified for. Materials: per section.
bool HasClassifiedMaterials(const FSectionContext& Context, const FRTGeometry& Geometry, const std::vector<uint32_t>& Materials);

/// Whether UpdateOpacityUse would change anything.
bool NeedsOpacityUpdate(const FSectionContext& Context, const FSectionTable& Sections, const FGeometryStore& Store);
/// Frame start, before FGeometryStore::BeginFrame. Render thread.
void UpdateOpacityUse(const FSectionContext& Context, FSectionTable& Sections, FGeometryStore& Store);

} // namespace Lantern
