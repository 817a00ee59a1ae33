// Lists the bits of a mask that are set, in their order. Atomic counters would list them in another order each time. Which rays share a warp
// would then differ from run to run, and with it which of two surfaces at one place a driver lets them hit.
#ifndef LANTERN_ORDER_BITS_GLSL
#define LANTERN_ORDER_BITS_GLSL

#include "Bindings.glsl"
#include "../Shared/ThreadListTypes.h"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer FBitsRef { uvec4 Data[]; };

shared uint BitCounts[THREAD_ORDER_GROUP_SIZE];
shared uint BitsBefore;

// Of the includer: THREAD_ORDER_BITS of the mask; writes an entry.
uvec4 LoadBits(uint Index);
void ListBit(uint Place, uint Bit);

uint CountBits(uvec4 Bits)
{
	ivec4 Counts = bitCount(Bits);
	return uint(Counts.x + Counts.y + Counts.z + Counts.w);
}

// Returns a thread's part of the bits in entries below End. All groups together read the mask as often as half their number: 26 MB for
// 2560×1440 bits, and four times that for twice as many. Loads wait for each other where they are in a loop of their own.
uint CountBitsBelow(uint End, uint Lane)
{
	const uint AtOnce = 8u;
	uint Sum = 0u;
	for (uint First = Lane; First < End; First += AtOnce * THREAD_ORDER_GROUP_SIZE)
	{
		uvec4 Bits[AtOnce];
		[[unroll]] for (uint I = 0u; I < AtOnce; ++I) { Bits[I] = LoadBits(min(First + I * THREAD_ORDER_GROUP_SIZE, End - 1u)); }
		[[unroll]] for (uint I = 0u; I < AtOnce; ++I) { Sum += First + I * THREAD_ORDER_GROUP_SIZE < End ? CountBits(Bits[I]) : 0u; }
	}
	return Sum;
}

// Called by all threads of the work group, once. Count: of LoadBits. Returns how many bits are set in this group's and in all before.
uint OrderBits(uint Count, uint Group)
{
	uint Lane = gl_LocalInvocationIndex, First = Group * THREAD_ORDER_GROUP_SIZE;
	if (Lane == 0u) { BitsBefore = 0u; }
	barrier();
	uint Before = CountBitsBelow(min(First, Count), Lane);
	if (Before > 0u) { atomicAdd(BitsBefore, Before); }
	uvec4 Mine = First + Lane < Count ? LoadBits(First + Lane) : uvec4(0u);
	BitCounts[Lane] = CountBits(Mine);
	barrier();
	for (uint Step = 1u; Step < THREAD_ORDER_GROUP_SIZE; Step <<= 1u)
	{
		uint Other = Lane >= Step ? BitCounts[Lane - Step] : 0u;
		barrier();
		BitCounts[Lane] += Other;
		barrier();
	}
	uint Place = BitsBefore + BitCounts[Lane] - CountBits(Mine);
	for (uint Word = 0u; Word < 4u; ++Word)
	{
		for (uint Left = Mine[Word]; Left != 0u; Left &= Left - 1u)
		{
			ListBit(Place++, (First + Lane) * THREAD_ORDER_BITS + Word * 32u + uint(findLSB(Left)));
		}
	}
	return BitsBefore + BitCounts[THREAD_ORDER_GROUP_SIZE - 1u];
}

// Whether the thread alone has what OrderBits returned of all bits.
bool HasWholeCount(uint Count, uint Group)
{
	uint Last = (max(Count, 1u) - 1u) / THREAD_ORDER_GROUP_SIZE;
	return Group == Last && gl_LocalInvocationIndex == 0u;
}

#endif
