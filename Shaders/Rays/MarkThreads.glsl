// Marks threads of a work group of RAY_QUEUE_GROUP_SIZE (ThreadList.glsl), whose bits follow one another.
#ifndef LANTERN_MARK_THREADS_GLSL
#define LANTERN_MARK_THREADS_GLSL

#include "ThreadList.glsl"
#define MARK_GROUP_SIZE RAY_QUEUE_GROUP_SIZE
#include "../Library/MarkBits.glsl"

// Called by all threads of the group, once. FirstBit: of the group, which may lie behind all bits of the list. bMarks: whether the thread is marked.
void MarkThreads(FAddress List, uint FirstBit, bool bMarks)
{
	uint Bits, Word = (FirstBit >> 5u) + gl_LocalInvocationIndex;
	if (MarkBits(bMarks, Bits) && Word < FThreadListRef(List).Header.BitWords) { FThreadListRef(List).Words[Word] = Bits; }
}

#endif
