// A list of threads that a later launch runs, so that neighbours in it do the same.
#ifndef LANTERN_THREAD_LIST_TYPES_H
#define LANTERN_THREAD_LIST_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

// The numbers of the threads lie behind.
struct FThreadList
{
	uint Groups[3]; // of a compute shader's launch: RAY_QUEUE_GROUP_SIZE threads each, or one entry of ReserveGroups, in rows of RAY_QUEUE_ROW_GROUPS
	uint Launch[3]; // width, height and depth of a ray-tracing pipeline's launch: [0] threads
};
LANTERN_ASSERT_SIZE(FThreadList, 24);

LANTERN_SHARED_END

#endif
