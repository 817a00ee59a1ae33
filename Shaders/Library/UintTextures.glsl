// The bindless textures whose texels are unsigned integers.
#ifndef LANTERN_UINT_TEXTURES_GLSL
#define LANTERN_UINT_TEXTURES_GLSL

#include "Bindings.glsl"

layout(set = 0, binding = 0) uniform utexture2D UintTextures[];
layout(set = 0, binding = 1) uniform writeonly uimage2D UintImages[];

#endif
