// Constants of the passes for objects of a stylised look, shared by C++ and GLSL.
#ifndef LANTERN_TOON_TYPES_H
#define LANTERN_TOON_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define TOON_GROUP_SIZE 8 // threads in x and y

struct FToonSurfaceConstants
{
	FPassConstants Pass;
	uint Depth, Normals; // sampled indices
	uint Numbers;        // sampled index of FGBuffer::ToonNumbers, or NO_TEXTURE: Motion names the objects
	uint NumbersOffset;  // of the view in Numbers, pixels, 2 × 16 bits
	uint Motion;         // sampled index of FGBuffer::Motion
	uint OutNormals;     // storage index, as FGBuffer::Normals, of what gathers light
	uint OutPixels;      // storage index, RG32_FLOAT. x: FToonData::SphereWeight; y: style + 1, 0: none
	uint Pad;
};
LANTERN_ASSERT_SIZE(FToonSurfaceConstants, 48);

struct FToonGradeConstants
{
	FPassConstants Pass;
	uint Depth, Normals, Pixels; // sampled indices: depth, and what FToonSurfaceConstants has written
	uint bHorizon;               // 1: light from below the surface counts as dark in the signal
	uint bFiltered;              // 1: noise is to go, sharp detail as well
	uint Signal, Output;         // sampled and storage index
	uint Pad;
	FAddress Sum;                // of the reference, in place of Signal and Output: FReferenceConstants::Sum
};
LANTERN_ASSERT_SIZE(FToonGradeConstants, 56);

LANTERN_SHARED_END

#endif
