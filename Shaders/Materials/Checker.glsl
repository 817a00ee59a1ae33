// An example of a material program: the standard material with a checkerboard over its first texture coordinates. Every other
// square is darkened; there are two squares a unit.
#ifndef LANTERN_CHECKER_MATERIAL_GLSL
#define LANTERN_CHECKER_MATERIAL_GLSL

#include "Standard.glsl"

#define MATERIAL_STANDARD_OPACITY

FMaterialSurface EvaluateMaterial(FMaterialData Material, FMaterialInputs Inputs, uint Override)
{
	FMaterialSurface Surface = EvaluateStandard(Material, Inputs, Override);
	vec2 Square = floor(2.0 * Inputs.UV0);
	if (Override == 0u && mod(Square.x + Square.y, 2.0) > 0.5) { Surface.BaseColor *= 0.25; }
	return Surface;
}

#endif
