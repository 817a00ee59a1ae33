// FIndexAllocator: indices of a bindless array.
#include "LanternRHICommon/IndexAllocator.h"

#include <cassert>

namespace Lantern
{

uint32_t FIndexAllocator::Allocate()
{
	if (!Freed.empty())
	{
		const uint32_t Index = Freed.back();
		Freed.pop_back();
		return Index;
	}
	return Used < Capacity ? Used++ : None;
}

void FIndexAllocator::Free(uint32_t Index)
{
	assert(Index < Used);
	Freed.push_back(Index);
}

} // namespace Lantern
