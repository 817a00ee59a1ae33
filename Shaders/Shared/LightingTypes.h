// Constants of direct lighting, shared by C++ and GLSL.
#ifndef LANTERN_LIGHTING_TYPES_H
#define LANTERN_LIGHTING_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define LIGHTING_GROUP_SIZE 8 // threads in x and y

struct FLightingConstants
{
	FPassConstants Pass;
	uint Depth, Normals, BaseColor, Material, Emissive; // sampled indices
	uint SunVisibility;                                 // sampled index, or NO_TEXTURE: unshadowed
	uint SkyVisibility;                                 // sampled index, or NO_TEXTURE: unoccluded
	uint IndirectDiffuse, IndirectSpecular;             // sampled indices, or NO_TEXTURE: the sky's ambient light stands in
	uint Output;                                        // storage index
	float Surroundings; // share of light that they reflect, where they stand in for indirect light
	uint SkyLight;      // sampled index, see SkyAmbient in SkyLight.glsl
	uint LightsDiffuse, LightsSpecular; // sampled indices, or NO_TEXTURE: local lights are unshadowed
	uint Channels;      // HAS_LIGHT_CHANNELS only: see LoadPixelChannels
	uint ToonNormals, ToonPixels; // HAS_TOON only: sampled indices of what ToonSurface.comp writes, or NO_TEXTURE
	uint IndirectRough; // sampled index, or NO_TEXTURE: where no reflection is traced, sky and diffuse light stand in
	uint BackAlbedo;    // sampled index, or NO_TEXTURE
	uint Pad;
};
LANTERN_ASSERT_SIZE(FLightingConstants, 96);

LANTERN_SHARED_END

#endif
