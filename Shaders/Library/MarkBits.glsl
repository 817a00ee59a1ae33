// Makes a mask of the threads of a work group without an atomic operation on memory. OrderBits.glsl lists what is set in such masks.
// MARK_GROUP_SIZE: threads of the group, a multiple of 32.
#ifndef LANTERN_MARK_BITS_GLSL
#define LANTERN_MARK_BITS_GLSL

const uint MarkedWords = uint(MARK_GROUP_SIZE) / 32u;

shared uint Marked[MarkedWords];

// Called by all threads of the group, once. Returns whether the thread has one of the mask's words to write, by its number in the group: OutWord.
bool MarkBits(bool bMarks, out uint OutWord)
{
	uint Lane = gl_LocalInvocationIndex;
	if (Lane < MarkedWords) { Marked[Lane] = 0u; }
	barrier();
	if (bMarks) { atomicOr(Marked[Lane >> 5u], 1u << (Lane & 31u)); }
	barrier();
	OutWord = Lane < MarkedWords ? Marked[Lane] : 0u;
	return Lane < MarkedWords;
}

#endif
