// Handles name one value for ever: slots are used again, handles are not.
#include "SlotTable.h"

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

enum class EHandle : uint64_t
{
	None = 0
};
using FTable = TSlotTable<int, EHandle>;

TEST(SlotTable, ASlotRestsOnceItsUsesAreCountedOut)
{
	FTable Table(1);
	const EHandle First = Table.Add(1);
	Table.Remove(First);
	for (uint32_t Use = 1; Use < FTable::MaxGeneration; ++Use) { Table.Remove(Table.Add(2)); }
	const EHandle Last = Table.Add(3);
	EXPECT_EQ(FTable::GetSlot(Last), 0u);
	Table.Remove(Last);
	const EHandle Next = Table.Add(4);
	EXPECT_EQ(FTable::GetSlot(Next), 1u) << "a further use of slot 0 would have an old handle";
	EXPECT_EQ(Table.Find(First), nullptr);
	EXPECT_EQ(Table.Find(Last), nullptr);
	EXPECT_EQ(*Table.Find(Next), 4);
}

TEST(SlotTable, TablesDoNotFindEachOthersHandles)
{
	FTable One(1), Other(FTable::MaxTag);
	const EHandle Handle = One.Add(1);
	EXPECT_NE(Handle, Other.Add(2));
	EXPECT_EQ(Other.Find(Handle), nullptr);
	EXPECT_EQ(*One.Find(Handle), 1);
	EXPECT_EQ(One.Find(EHandle::None), nullptr);
}

} // namespace
} // namespace Lantern
