// A journal of changes that any number of consumers read, each from its own place on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Lantern
{

/// A consumer's place in a journal: the changes that it has seen. 0: none.
using FChangeCursor = uint64_t;

/// Numbers that stand for items, such as sections, in the order in which the items changed last. Holds at most about twice as many
/// entries as there are items, whoever reads or does not. A consumer that has not read for long is given every item that has
/// changed since.
/// Threads: one at a time. Functions that only read may run on several.
class FChangeJournal
{
public:
	/// Takes amortised constant time.
	void Add(uint32_t Item);
	bool HasChangedSince(FChangeCursor Cursor) const { return Cursor < Newest; }
	/// Returns the items that changed since Cursor, each once, and moves Cursor behind them. Takes time in proportion to the changes.
	std::vector<uint32_t> Take(FChangeCursor& Cursor) const;
	/// Entries in memory.
	size_t GetEntryCount() const { return Entries.size(); }

private:
	struct FEntry
	{
		FChangeCursor Number; ///< of the change, which rises
		uint32_t Item;
	};
	void Compact();
	bool IsNewest(const FEntry& Entry) const { return NewestOf[Entry.Item] == Entry.Number; }

	FChangeCursor Newest = 0;
	std::vector<FEntry> Entries;         // by number
	std::vector<FChangeCursor> NewestOf; // by item; 0: has never changed
};

} // namespace Lantern
