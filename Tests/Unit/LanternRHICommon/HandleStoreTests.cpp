// FHandleStore: numbers of handles, across pipelines and prunings.
#include "LanternRHICommon/HandleStore.h"

#include <cstring>

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

constexpr uint32_t HandleSize = 8;

/// Handles of groups First … First + Count − 1 of a pipeline.
std::vector<uint8_t> MakeHandles(uint32_t Pipeline, uint32_t First, uint32_t Count)
{
	std::vector<uint8_t> Bytes(Count * HandleSize);
	for (uint32_t i = 0; i < Count; ++i)
	{
		const uint32_t Words[2] = {Pipeline, First + i};
		std::memcpy(Bytes.data() + i * HandleSize, Words, HandleSize);
	}
	return Bytes;
}

class FHandleStoreTest : public testing::Test
{
protected:
	void SetUp() override { Store.Initialise(HandleSize); }
	bool IsHandle(uint32_t Slot, uint32_t Pipeline, uint32_t Group) const
	{
		const std::vector<uint8_t> Wanted = MakeHandles(Pipeline, Group, 1);
		return std::memcmp(Store.GetHandles() + Slot * HandleSize, Wanted.data(), HandleSize) == 0;
	}

	FHandleStore Store;
};

TEST_F(FHandleStoreTest, NullIsAHandleOfZeros)
{
	EXPECT_EQ(Store.GetCount(), 1u);
	EXPECT_EQ(Store.GetSizeBytes(), HandleSize);
	EXPECT_TRUE(IsHandle(FHandleStore::Null, 0, 0));
}

TEST_F(FHandleStoreTest, EachDistinctHandleIsStoredOnce)
{
	std::vector<uint8_t> Handles = MakeHandles(1, 0, 2);
	const std::vector<uint8_t> Again = MakeHandles(1, 0, 1);
	Handles.insert(Handles.end(), Again.begin(), Again.end());
	Store.SetPipeline(Handles.data(), 3);
	EXPECT_EQ(Store.GetGroupCount(), 3u);
	EXPECT_EQ(Store.GetCount(), 3u) << "the null handle and two";
	EXPECT_EQ(Store.GetSlotsOfGroups()[0], Store.GetSlotsOfGroups()[2]);
	EXPECT_NE(Store.GetSlotsOfGroups()[0], Store.GetSlotsOfGroups()[1]);
	EXPECT_TRUE(IsHandle(Store.GetSlotsOfGroups()[1], 1, 1));
}

TEST_F(FHandleStoreTest, NumbersOutliveTheirPipeline)
{
	Store.SetPipeline(MakeHandles(1, 0, 2).data(), 2);
	const uint32_t Old = Store.GetSlotsOfGroups()[1];
	Store.SetPipeline(MakeHandles(2, 0, 1).data(), 1);
	EXPECT_EQ(Store.GetGroupCount(), 1u);
	EXPECT_TRUE(IsHandle(Old, 1, 1));
	EXPECT_TRUE(IsHandle(Store.GetSlotsOfGroups()[0], 2, 0));
}

TEST_F(FHandleStoreTest, PruneKeepsWhatIsUsedAndThePipelines)
{
	Store.SetPipeline(MakeHandles(1, 0, 3).data(), 3);
	const uint32_t Kept = Store.GetSlotsOfGroups()[2];
	Store.SetPipeline(MakeHandles(2, 0, 2).data(), 2);
	std::vector<bool> Used(Store.GetCount(), false);
	Used[Kept] = true;
	const std::vector<uint32_t> NewOf = Store.Prune(Used);
	EXPECT_EQ(Store.GetCount(), 4u) << "null, the used one, two of the pipeline";
	EXPECT_EQ(NewOf[FHandleStore::Null], FHandleStore::Null);
	EXPECT_TRUE(IsHandle(NewOf[Kept], 1, 2));
	EXPECT_TRUE(IsHandle(Store.GetSlotsOfGroups()[0], 2, 0));
	EXPECT_TRUE(IsHandle(Store.GetSlotsOfGroups()[1], 2, 1));
	// A handle that was dropped may come back.
	Store.SetPipeline(MakeHandles(1, 0, 1).data(), 1);
	EXPECT_EQ(Store.GetCount(), 5u);
	EXPECT_TRUE(IsHandle(Store.GetSlotsOfGroups()[0], 1, 0));
}

TEST_F(FHandleStoreTest, CrowdedOnlyAfterMoreThanItMustKeep)
{
	Store.SetPipeline(MakeHandles(1, 0, 4095).data(), 4095);
	EXPECT_FALSE(Store.IsCrowded()) << "4,096 with the null handle";
	Store.SetPipeline(MakeHandles(2, 0, 4095).data(), 4095);
	EXPECT_TRUE(Store.IsCrowded());
	Store.Prune(std::vector<bool>(Store.GetCount(), true));
	EXPECT_FALSE(Store.IsCrowded()) << "where all are used, pruning again would be in vain";
}

} // namespace
} // namespace Lantern
