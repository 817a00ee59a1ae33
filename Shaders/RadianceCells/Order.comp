// Lists the slots that a round updates: those that List.comp or ListAgain.comp has marked, in the order of the table.
#version 460
#define GROUP_SIZE THREAD_ORDER_GROUP_SIZE
#include "../Library/OrderBits.glsl"
#include "RadianceCellSlots.glsl"

uvec4 LoadBits(uint Index) { return FBitsRef(FRadianceGridRef(Push.Grid).Data.Marks).Data[Index]; }

// Of the first round, bits stand for slots. Those of further ones stand for entries of the list before.
void ListBit(uint Place, uint Bit)
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	if (Place >= Grid.Room) { return; }
	FRadianceWordRef List = FRadianceWordRef(Grid.List);
	List.Data[PlaceInList(Push.Round, Place)] = Push.Round == 0u ? Bit : List.Data[PlaceInList(Push.Round - 1u, Bit)] & ~LivelySlot;
}

void main()
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	uint Bits = Push.Round == 0u ? GetSlotCount(Grid) : RADIANCE_CELL_MOST_UPDATES;
	uint Group = GetThread() / GROUP_SIZE, Count = (Bits + THREAD_ORDER_BITS - 1u) / THREAD_ORDER_BITS;
	uint Sum = OrderBits(Count, Group);
	if (HasWholeCount(Count, Group)) { FRadianceCountersRef(Grid.Counters).Data.Listed[Push.Round] = Sum; }
}
