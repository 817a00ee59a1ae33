// What a part of an object is, as shaders read it, from its geometry and its material.
#pragma once

#include "LanternScene/ShaderTable/SectionTable.h"

namespace Lantern
{

/// Masked only where any-hit shaders can run: not for what the geometry says is opaque.
ERTHitClass GetHitClass(const FSectionContext& Context, const FRTGeometry& Geometry, const FRTGeometryPart& Part, uint32_t Material);
/// Material: of the part's section.
FSectionData MakeSection(const FSectionContext& Context, const FRTGeometry& Geometry, const FRTGeometryPart& Part, uint32_t Material);

} // namespace Lantern
