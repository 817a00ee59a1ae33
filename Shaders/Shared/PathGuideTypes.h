// What tiles of pixels remember of the directions from which their paths brought light.
#ifndef LANTERN_PATH_GUIDE_TYPES_H
#define LANTERN_PATH_GUIDE_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define PATH_GUIDE_TILE 16u   // pixels along a tile's side
#define PATH_GUIDE_SIDE 8u    // bins along the side of an octahedral map
#define PATH_GUIDE_BINS 64    // its square
#define PATH_GUIDE_FRAMES 32u // that a tile averages
#define PATH_GUIDE_NO_PATH 0xffffffffu

// Light by direction. A bin holds 16 bits; two share a word. Bins lie in an octahedral map of world directions, row by row.
struct FPathGuideTile
{
	float Scale; // what a bin's unit stands for: radiance · sr
	uint Frames; // that the bins average; 0: nothing is known
	float Paths; // that the bins have learnt from
	uint Pad;
	uint Bins[PATH_GUIDE_BINS / 2];
};
LANTERN_ASSERT_SIZE(FPathGuideTile, 144);

struct FPathGuideConstants
{
	FPassConstants Pass;
	FAddress Previous; // FPathGuideTile[], row by row; 0: there are none
	FAddress Current;  // FPathGuideTile[]
	FAddress Records;  // uint[] of the first launch's threads, row by row: see PackGuideRecord. PATH_GUIDE_NO_PATH: the thread had none
	uint Depth, Normals; // sampled indices
};
LANTERN_ASSERT_SIZE(FPathGuideConstants, 48);

LANTERN_SHARED_END

#endif
