// A list of threads that a later launch runs, so that neighbours in it do the same.
#ifndef LANTERN_THREAD_LIST_TYPES_H
#define LANTERN_THREAD_LIST_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define THREAD_ORDER_GROUP_SIZE 256u // threads of the passes that make lists of marks
#define THREAD_ORDER_BITS 128u       // that each of them takes
#define THREAD_TILE 8u               // edge of the tiles in which threads of a launch are ordered

// A bit for each thread that passes may mark lies behind, and then the numbers of those that were marked, in the order of their bits.
struct FThreadList
{
	uint Groups[3]; // of a compute shader's launch, in rows of RAY_QUEUE_ROW_GROUPS
	uint Launch[3]; // width, height and depth of a ray-tracing pipeline's launch: [0] threads
	uint BitWords;  // a multiple of 4
	uint Pad;
};
LANTERN_ASSERT_SIZE(FThreadList, 32);

struct FThreadOrderConstants
{
	FAddress List;  // FThreadList
	FAddress From;  // FThreadList whose entries the bits stand for; 0: they stand for threads of a launch (BitOfThread)
	uint Width;     // of that launch
	uint GroupSize; // entries that a work group of the later launch takes
};
LANTERN_ASSERT_SIZE(FThreadOrderConstants, 24);

LANTERN_SHARED_END

#endif
