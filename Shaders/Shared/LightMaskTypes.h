// The light mask, shared by C++ and GLSL.
#ifndef LANTERN_LIGHT_MASK_TYPES_H
#define LANTERN_LIGHT_MASK_TYPES_H

#include "LocalLightTypes.h"

LANTERN_SHARED_BEGIN

#define LIGHT_MASK_FRAMES_MOST 15u // frames that a slot counts, in 4 bits; one that has counted to it is worth its time constant

// Constants of LocalLights/Mask.comp. Inputs are sampled indices, outputs are storage indices.
struct FLightMaskConstants
{
	FPassConstants Pass;
	FAddress TileLights; // FTileLights[]
	FAddress Answers;    // uint[pixels]
	uint Depth, Normals;
	uint OutMask;   // R32_UINT: 8 × 4 bits, slot 0 in the lowest
	uint OutLights; // R32_UINT: FLightData::Number by tile and slot
	// MASK_HISTORY only:
	FAddress Casters; // FMovedCaster[CasterCount]: those that moved in the last frames
	uint CasterCount;
	uint bChangesKnown; // 1: shadows have changed only where theirs fall, and on surfaces that move. 0: they may have anywhere
	uint Surface;       // NO_TEXTURE: the frame stands alone
	uint Motion, Reprojection, PreviousLights, PreviousMeans, PreviousCounts; // NO_TEXTURE, all five: nothing to reproject
	uint OutMeans;  // RG32_UINT: 8 × 8 bits
	uint OutCounts; // R32_UINT: frames that a mean is worth, 8 × 4 bits
	float MinAlpha; // least weight of a new frame, 0 to 1
	uint Pad;
};
LANTERN_ASSERT_SIZE(FLightMaskConstants, 104);

LANTERN_SHARED_END

#endif
