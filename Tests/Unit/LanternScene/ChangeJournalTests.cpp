// FChangeJournal against a plain model of several consumers.
#include "LanternScene/ShaderTable/ChangeJournal.h"

#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

using ::testing::ElementsAre;

TEST(ChangeJournalTest, EachConsumerGetsEachChangeOnce)
{
	FChangeJournal Journal;
	FChangeCursor A = 0, B = 0;
	EXPECT_FALSE(Journal.HasChangedSince(A));
	Journal.Add(3);
	Journal.Add(1);
	Journal.Add(3);
	EXPECT_THAT(Journal.Take(A), ElementsAre(1, 3)) << "once each, in the order of their newest changes";
	EXPECT_FALSE(Journal.HasChangedSince(A));
	EXPECT_THAT(Journal.Take(A), ElementsAre());
	Journal.Add(2);
	EXPECT_THAT(Journal.Take(B), ElementsAre(1, 3, 2)) << "what A took is still there for B";
	EXPECT_THAT(Journal.Take(A), ElementsAre(2));
}

TEST(ChangeJournalTest, MemoryIsBoundedByTheItems)
{
	FChangeJournal Journal;
	for (uint32_t Change = 0; Change < 100'000; ++Change) { Journal.Add(Change % 100); }
	EXPECT_LE(Journal.GetEntryCount(), 264u);
	FChangeCursor Late = 0;
	EXPECT_EQ(Journal.Take(Late).size(), 100u);
}

TEST(ChangeJournalTest, AnySequenceIsAsAModelSays)
{
	std::mt19937 Random(7);
	FChangeJournal Journal;
	constexpr size_t Consumers = 4;
	FChangeCursor Cursors[Consumers] = {};
	std::set<uint32_t> Unseen[Consumers];
	for (int Step = 0; Step < 50'000; ++Step)
	{
		if (Random() % 8 != 0)
		{
			const uint32_t Item = Random() % (1 + Step / 100);
			Journal.Add(Item);
			for (std::set<uint32_t>& Items : Unseen) { Items.insert(Item); }
			continue;
		}
		// The last one reads seldom.
		const size_t Consumer = Random() % 500 == 0 ? Consumers - 1 : Random() % (Consumers - 1);
		ASSERT_EQ(Journal.HasChangedSince(Cursors[Consumer]), !Unseen[Consumer].empty());
		const std::vector<uint32_t> Taken = Journal.Take(Cursors[Consumer]);
		ASSERT_EQ(std::set<uint32_t>(Taken.begin(), Taken.end()), Unseen[Consumer]) << "step " << Step;
		ASSERT_EQ(Taken.size(), Unseen[Consumer].size());
		Unseen[Consumer].clear();
	}
}

} // namespace
} // namespace Lantern
