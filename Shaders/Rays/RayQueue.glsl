// Requests for shadow rays and their answers.
#ifndef LANTERN_RAY_QUEUE_GLSL
#define LANTERN_RAY_QUEUE_GLSL

#include "../Shared/RayQueueTypes.h"
#include "../Library/Bindings.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FRayRequestRef { FRayRequest Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FRayQueueCountersRef { FRayQueueCounters Data; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FAnswerRef { uint Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FWidthRef { float Data[]; };

FRayRequest MakeRayRequest(uint Kind, uint Slot, uint Index)
{
	return FRayRequest(Index | (Slot << RAY_INDEX_BITS) | (Kind << (RAY_INDEX_BITS + RAY_SLOT_BITS)));
}

// Reserves room for Count requests and returns the first one's place. What lies beyond Capacity has no room.
uint ReserveRequests(FAddress Address, uint Capacity, uint Count)
{
	FRayQueueCountersRef Counters = FRayQueueCountersRef(Address);
	uint First = atomicAdd(Counters.Data.Wanted, Count), End = min(First + Count, Capacity);
	const uint RowRays = RAY_QUEUE_GROUP_SIZE * RAY_QUEUE_ROW_GROUPS;
	atomicMax(Counters.Data.Groups[1], (End + RowRays - 1u) / RowRays);
	atomicMax(Counters.Data.Launch[0], End);
	return First;
}

// Fills what does not depend on how many requests there are. For one thread of the pass that makes them.
void StartRequests(FAddress Address)
{
	FRayQueueCountersRef Counters = FRayQueueCountersRef(Address);
	Counters.Data.Groups[0] = RAY_QUEUE_ROW_GROUPS;
	Counters.Data.Groups[2] = Counters.Data.Launch[1] = Counters.Data.Launch[2] = 1u;
}

uint RayKind(FRayRequest Request) { return Request.Packed >> (RAY_INDEX_BITS + RAY_SLOT_BITS); }
uint RayIndex(FRayRequest Request) { return Request.Packed & ((1u << RAY_INDEX_BITS) - 1u); }

uint PackSunAnswer(uint Seen, uint Unseen) { return (Seen << ANSWER_SUN_SEEN) | (Unseen << ANSWER_SUN_UNSEEN); }
uint SunSeen(uint Answer) { return (Answer >> ANSWER_SUN_SEEN) & ANSWER_SUN_MASK; }
uint SunUnseen(uint Answer) { return (Answer >> ANSWER_SUN_UNSEEN) & ANSWER_SUN_MASK; }

#endif
