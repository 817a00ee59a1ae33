// Constants of the composite's fog, shared by C++ and GLSL.
#ifndef LANTERN_HEIGHT_FOG_TYPES_H
#define LANTERN_HEIGHT_FOG_TYPES_H

#include "FogTypes.h"

LANTERN_SHARED_BEGIN

#define HEIGHT_FOG_GROUP_SIZE 8 // threads in x and y

struct FHeightFogConstants
{
	FPassConstants Pass;
	FFogGrid Grid;
	uint Visibility; // sampled index, or NO_TEXTURE: the sun is unshadowed
	uint Light;      // sampled index, or NO_TEXTURE: no local light
	uint Depth, Lighting; // sampled indices
	uint SkyLight;        // sampled index, see SkyAmbient in SkyLight.glsl
	uint Output;          // storage index
	float Density;        // extinction at BaseHeight, 1/m
	float Falloff;        // 1/m
	float BaseHeight;     // relative to the scene's origin, metres
	float Albedo;
	float Phase; // g of Henyey and Greenstein
	float Sky;   // share of the sky's light, where Volume does not say what arrives
	FFogGrid VolumeGrid;                 // of indirect light in the air
	uint VolumeLight, VolumeMoment;      // sampled indices; the first NO_TEXTURE: there is none
};
LANTERN_ASSERT_SIZE(FHeightFogConstants, 120);

LANTERN_SHARED_END

#endif
