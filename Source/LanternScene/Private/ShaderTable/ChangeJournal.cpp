// FChangeJournal: entries in the order of changes, and the newest one of each item.
#include "LanternScene/ShaderTable/ChangeJournal.h"

#include <algorithm>

namespace Lantern
{

void FChangeJournal::Add(uint32_t Item)
{
	if (Item >= NewestOf.size()) { NewestOf.resize(size_t(Item) + 1, 0); }
	constexpr size_t Least = 64; // entries that are not worth a walk
	if (Entries.size() >= 2 * NewestOf.size() + Least) { Compact(); }
	NewestOf[Item] = ++Newest;
	Entries.push_back({Newest, Item});
}

/// Drops older changes of an item: whoever has not seen them has not seen the newest one either.
void FChangeJournal::Compact()
{
	std::erase_if(Entries, [this](const FEntry& Entry) { return !IsNewest(Entry); });
}

std::vector<uint32_t> FChangeJournal::Take(FChangeCursor& Cursor) const
{
	std::vector<uint32_t> Items;
	const auto First = std::upper_bound(
	    Entries.begin(), Entries.end(), Cursor, [](FChangeCursor Seen, const FEntry& Entry) { return Seen < Entry.Number; });
	for (auto Entry = First; Entry != Entries.end(); ++Entry)
	{
		if (IsNewest(*Entry)) { Items.push_back(Entry->Item); }
	}
	Cursor = Newest;
	return Items;
}

} // namespace Lantern
