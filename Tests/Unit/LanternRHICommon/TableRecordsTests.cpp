// FTableRecords: what is written, which runs are dirty, and what reaches a copy of the table.
#include "LanternRHICommon/TableRecords.h"

#include <cstring>
#include <thread>

#include <gtest/gtest.h>

namespace Lantern
{

static bool operator==(const FTableRecords::FRun& A, const FTableRecords::FRun& B) { return A.First == B.First && A.Count == B.Count; }
static std::ostream& operator<<(std::ostream& Out, const FTableRecords::FRun& Run) { return Out << Run.First << "+" << Run.Count; }

namespace
{

constexpr uint32_t HandleSize = 8, DataBytes = 4, Stride = 16;
using FRuns = std::vector<FTableRecords::FRun>;

/// Handles 0 … 3, each filled with its number.
std::vector<uint8_t> MakeHandles()
{
	std::vector<uint8_t> Handles(4 * HandleSize);
	for (uint32_t i = 0; i < Handles.size(); ++i) { Handles[i] = static_cast<uint8_t>(i / HandleSize); }
	return Handles;
}

constexpr uint32_t SlotsOfGroups[] = {1, 2, 3};

class FTableRecordsTest : public testing::Test
{
protected:
	void Initialise(uint32_t Count, EHandleUpdates HandleUpdates = EHandleUpdates::WithRecords)
	{
		Records.Initialise(Stride, HandleSize, DataBytes, HandleUpdates);
		Records.Grow(Count);
	}
	void SetGroup(uint32_t First, uint32_t Count, uint32_t Group)
	{
		const std::vector<uint32_t> Groups(Count, Group);
		Records.SetHandles(First, Count, SlotsOfGroups, Groups.data());
	}
	FRuns TakeDirty()
	{
		FRuns Runs;
		Records.TakeDirty(Runs);
		return Runs;
	}
	FRuns TakeDirtyHandles()
	{
		FRuns Runs;
		Records.TakeDirtyHandles(Runs);
		return Runs;
	}
	/// The bytes of one record, and that they are Slot's handle, Data and zeros.
	testing::AssertionResult IsRecord(uint32_t Index, uint32_t Slot, uint32_t Data) const
	{
		uint8_t Bytes[Stride], Wanted[Stride] = {};
		std::memset(Bytes, 0xEE, Stride);
		Records.CopyTo(Bytes, {Index, 1}, Handles.data());
		std::memset(Wanted, static_cast<int>(Slot), HandleSize);
		std::memcpy(Wanted + HandleSize, &Data, DataBytes);
		return std::memcmp(Bytes, Wanted, Stride) == 0 ? testing::AssertionSuccess() : testing::AssertionFailure() << "record " << Index;
	}

	const std::vector<uint8_t> Handles = MakeHandles();
	FTableRecords Records;
};

TEST_F(FTableRecordsTest, NewRecordsAreZerosAndClean)
{
	Initialise(3);
	EXPECT_FALSE(Records.IsDirty());
	EXPECT_TRUE(TakeDirty().empty());
	EXPECT_TRUE(IsRecord(2, 0, 0));
}

TEST_F(FTableRecordsTest, SetWritesHandlesAndData)
{
	Initialise(8);
	const uint32_t Groups[] = {0, 2}, Data[] = {7, 9};
	Records.Set(3, 2, SlotsOfGroups, Groups, Data);
	EXPECT_TRUE(IsRecord(3, 1, 7));
	EXPECT_TRUE(IsRecord(4, 3, 9));
	EXPECT_EQ(TakeDirty(), (FRuns{{3, 2}}));
	EXPECT_FALSE(Records.IsDirty());
	Records.Set(3, 1, SlotsOfGroups, Groups, nullptr);
	EXPECT_TRUE(IsRecord(3, 1, 0)) << "no data: zeros";
}

TEST_F(FTableRecordsTest, SetOneFillsUpWithZeros)
{
	Initialise(2);
	const uint32_t All = 0xFFFFFFFF;
	Records.SetOne(1, 2, &All, 4);
	EXPECT_TRUE(IsRecord(1, 2, All));
	Records.SetOne(1, 2, &All, 2);
	EXPECT_TRUE(IsRecord(1, 2, 0x0000FFFF));
	Records.SetOne(1, 2, nullptr, 4);
	EXPECT_TRUE(IsRecord(1, 2, 0));
}

TEST_F(FTableRecordsTest, DirtyRunsAcrossWordsAndPages)
{
	Initialise(3000);
	// 60 … 69 crosses a word of bits, 1020 … 1029 a page.
	for (const FTableRecords::FRun Run : FRuns{{60, 10}, {1020, 10}, {2999, 1}, {128, 64}, {62, 3}}) { Records.MarkDirty(Run); }
	EXPECT_EQ(TakeDirty(), (FRuns{{60, 10}, {128, 64}, {1020, 10}, {2999, 1}}));
	EXPECT_TRUE(TakeDirty().empty());
	Records.MarkDirty({0, 3000});
	EXPECT_EQ(TakeDirty(), (FRuns{{0, 3000}}));
	EXPECT_EQ(FTableRecords::CountRecords({{0, 3}, {7, 4}}), 7u);
}

TEST_F(FTableRecordsTest, HandlesAloneLeaveTheData)
{
	Initialise(4);
	const uint32_t Data = 5;
	Records.SetOne(1, 1, &Data, 4);
	TakeDirty();
	SetGroup(0, 3, 0);
	EXPECT_TRUE(IsRecord(1, 1, 5));
	EXPECT_EQ(TakeDirty(), (FRuns{{0, 1}, {2, 1}})) << "a record that has the handle stays clean";
	SetGroup(1, 1, 2);
	EXPECT_TRUE(IsRecord(1, 3, 5));
	EXPECT_EQ(TakeDirty(), (FRuns{{1, 1}}));
}

TEST_F(FTableRecordsTest, ManyHandlesTravelApartWhereAsked)
{
	Initialise(2500, EHandleUpdates::Apart);
	SetGroup(1100, 300, 1);
	EXPECT_TRUE(Records.IsDirty());
	EXPECT_TRUE(TakeDirty().empty());
	EXPECT_EQ(TakeDirtyHandles(), (FRuns{{1024, 1024}})) << "the whole page";
	EXPECT_FALSE(Records.IsDirty());
	SetGroup(1000, 1500, 2);
	EXPECT_EQ(TakeDirtyHandles(), (FRuns{{0, 2500}})) << "neighbouring pages are one run; the last page ends with the table";
	SetGroup(1000, 1500, 2);
	EXPECT_FALSE(Records.IsDirty()) << "nothing changed";
	SetGroup(7, 2, 1);
	EXPECT_EQ(TakeDirty(), (FRuns{{7, 2}})) << "few travel as whole records";
	EXPECT_TRUE(TakeDirtyHandles().empty());
}

TEST_F(FTableRecordsTest, ManyHandlesTravelWithRecordsWhereAsked)
{
	Initialise(2500, EHandleUpdates::WithRecords);
	SetGroup(1100, 300, 1);
	EXPECT_TRUE(TakeDirtyHandles().empty());
	EXPECT_EQ(TakeDirty(), (FRuns{{1100, 300}}));
}

TEST_F(FTableRecordsTest, CopiesRunsAcrossPages)
{
	Initialise(1100);
	for (uint32_t i = 1000; i < 1100; ++i) { Records.SetOne(i, 1 + i % 3, &i, 4); }
	std::vector<uint8_t> Bytes(100 * Stride);
	Records.CopyTo(Bytes.data(), {1000, 100}, Handles.data());
	std::vector<uint32_t> Slots(100);
	Records.CopySlotsTo(Slots.data(), {1000, 100});
	for (uint32_t i = 0; i < 100; ++i)
	{
		const uint8_t* Record = Bytes.data() + i * Stride;
		uint32_t Data = 0;
		std::memcpy(&Data, Record + HandleSize, 4);
		ASSERT_EQ(Record[0], 1 + (1000 + i) % 3);
		ASSERT_EQ(Data, 1000 + i);
		ASSERT_EQ(Slots[i], 1 + (1000 + i) % 3);
	}
}

TEST_F(FTableRecordsTest, CommonSizesAreComposedLikeAllOthers)
{
	// 32 + 32 bytes have a path of their own.
	FTableRecords Common;
	Common.Initialise(64, 32, 32, EHandleUpdates::WithRecords);
	Common.Grow(2);
	std::vector<uint8_t> BigHandles(2 * 32), Data(32), Bytes(64), Wanted(64, 0xAB);
	std::fill(BigHandles.begin() + 32, BigHandles.end(), uint8_t(0xAB));
	for (uint32_t i = 0; i < 32; ++i) { Wanted[32 + i] = Data[i] = static_cast<uint8_t>(i); }
	Common.SetOne(1, 1, Data.data(), 32);
	Common.CopyTo(Bytes.data(), {1, 1}, BigHandles.data());
	EXPECT_EQ(Bytes, Wanted);
}

TEST_F(FTableRecordsTest, GrowthKeepsRecordsAndMarks)
{
	Initialise(4);
	const uint32_t Data = 3;
	Records.SetOne(3, 2, &Data, 4);
	Records.Grow(5000);
	Records.Grow(10); // never shrinks
	EXPECT_EQ(Records.GetCount(), 5000u);
	EXPECT_TRUE(IsRecord(3, 2, 3));
	EXPECT_TRUE(IsRecord(4999, 0, 0));
	EXPECT_EQ(TakeDirty(), (FRuns{{3, 1}}));
}

TEST_F(FTableRecordsTest, RenumberingFollowsAPruning)
{
	Initialise(3);
	Records.SetOne(1, 3, nullptr, 0);
	TakeDirty();
	std::vector<bool> Used(4, false);
	Records.MarkUsed(Used);
	EXPECT_EQ(Used, (std::vector<bool>{true, false, false, true})) << "records never written name the null handle";
	Records.Renumber({0, 0, 0, 1});
	EXPECT_TRUE(IsRecord(1, 1, 0));
	EXPECT_FALSE(Records.IsDirty()) << "the bytes on the GPU are what they were";
}

TEST_F(FTableRecordsTest, ThreadsSetDifferentRecords)
{
	constexpr uint32_t Count = 20'000;
	Initialise(Count);
	std::vector<std::thread> Threads;
	for (uint32_t Thread = 0; Thread < 4; ++Thread)
	{
		Threads.emplace_back([&, Thread] {
			// Interleaved: neighbours share words of bits.
			for (uint32_t i = Thread; i < Count; i += 4) { Records.SetOne(i, 1 + i % 3, &i, 4); }
		});
	}
	for (std::thread& Thread : Threads) { Thread.join(); }
	EXPECT_EQ(TakeDirty(), (FRuns{{0, Count}}));
	for (uint32_t i = 0; i < Count; ++i) { ASSERT_TRUE(IsRecord(i, 1 + i % 3, i)); }
}

} // namespace
} // namespace Lantern
