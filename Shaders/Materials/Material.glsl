// The material program of a shader: the standard one. Other programs take this file's place (FMaterialPrograms).
#ifndef LANTERN_MATERIAL_GLSL
#define LANTERN_MATERIAL_GLSL

#include "Standard.glsl"

#define MATERIAL_STANDARD_OPACITY

FMaterialSurface EvaluateMaterial(FMaterialData M, FMaterialInputs I, uint Override) { return EvaluateStandard(M, I, Override); }

#endif
