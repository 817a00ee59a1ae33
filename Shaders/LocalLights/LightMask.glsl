// How a host's lighting reads the light mask (FRTModuleLightMask). It includes nothing, so that an engine's shaders may include it.
#ifndef LANTERN_LIGHT_MASK_GLSL
#define LANTERN_LIGHT_MASK_GLSL

// How the includer declares textures: usampler2D, or utexture2D with GL_EXT_samplerless_texture_functions.
#ifndef LIGHT_MASK_TEXTURE
#define LIGHT_MASK_TEXTURE usampler2D
#endif

const uint LightMaskSlots = 8u; // of a tile; also the slot of a light that has none

// Returns how much of a slot's light is seen, 0 to 1. Mask: the pixel's texel of Visibility. Slot: 0 to LightMaskSlots, which sees nothing.
float LightMaskVisibility(uint Mask, uint Slot) { return Slot < LightMaskSlots ? float((Mask >> (4u * Slot)) & 15u) / 15.0 : 0.0; }

// Returns where Lights names the light of a slot. Pixel: of the view.
ivec2 LightMaskTexel(ivec2 Pixel, uint Slot) { return ivec2((Pixel.x & ~7) + int(Slot), Pixel.y >> 3); }

// Returns a light's slot at a pixel; LightMaskSlots: it is not in the mask there. Number: GetLightNumber of its handle.
uint FindLightMaskSlot(LIGHT_MASK_TEXTURE Lights, ivec2 Pixel, uint Number)
{
	uint Slot = 0u;
	while (Slot < LightMaskSlots && texelFetch(Lights, LightMaskTexel(Pixel, Slot), 0).x != Number) { ++Slot; }
	return Slot;
}

// Returns by what a host multiplies its own light of a lamp. What is not in the mask is in the signals of local lights.
float SampleLightMask(LIGHT_MASK_TEXTURE Visibility, LIGHT_MASK_TEXTURE Lights, ivec2 Pixel, uint Number)
{
	return LightMaskVisibility(texelFetch(Visibility, Pixel, 0).x, FindLightMaskSlot(Lights, Pixel, Number));
}

#endif
