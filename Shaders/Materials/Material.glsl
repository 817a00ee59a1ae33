// The material program of a shader. This is the standard one; other programs replace this file (FMaterialPrograms).
#ifndef LANTERN_MATERIAL_GLSL
#define LANTERN_MATERIAL_GLSL

#include "Standard.glsl"

#define MATERIAL_STANDARD_OPACITY

FMaterialSurface EvaluateMaterial(FMaterialData Material, FMaterialInputs Inputs, uint Override)
{
	return EvaluateStandard(Material, Inputs, Override);
}

#endif
