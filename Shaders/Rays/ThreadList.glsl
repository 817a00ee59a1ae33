// Lists of threads: passes note who goes on, and a later launch has a thread for each (FThreadList).
#ifndef LANTERN_THREAD_LIST_GLSL
#define LANTERN_THREAD_LIST_GLSL

#include "../Library/Bindings.glsl"
#include "../Shared/RayQueueTypes.h"
#include "../Shared/ThreadListTypes.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FThreadListRef
{
	FThreadList Header;
	uint Threads[];
};

// Returns the place of the first of Count entries, at least one, which the caller then writes to Threads. GroupSize: entries that a work
// group takes.
uint ReservePlaces(FAddress List, uint Count, uint GroupSize)
{
	uint Row = GroupSize * RAY_QUEUE_ROW_GROUPS;
	uint First = atomicAdd(FThreadListRef(List).Header.Launch[0], Count);
	uint Rows = (First + Count + Row - 1u) / Row - (First + Row - 1u) / Row;
	if (Rows > 0u) { atomicAdd(FThreadListRef(List).Header.Groups[1], Rows); }
	return First;
}
uint ReserveThreads(FAddress List, uint Count) { return ReservePlaces(List, Count, RAY_QUEUE_GROUP_SIZE); }
// As ReserveThreads, where each entry has a work group of its own.
uint ReserveGroups(FAddress List, uint Count) { return ReservePlaces(List, Count, 1u); }

// Number: of the launch's thread. OutThread: the one that it runs. Launches may be larger than their list.
bool FindThread(FAddress List, uint Number, out uint OutThread)
{
	OutThread = 0u;
	if (Number >= FThreadListRef(List).Header.Launch[0]) { return false; }
	OutThread = FThreadListRef(List).Threads[Number];
	return true;
}

#endif
