// Makes the FSectionData of a part, as shaders read it, from its geometry and its material.
#pragma once

#include "LanternScene/ShaderTable/SectionTable.h"

namespace Lantern
{

/// Returns the program of Material, and the class of hit group that the part needs of it. The class is masked only if any-hit
/// shaders can run: not for parts that the geometry states as opaque.
FHitProgram ChooseHitProgram(const FSectionContext& Context, const FRTGeometry& Geometry, const FRTGeometryPart& Part, uint32_t Material);
/// Material is that of the part's section.
FSectionData MakeSection(const FSectionContext& Context, const FRTGeometry& Geometry, const FRTGeometryPart& Part, uint32_t Material);

/// Returns whether light shines through the material, or between what it covers.
inline bool LightShinesThrough(const FMaterialData& Material)
{
	if ((Material.Flags & MATERIAL_BLENDED) != 0) { return true; }
	return Material.Transmission > 0.0f && (Material.Metallic < 1.0f || Material.Textures[TEXTURE_METALLIC_ROUGHNESS] != NO_TEXTURE);
}
/// As LightShinesThrough, under the context's override: none has such.
bool IsTransmissive(const FSectionContext& Context, const FMaterialData& Material);

/// Returns whether it is the surface of a volume that scatters light.
bool IsScattering(const FSectionContext& Context, const FMaterialData& Material);

/// Returns whether light sampling may list triangles of a section: those of the finest level of detail, once they are there. Coarser
/// levels count other triangles.
bool MayListEmissive(const FRTGeometry& Geometry, uint32_t Section);

} // namespace Lantern
