// The alpha test at a hit, as the material program has it.
#ifndef LANTERN_ALPHA_TEST_GLSL
#define LANTERN_ALPHA_TEST_GLSL

#include "Material.glsl"

#ifndef MATERIAL_HAS_ALPHA_TEST
bool IsHitCutAway(FMaterialRef Materials, FSectionData Section, uint Primitive, vec2 Barycentrics)
{
#ifdef MATERIAL_STANDARD_OPACITY
	return IsStandardHitCutAway(Materials, Section, Primitive, Barycentrics);
#else
	FMaterialData M = Materials.Data[Section.Material];
	return EvaluateMaterial(M, FetchInputs(Section, Primitive, Barycentrics), 0u).Opacity < M.AlphaCutoff;
#endif
}
#endif

#endif
