#include "LanternScene/SectionTable.h"

#include <cassert>
#include <iterator>
#include <utility>

namespace Lantern
{

void FSectionTable::Release(const FRTGeometry* Geometry, const std::vector<uint32_t>& Materials)
{
	const auto Found = Ranges.find(FKey{Geometry, Materials});
	assert(Found != Ranges.end());
	if (--Found->second.References > 0) { return; }
	Free(Found->second.First, Found->second.Count);
	Ranges.erase(Found);
}

uint32_t FSectionTable::Allocate(uint32_t Count)
{
	for (auto It = FreeRanges.begin(); It != FreeRanges.end(); ++It)
	{
		const auto [First, Size] = *It;
		if (Size < Count) { continue; }
		FreeRanges.erase(It);
		if (Size > Count) { FreeRanges.emplace(First + Count, Size - Count); }
		return First;
	}
	return Table.Num();
}

void FSectionTable::Free(uint32_t First, uint32_t Count)
{
	auto Next = FreeRanges.lower_bound(First);
	if (Next != FreeRanges.begin())
	{
		const auto Previous = std::prev(Next);
		if (Previous->first + Previous->second == First)
		{
			First = Previous->first;
			Count += Previous->second;
			FreeRanges.erase(Previous);
		}
	}
	if (Next != FreeRanges.end() && First + Count == Next->first)
	{
		Count += Next->second;
		FreeRanges.erase(Next);
	}
	FreeRanges.emplace(First, Count);
}

void FSectionTable::Write(uint32_t Section, const FSectionData& Data)
{
	Table.Set(Section, Data);
	IsChanged.resize(Table.Num(), false);
	if (!IsChanged[Section]) { Changed.push_back(Section); }
	IsChanged[Section] = true;
}

std::vector<uint32_t> FSectionTable::TakeChanged()
{
	IsChanged.assign(IsChanged.size(), false);
	return std::exchange(Changed, {});
}

} // namespace Lantern
