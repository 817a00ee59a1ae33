// Numbers of 8 bits that a host has for each pixel: classes, channels, toon numbers.
#ifndef LANTERN_HOST_NUMBERS_GLSL
#define LANTERN_HOST_NUMBERS_GLSL

#include "Bindings.glsl"

// Texture: sampled index, R8_UNORM. Offset: of the view in it, pixels, 2 × 16 bits.
uint LoadHostNumber(uint Texture, uint Offset, ivec2 Pixel)
{
	ivec2 Texel = Pixel + ivec2(Offset & 0xffffu, Offset >> 16u);
	return uint(round(texelFetch(Textures[Texture], Texel, 0).x * 255.0));
}

#endif
