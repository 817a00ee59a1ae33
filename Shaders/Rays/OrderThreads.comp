// Lists the threads that have been marked, and says how large the launch of the list is.
#version 460
#include "../Library/OrderBits.glsl"
#include "ThreadList.glsl"

layout(local_size_x = THREAD_ORDER_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FThreadOrderConstants Push; };

uint EntryOf(uint Bit)
{
	uint Thread;
	if (Push.From != FAddress(0)) { return FindThread(Push.From, Bit, Thread) ? Thread : 0u; }
	uvec2 Place = ThreadOfBit(Bit, Push.Width);
	return Place.y * Push.Width + Place.x;
}

const FAddress HeaderBytes = FAddress(32);

uvec4 LoadBits(uint Index) { return FBitsRef(Push.List + HeaderBytes).Data[Index]; }
void ListBit(uint Place, uint Bit) { FThreadListRef(Push.List).Words[FThreadListRef(Push.List).Header.BitWords + Place] = EntryOf(Bit); }

void main()
{
	uint Count = FThreadListRef(Push.List).Header.BitWords / 4u, Sum = OrderBits(Count, gl_WorkGroupID.x);
	if (!HasWholeCount(Count, gl_WorkGroupID.x)) { return; }
	uint Row = Push.GroupSize * uint(RAY_QUEUE_ROW_GROUPS);
	FThreadListRef(Push.List).Header.Groups[1] = (Sum + Row - 1u) / Row;
	FThreadListRef(Push.List).Header.Launch[0] = Sum;
}
