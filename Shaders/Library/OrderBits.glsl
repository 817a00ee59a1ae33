// Lists the bits of a mask that are set, in their order. Atomic counters would list them in another order each time. Which rays share a warp
// would then differ from run to run, and with it which of two surfaces at one place a driver lets them hit.
#ifndef LANTERN_ORDER_BITS_GLSL
#define LANTERN_ORDER_BITS_GLSL

#include "Bindings.glsl"
#include "../Shared/ThreadListTypes.h"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer FBitsRef { uvec4 Data[]; };

shared uint BitCounts[THREAD_ORDER_GROUP_SIZE];
shared uint BitsBefore;

void ListBit(uint Place, uint Bit); // of the includer: writes an entry

uint CountBits(uvec4 Bits)
{
	ivec4 Counts = bitCount(Bits);
	return uint(Counts.x + Counts.y + Counts.z + Counts.w);
}

// Called by all threads of the work group, once. Bits: THREAD_ORDER_BITS in each of Count entries. Returns how many are set in this group's
// entries and in all before.
uint OrderBits(FAddress Bits, uint Count, uint Group)
{
	uint Lane = gl_LocalInvocationIndex, First = Group * THREAD_ORDER_GROUP_SIZE;
	if (Lane == 0u) { BitsBefore = 0u; }
	barrier();
	uint Before = 0u;
	for (uint I = Lane; I < min(First, Count); I += THREAD_ORDER_GROUP_SIZE) { Before += CountBits(FBitsRef(Bits).Data[I]); }
	if (Before > 0u) { atomicAdd(BitsBefore, Before); }
	uvec4 Mine = First + Lane < Count ? FBitsRef(Bits).Data[First + Lane] : uvec4(0u);
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

#endif
