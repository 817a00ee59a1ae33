#ifndef LANTERN_LIGHTING_TYPES_H
#define LANTERN_LIGHTING_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define LIGHTING_GROUP_SIZE 8

struct FLightingConstants
{
	FPassConstants Pass;
	uint Depth, Normals, BaseColor, Material, Emissive; // sampled indices
	uint SunVisibility;                                 // sampled index, or NO_TEXTURE: unshadowed
	uint SkyVisibility;                                 // sampled index, or NO_TEXTURE: unoccluded
	uint IndirectDiffuse, IndirectSpecular;             // sampled indices, or NO_TEXTURE: the sky's ambient light stands in
	uint Output;                                        // storage index
};
LANTERN_ASSERT_SIZE(FLightingConstants, 56);

struct FDebugViewConstants
{
	FPassConstants Pass;
	uint Input;  // sampled index: the signal
	uint Output; // storage index
	uint bRadiance; // 0: shown as it is, grey; 1: exposed and tone-mapped
	uint Pad;
};
LANTERN_ASSERT_SIZE(FDebugViewConstants, 32);

struct FToneMapConstants
{
	FPassConstants Pass;
	uint Input;  // sampled index
	uint Output; // storage index
};
LANTERN_ASSERT_SIZE(FToneMapConstants, 24);

LANTERN_SHARED_END

#endif
