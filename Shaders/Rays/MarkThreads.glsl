// Marks threads of a work group of RAY_QUEUE_GROUP_SIZE (ThreadList.glsl), whose bits follow one another, without an atomic operation on memory.
#ifndef LANTERN_MARK_THREADS_GLSL
#define LANTERN_MARK_THREADS_GLSL

#include "ThreadList.glsl"

const uint MarkedWords = uint(RAY_QUEUE_GROUP_SIZE) / 32u;

shared uint Marked[MarkedWords];

// Called by all threads of the group, once. FirstBit: of the group, which may lie behind all bits of the list. bMarks: whether the thread is marked.
void MarkThreads(FAddress List, uint FirstBit, bool bMarks)
{
	uint Lane = gl_LocalInvocationIndex;
	if (Lane < MarkedWords) { Marked[Lane] = 0u; }
	barrier();
	if (bMarks) { atomicOr(Marked[Lane >> 5u], 1u << (Lane & 31u)); }
	barrier();
	uint Word = (FirstBit >> 5u) + Lane;
	if (Lane < MarkedWords && Word < FThreadListRef(List).Header.BitWords) { FThreadListRef(List).Words[Word] = Marked[Lane]; }
}

#endif
