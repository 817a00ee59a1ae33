// FHandleStore: the distinct handles of shader groups, by number.
#include "LanternRHICommon/HandleStore.h"

#include <algorithm>
#include <utility>

namespace Lantern
{

void FHandleStore::Initialise(uint32_t InHandleSize)
{
	HandleSize = InHandleSize;
	Bytes.assign(HandleSize, 0);
	Slots = {{std::string(HandleSize, '\0'), Null}};
}

uint32_t FHandleStore::FindOrAdd(const uint8_t* Handle)
{
	const auto [Found, bNew] = Slots.try_emplace(std::string(reinterpret_cast<const char*>(Handle), HandleSize), GetCount());
	if (bNew) { Bytes.insert(Bytes.end(), Handle, Handle + HandleSize); }
	return Found->second;
}

void FHandleStore::SetPipeline(const uint8_t* Handles, uint32_t GroupCount)
{
	SlotsOfGroups.resize(GroupCount);
	for (uint32_t Group = 0; Group < GroupCount; ++Group) { SlotsOfGroups[Group] = FindOrAdd(Handles + size_t(Group) * HandleSize); }
}

std::vector<uint32_t> FHandleStore::Prune(const std::vector<bool>& Used)
{
	std::vector<bool> Kept = Used;
	Kept[Null] = true;
	for (const uint32_t Slot : SlotsOfGroups) { Kept[Slot] = true; }
	const std::vector<uint8_t> Old = std::exchange(Bytes, {});
	Slots.clear();
	std::vector<uint32_t> NewOf(Kept.size(), Null);
	for (uint32_t Slot = 0; Slot < Kept.size(); ++Slot)
	{
		if (Kept[Slot]) { NewOf[Slot] = FindOrAdd(Old.data() + size_t(Slot) * HandleSize); }
	}
	for (uint32_t& Slot : SlotsOfGroups) { Slot = NewOf[Slot]; }
	MostBeforePruning = std::max(4096u, 2 * GetCount());
	return NewOf;
}

} // namespace Lantern
