// Adds threads of a work group to a list (ThreadList.glsl), with one atomic operation for all of them.
#ifndef LANTERN_APPEND_THREADS_GLSL
#define LANTERN_APPEND_THREADS_GLSL

#include "ThreadList.glsl"

shared uint AppendedCount, FirstAppended;

// Called by all threads of the group, once. bAdds: whether Thread is added.
void AppendThread(FAddress List, bool bAdds, uint Thread)
{
	if (gl_LocalInvocationIndex == 0u) { AppendedCount = 0u; }
	barrier();
	uint Place = bAdds ? atomicAdd(AppendedCount, 1u) : 0u;
	barrier();
	if (gl_LocalInvocationIndex == 0u && AppendedCount > 0u) { FirstAppended = ReserveThreads(List, AppendedCount); }
	barrier();
	if (bAdds) { FThreadListRef(List).Threads[FirstAppended + Place] = Thread; }
}

#endif
