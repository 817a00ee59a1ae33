// An example of a material program: the standard material, darkened in every other square of a grid over its first
// texture coordinates, two squares a unit.
#ifndef LANTERN_CHECKER_MATERIAL_GLSL
#define LANTERN_CHECKER_MATERIAL_GLSL

#include "Standard.glsl"

#define MATERIAL_STANDARD_OPACITY

FMaterialSurface EvaluateMaterial(FMaterialData M, FMaterialInputs I, uint Override)
{
	FMaterialSurface S = EvaluateStandard(M, I, Override);
	vec2 Square = floor(2.0 * I.UV0);
	if (Override == 0u && mod(Square.x + Square.y, 2.0) > 0.5) { S.BaseColor *= 0.25; }
	return S;
}

#endif
