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
uint RayKind(FRayRequest Request) { return Request.Packed >> (RAY_INDEX_BITS + RAY_SLOT_BITS); }
uint RaySlot(FRayRequest Request) { return (Request.Packed >> RAY_INDEX_BITS) & ((1u << RAY_SLOT_BITS) - 1u); }
uint RayIndex(FRayRequest Request) { return Request.Packed & ((1u << RAY_INDEX_BITS) - 1u); }

// Returns where the requests of a segment end. Those of the next one begin there.
uint SegmentEnd(FRayQueueCounters Counters, uint Segment, uint Capacity)
{
	uint End = 0u;
	for (uint I = 0u; I <= Segment; ++I)
	{
		FRaySegment Filled = Counters.Segments[I];
		End += Filled.Wanted <= Capacity - End ? Filled.Wanted : Filled.Kept;
	}
	return End;
}

// Returns how many of Count requests have room, if Wanted share Room equally. Rounded down, and a little more: all shares together fit.
uint ShareRoom(uint Count, uint Room, uint Wanted) { return uint(float(Count) * (float(Room) / float(Wanted)) * (1.0 - 1.0e-6)); }

// Makes launches reach to End, in threads.
void GrowLaunch(FAddress Address, uint End)
{
	FRayQueueCountersRef Counters = FRayQueueCountersRef(Address);
	const uint RowRays = RAY_QUEUE_GROUP_SIZE * RAY_QUEUE_ROW_GROUPS;
	atomicMax(Counters.Data.Groups[1], (End + RowRays - 1u) / RowRays);
	atomicMax(Counters.Data.Launch[0], End);
}

// Sample: of LOCAL_MORE_RAYS.
uint MoreSeenBit(uint Slot, uint Sample) { return 1u << (ANSWER_MORE_SEEN + Slot * LOCAL_MORE_RAYS + Sample); }

uint PackSunAnswer(uint Seen, uint Unseen) { return (Seen << ANSWER_SUN_SEEN) | (Unseen << ANSWER_SUN_UNSEEN); }
uint SunSeen(uint Answer) { return (Answer >> ANSWER_SUN_SEEN) & ANSWER_SUN_MASK; }
uint SunUnseen(uint Answer) { return (Answer >> ANSWER_SUN_UNSEEN) & ANSWER_SUN_MASK; }

#endif
