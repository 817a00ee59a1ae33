// The alpha test at a hit, by the material program. A hit is cut away if its opacity is below the material's cutoff.
// The macros MATERIAL_… are documented in MaterialPrograms.h.
#ifndef LANTERN_ALPHA_TEST_GLSL
#define LANTERN_ALPHA_TEST_GLSL

#include "Material.glsl"

#ifndef MATERIAL_HAS_ALPHA_TEST
bool IsHitCutAway(FMaterialRef Materials, FSectionData Section, uint Primitive, vec2 Barycentrics)
{
#ifdef MATERIAL_STANDARD_OPACITY
	return IsStandardHitCutAway(Materials, Section, Primitive, Barycentrics);
#else
	FMaterialData Material = Materials.Data[Section.Material];
	return EvaluateMaterial(Material, FetchMaterialInputs(Section, Primitive, Barycentrics), 0u).Opacity < Material.AlphaCutoff;
#endif
}
#endif

#endif
