// FSectionAllocator: size classes, their lists, and runs that merge.
#include "LanternScene/ShaderTable/SectionAllocator.h"

#include <bit>
#include <cassert>

namespace Lantern
{

FSectionAllocator::FSectionAllocator() { Heads.fill(None); }

uint32_t FSectionAllocator::ClassOf(uint32_t Size)
{
	if (Size < ExactSizes) { return Size; }
	const uint32_t Power = static_cast<uint32_t>(std::bit_width(Size)) - 1;
	const uint32_t Step = static_cast<uint32_t>(std::bit_width(Subdivisions)) - 1;
	return ExactSizes + (Power - 6) * Subdivisions + ((Size >> (Power - Step)) & (Subdivisions - 1));
}

uint32_t FSectionAllocator::FindClass(uint32_t AtLeast) const
{
	for (uint32_t Word = AtLeast / WordBits; Word < Occupied.size(); ++Word)
	{
		uint64_t Bits = Occupied[Word];
		if (Word == AtLeast / WordBits) { Bits &= ~uint64_t(0) << (AtLeast % WordBits); }
		if (Bits != 0) { return Word * WordBits + static_cast<uint32_t>(std::countr_zero(Bits)); }
	}
	return None;
}

void FSectionAllocator::Insert(uint32_t First, uint32_t Size)
{
	const uint32_t Class = ClassOf(Size);
	Cells[First] = {Size, None, Heads[Class]};
	Cells[First + Size - 1].Size = Size;
	if (Heads[Class] != None) { Cells[Heads[Class]].Previous = First; }
	Heads[Class] = First;
	Occupied[Class / WordBits] |= uint64_t(1) << (Class % WordBits);
	FreeCount += Size;
}

void FSectionAllocator::Remove(uint32_t First)
{
	const FCell Cell = Cells[First];
	const uint32_t Class = ClassOf(Cell.Size);
	(Cell.Previous == None ? Heads[Class] : Cells[Cell.Previous].Next) = Cell.Next;
	if (Cell.Next != None) { Cells[Cell.Next].Previous = Cell.Previous; }
	if (Heads[Class] == None) { Occupied[Class / WordBits] &= ~(uint64_t(1) << (Class % WordBits)); }
	Cells[First + Cell.Size - 1].Size = 0;
	Cells[First] = {};
	FreeCount -= Cell.Size;
}

uint32_t FSectionAllocator::Grow(uint32_t Count)
{
	uint32_t First = GetCapacity();
	if (First > 0 && Cells.back().Size > 0)
	{
		First -= Cells.back().Size;
		Remove(First);
	}
	assert(GetCapacity() - First < Count);
	Cells.resize(First + Count);
	return First;
}

uint32_t FSectionAllocator::Allocate(uint32_t Count)
{
	assert(Count > 0);
	// Count's own class may have runs that are too short, so only its newest is tried. All runs of greater classes are long
	// enough. The last run of the array is used before the array grows.
	const uint32_t Own = Heads[ClassOf(Count)];
	uint32_t First = Own;
	if (Own == None || Cells[Own].Size < Count)
	{
		const uint32_t Class = FindClass(ClassOf(Count) + 1);
		const bool bLast = Class == None && !Cells.empty() && Cells.back().Size >= Count;
		First = bLast ? GetCapacity() - Cells.back().Size : Class == None ? None : Heads[Class];
	}
	if (First == None) { return Grow(Count); }
	const uint32_t Size = Cells[First].Size;
	Remove(First);
	if (Size > Count) { Insert(First + Count, Size - Count); }
	return First;
}

void FSectionAllocator::Free(uint32_t First, uint32_t Count)
{
	assert(Count > 0 && First + Count <= GetCapacity() && Cells[First].Size == 0);
	if (First > 0 && Cells[First - 1].Size > 0)
	{
		const uint32_t Size = Cells[First - 1].Size;
		First -= Size;
		Count += Size;
		Remove(First);
	}
	const uint32_t Behind = First + Count;
	if (Behind < GetCapacity() && Cells[Behind].Size > 0)
	{
		Count += Cells[Behind].Size;
		Remove(Behind);
	}
	Insert(First, Count);
}

} // namespace Lantern
