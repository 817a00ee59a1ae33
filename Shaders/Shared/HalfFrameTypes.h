// Constants of the passes before and behind signals of the half frame.
#ifndef LANTERN_HALF_FRAME_TYPES_H
#define LANTERN_HALF_FRAME_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define HALF_FRAME_GROUP_SIZE 8
#define HALF_FRAME_NUMBERS 3 // textures of a host's numbers: classes, channels, toon styles

// Indices of the G-buffer's textures; NO_TEXTURE: there is none.
struct FHalfTextures
{
	uint Depth, Normals, BaseColor, Material, BackAlbedo, Motion;
	uint Numbers[HALF_FRAME_NUMBERS];
};
LANTERN_ASSERT_SIZE(FHalfTextures, 36);

struct FHalfReduceConstants
{
	FPassConstants Pass; // of the whole frame
	FHalfTextures From;  // sampled indices
	FHalfTextures To;    // storage indices
	uint NumbersOffset;  // of the view in From.Numbers, pixels: x | y << 16
	uint Pad;
};
LANTERN_ASSERT_SIZE(FHalfReduceConstants, 96);

struct FHalfUpsampleConstants
{
	FPassConstants Pass; // of the whole frame
	uint Depth, Normals; // sampled indices, of the whole frame
	uint Inputs[2];      // sampled indices; NO_TEXTURE: there is none
	uint Outputs[2];     // storage indices
};
LANTERN_ASSERT_SIZE(FHalfUpsampleConstants, 40);

LANTERN_SHARED_END

#endif
