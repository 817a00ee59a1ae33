// FShaderTableRecords: all kinds of records together, swaps of the pipeline, and growth.
#include "LanternRHICommon/ShaderTableRecords.h"

#include <cstring>

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

constexpr uint32_t HandleSize = 32;
constexpr uint32_t Hit = static_cast<uint32_t>(ERTRecordKind::Hit);

/// A handle begins with the pipeline and the group.
struct FHandle
{
	uint32_t Pipeline = 0, Group = 0;
	friend bool operator==(const FHandle&, const FHandle&) = default;
};

std::vector<uint8_t> MakeHandles(uint32_t Pipeline, uint32_t Count)
{
	std::vector<uint8_t> Bytes(Count * HandleSize);
	for (uint32_t Group = 0; Group < Count; ++Group)
	{
		const FHandle Handle = {Pipeline, Group};
		std::memcpy(Bytes.data() + Group * HandleSize, &Handle, sizeof(Handle));
	}
	return Bytes;
}

class FShaderTableRecordsTest : public testing::Test
{
protected:
	void SetUp() override
	{
		FRTCapabilities Capabilities;
		Capabilities.ShaderGroupHandleSize = HandleSize;
		Capabilities.ShaderGroupHandleAlignment = 32;
		Capabilities.ShaderGroupBaseAlignment = 64;
		Capabilities.MaxShaderGroupStride = 4096;
		FRTShaderTableDesc Desc;
		SetRecordCounts(Desc, {1, 2, 5, 1});
		Desc.RecordDataBytes = 4;
		Records.Initialise(Capabilities, Desc, EHandleUpdates::WithRecords);
		SetPipeline(1, 6);
	}
	void SetPipeline(uint32_t Pipeline, uint32_t Groups) { Records.SetPipeline(MakeHandles(Pipeline, Groups).data(), Groups); }
	FHandle GetHandle(uint32_t Kind, uint32_t Index, uint32_t* OutData = nullptr) const
	{
		std::vector<uint8_t> Bytes(Records.GetLayout().Strides[Kind]);
		Records.CopyTo(Bytes.data(), Kind, {Index, 1});
		FHandle Handle;
		std::memcpy(&Handle, Bytes.data(), sizeof(Handle));
		if (OutData) { std::memcpy(OutData, Bytes.data() + HandleSize, sizeof(*OutData)); }
		return Handle;
	}
	uint64_t TakeDirtyCount(uint32_t Kind)
	{
		std::vector<FTableRecords::FRun> Runs;
		Records[Kind].TakeDirty(Runs);
		return FTableRecords::CountRecords(Runs);
	}

	FShaderTableRecords Records;
};

TEST_F(FShaderTableRecordsTest, StartsCleanWithNullRecords)
{
	EXPECT_FALSE(Records.IsDirty());
	EXPECT_EQ(GetHandle(Hit, 4), FHandle());
	EXPECT_EQ(Records.GetLayout().Counts, (FRecordCounts{1, 2, 5, 1}));
	EXPECT_EQ(Records[Hit].GetStride(), 64u);
	EXPECT_EQ(Records[1].GetStride(), 32u) << "only hit records have data";
}

TEST_F(FShaderTableRecordsTest, EachCallReachesItsKind)
{
	const uint32_t Groups[] = {3, 4}, Data[] = {10, 11}, Miss = 1;
	Records.SetRecord(ERTRecordKind::RayGen, 0, 0, nullptr, 0);
	Records.SetHitRecords(2, 2, Groups, Data);
	Records.SetGroups(ERTRecordKind::Miss, 1, 1, &Miss);
	uint32_t Value = 0;
	EXPECT_EQ(GetHandle(Hit, 3, &Value), (FHandle{1, 4}));
	EXPECT_EQ(Value, 11u);
	EXPECT_EQ(GetHandle(1, 1), (FHandle{1, 1}));
	EXPECT_EQ(GetHandle(0, 0), (FHandle{1, 0}));
	EXPECT_TRUE(Records.IsDirty());
	EXPECT_EQ(TakeDirtyCount(0), 1u);
	EXPECT_EQ(TakeDirtyCount(1), 1u);
	EXPECT_EQ(TakeDirtyCount(Hit), 2u);
	EXPECT_EQ(TakeDirtyCount(3), 0u);
	EXPECT_FALSE(Records.IsDirty());
}

TEST_F(FShaderTableRecordsTest, SwapKeepsHandlesUntilTheyAreSet)
{
	const uint32_t Groups[] = {2, 3}, Data[] = {10, 11};
	Records.SetHitRecords(0, 2, Groups, Data);
	TakeDirtyCount(Hit);
	SetPipeline(2, 6);
	EXPECT_FALSE(Records.IsDirty()) << "a swap alone changes no record";
	Records.SetGroups(ERTRecordKind::Hit, 1, 1, Groups);
	uint32_t Value = 0;
	EXPECT_EQ(GetHandle(Hit, 0), (FHandle{1, 2}));
	EXPECT_EQ(GetHandle(Hit, 1, &Value), (FHandle{2, 2}));
	EXPECT_EQ(Value, 11u) << "the data stays";
	EXPECT_EQ(TakeDirtyCount(Hit), 1u);
}

TEST_F(FShaderTableRecordsTest, GrowthArrangesTheTableAnew)
{
	const uint32_t Value = 9;
	Records.SetRecord(ERTRecordKind::Hit, 4, 2, &Value, 4);
	const uint64_t Size = Records.GetLayout().Size;
	Records.Grow({1, 3, 2000, 1});
	EXPECT_EQ(Records.GetLayout().Counts, (FRecordCounts{1, 3, 2000, 1}));
	EXPECT_GE(Records.GetLayout().Size, Size + 1995 * 64);
	EXPECT_EQ(GetHandle(Hit, 4), (FHandle{1, 2}));
	EXPECT_EQ(GetHandle(Hit, 1999), FHandle());
	EXPECT_EQ(TakeDirtyCount(Hit), 1u);
	Records.MarkAllDirty();
	EXPECT_EQ(TakeDirtyCount(Hit), 2000u);
	EXPECT_EQ(TakeDirtyCount(1), 3u);
}

// Pipelines come and go; the handles of those that are gone must not gather for ever.
TEST_F(FShaderTableRecordsTest, HandlesOfFormerPipelinesArePruned)
{
	const uint32_t Group = 5;
	Records.SetGroups(ERTRecordKind::Hit, 0, 1, &Group);
	for (uint32_t Pipeline = 2; Pipeline < 100; ++Pipeline)
	{
		SetPipeline(Pipeline, 100);
		Records.SetGroups(ERTRecordKind::Hit, 1, 1, &Group);
		ASSERT_LE(Records.GetHandles().GetCount(), 4096u);
		ASSERT_EQ(GetHandle(Hit, 0), (FHandle{1, 5})) << "still named by a record";
		ASSERT_EQ(GetHandle(Hit, 1), (FHandle{Pipeline, 5}));
		ASSERT_EQ(GetHandle(Hit, 2), FHandle());
	}
}

} // namespace
} // namespace Lantern
