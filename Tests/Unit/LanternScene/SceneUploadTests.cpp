// FUploader, FFrameUploads and TGpuTable on the mock device.
#include <numeric>
#include <random>
#include <set>

#include "Support/SceneTestTools.h"

namespace Lantern
{
namespace
{

class FUploadTest : public FSceneTest
{
protected:
	TRTRef<IRTCommandList> BeginList()
	{
		TRTRef<IRTCommandList> List;
		EXPECT_TRUE(Device->CreateCommandList("List", List.ReleaseAndGetAddress()));
		EXPECT_TRUE(List->Begin());
		return List;
	}
	FRTFence Submit(IRTCommandList& List)
	{
		EXPECT_TRUE(List.End());
		FRTFence Fence = 0;
		IRTCommandList* const Lists[] = {&List};
		EXPECT_TRUE(Device->Submit(Lists, 1, &Fence));
		return Fence;
	}
	FRTFence SubmitNothing() { return Submit(*BeginList()); }
	/// Flushes and submits; the bytes that went from the CPU to the table.
	template <class T>
	uint64_t Flush(TGpuTable<T>& Table)
	{
		const TRTRef<IRTCommandList> List = BeginList();
		Mock().ClearCalls();
		const uint64_t Address = Table.GetAddress();
		const FRTStatus Status = Table.Flush(*Device, *List, *Uploads);
		EXPECT_TRUE(Status) << Status.Message;
		const uint64_t Sent = Table.GetCopiedBytes();
		uint64_t Copied = 0;
		const auto Calls = Mock().FindCalls(ERTMockCall::CopyBuffer);
		for (const FRTMockCall& Call : Calls) { Copied += Call.Numbers[2]; }
		// A table that moves begins with the copy of what the device has.
		const bool bMoved = Address != 0 && Table.GetAddress() != Address;
		EXPECT_TRUE(Copied == Sent || (bMoved && Copied == Sent + Calls[0].Numbers[2])) << Copied << " for " << Sent;
		Uploads->EndFrame(Submit(*List));
		return Sent;
	}
	template <class T>
	void ExpectOnDevice(const TGpuTable<T>& Table)
	{
		if (Table.Num() == 0) { return; }
		IRTBuffer* const Buffer = Mock().FindBuffer(Table.GetAddress());
		ASSERT_TRUE(Buffer);
		ASSERT_GE(Buffer->GetDesc().Size, Table.Num() * sizeof(T));
		std::vector<T> Expected(Table.Num());
		Table.All().CopyTo(Expected.data(), 0, Expected.size());
		ASSERT_EQ(std::memcmp(Mock().GetBytes(Buffer), Expected.data(), Expected.size() * sizeof(T)), 0);
	}
};

// ---------------------------------------------------------------------------------------------------- TGpuTable

TEST_F(FUploadTest, TableCopiesNothingWhereNothingChanged)
{
	TGpuTable<uint32_t> Table("Table");
	EXPECT_EQ(Flush(Table), 0u);
	EXPECT_EQ(Table.GetAddress(), 0u) << "an empty table has no buffer";
	Table.Add(7);
	EXPECT_EQ(Flush(Table), 4u);
	EXPECT_FALSE(Table.IsDirty());
	EXPECT_EQ(Flush(Table), 0u);
	ExpectOnDevice(Table);
}

TEST_F(FUploadTest, TableCopiesDirtyChunksOnly)
{
	constexpr uint32_t Chunk = FGpuTableBase::ChunkEntries;
	TGpuTable<uint32_t> Table("Table");
	for (uint32_t I = 0; I < 10 * Chunk + 5; ++I) { Table.Add(I); }
	Flush(Table);
	Table.Set(0, 100);
	Table.Set(1, 101);
	EXPECT_EQ(Flush(Table), Chunk * 4);
	Table.Set(3 * Chunk, 1);
	Table.Set(5 * Chunk - 1, 2);
	EXPECT_EQ(Flush(Table), 2 * Chunk * 4);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CopyBuffer), 1u) << "neighbouring chunks are one copy";
	Table.Set(0, 3);
	Table.Set(10 * Chunk + 4, 4);
	EXPECT_EQ(Flush(Table), Chunk * 4 + 5 * 4) << "the last chunk ends with the table";
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CopyBuffer), 2u);
	ExpectOnDevice(Table);
}

TEST_F(FUploadTest, TableGrowsByDoublingAndTheDeviceCopiesWhatIsThere)
{
	TGpuTable<uint64_t> Table("Table");
	Table.Add(1);
	Flush(Table);
	const uint64_t Small = Mock().FindBuffer(Table.GetAddress())->GetDesc().Size;
	const uint64_t Address = Table.GetAddress();
	while (Table.Num() * sizeof(uint64_t) < Small) { Table.Add(Table.Num()); }
	Flush(Table);
	EXPECT_EQ(Table.GetAddress(), Address);
	Table.Add(5);
	EXPECT_EQ(Flush(Table), sizeof(uint64_t)) << "the new one alone comes from the CPU";
	EXPECT_NE(Table.GetAddress(), Address);
	EXPECT_EQ(Mock().FindBuffer(Table.GetAddress())->GetDesc().Size, 2 * Small);
	ExpectOnDevice(Table);
}

TEST_F(FUploadTest, TableThatGrewInAFrameThatWasLostIsSentWhole)
{
	TGpuTable<uint64_t> Table("Table");
	Table.Add(1);
	Flush(Table);
	const uint64_t Small = Mock().FindBuffer(Table.GetAddress())->GetDesc().Size;
	while (Table.Num() * sizeof(uint64_t) <= Small) { Table.Add(Table.Num()); }
	const TRTRef<IRTCommandList> List = BeginList();
	ASSERT_TRUE(Table.Flush(*Device, *List, *Uploads)); // never submitted
	(void)List->End();
	Table.Invalidate();
	EXPECT_EQ(Flush(Table), Table.Num() * sizeof(uint64_t));
	ExpectOnDevice(Table);
}

TEST_F(FUploadTest, TableSendsWhatItSkippedToo)
{
	TGpuTable<uint32_t> Table("Table");
	Table.Add(1);
	Flush(Table);
	Table.Set(100, 2);
	Flush(Table);
	ExpectOnDevice(Table);
}

TEST_F(FUploadTest, TableThatShrankForgetsItsEnd)
{
	TGpuTable<uint32_t> Table("Table");
	Table.Assign(std::vector<uint32_t>(1000, 1));
	Flush(Table);
	Table.Set(999, 2);
	Table.Assign({4, 5});
	EXPECT_EQ(Flush(Table), 8u);
	Table.Assign({});
	EXPECT_EQ(Flush(Table), 0u);
	EXPECT_FALSE(Table.IsDirty());
	Table.Add(6);
	EXPECT_EQ(Flush(Table), 4u);
	ExpectOnDevice(Table);
}

TEST_F(FUploadTest, TableThatWasEmptiedComesToRest)
{
	TGpuTable<uint32_t> Table("Table");
	Table.Add(1);
	Table.Truncate(0);
	EXPECT_EQ(Flush(Table), 0u);
	EXPECT_FALSE(Table.IsDirty()) << "else each frame would have an update to record";
	Table.Add(2);
	EXPECT_EQ(Flush(Table), 4u);
	ExpectOnDevice(Table);
}

TEST_F(FUploadTest, TableThatFailedToGrowTriesAgain)
{
	TGpuTable<uint32_t> Table("Growing");
	Table.Assign(std::vector<uint32_t>(5000, 3));
	Mock().FailAllocation(1);
	const TRTRef<IRTCommandList> List = BeginList();
	const FRTStatus Status = Table.Flush(*Device, *List, *Uploads);
	EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory);
	EXPECT_NE(std::string(Status.Message).find("Growing"), std::string::npos) << Status.Message;
	EXPECT_TRUE(Table.IsDirty());
	(void)List->End();
	Flush(Table);
	ExpectOnDevice(Table);
}

TEST_F(FUploadTest, TableEqualsItsCopyOverRandomSteps)
{
	struct FEntry
	{
		uint32_t Values[7];
	};
	TGpuTable<FEntry> Table("Table");
	std::set<uint32_t> Dirty;
	std::mt19937 Random(2);
	const auto MarkAll = [&] {
		Dirty.clear();
		for (uint32_t I = 0; I < Table.Num(); I += FGpuTableBase::ChunkEntries) { Dirty.insert(I / FGpuTableBase::ChunkEntries); }
	};
	for (int Step = 0; Step < 5000; ++Step)
	{
		const uint32_t Choice = Random() % 100;
		const FEntry Value{{static_cast<uint32_t>(Random())}};
		if (Choice < 60 && Table.Num() > 0)
		{
			const uint32_t Index = Random() % Table.Num();
			Table.Set(Index, Value);
			Dirty.insert(Index / FGpuTableBase::ChunkEntries);
		}
		else if (Choice < 98) { Dirty.insert(Table.Add(Value) / FGpuTableBase::ChunkEntries); }
		else if (Choice < 99)
		{
			Table.Assign(std::vector<FEntry>(Random() % 700, Value));
			MarkAll();
		}
		if (Random() % 8 != 0) { continue; }
		const uint64_t Copied = Flush(Table);
		uint64_t Expected = 0;
		for (const uint32_t Chunk : Dirty)
		{
			const uint32_t First = Chunk * FGpuTableBase::ChunkEntries;
			Expected += std::min(FGpuTableBase::ChunkEntries, Table.Num() - First) * sizeof(FEntry);
		}
		Dirty.clear();
		ASSERT_EQ(Copied, Expected) << "step " << Step;
		ASSERT_NO_FATAL_FAILURE(ExpectOnDevice(Table)) << "step " << Step;
	}
}

// ---------------------------------------------------------------------------------------------------- FFrameUploads

TEST_F(FUploadTest, SlicesDoNotOverlapAndAreAligned)
{
	std::mt19937 Random(3);
	std::vector<std::pair<uint64_t, uint64_t>> Slices;
	for (int I = 0; I < 300; ++I)
	{
		const uint64_t Size = 1 + Random() % (I % 50 == 0 ? 3'000'000 : 9000);
		FUploadSlice Slice;
		ASSERT_TRUE(Uploads->Allocate(Size, Slice));
		ASSERT_EQ(Slice.Address % 256, 0u);
		ASSERT_EQ(Slice.Address, Slice.Buffer->GetDeviceAddress() + Slice.Offset);
		ASSERT_EQ(Slice.Data, static_cast<uint8_t*>(Slice.Buffer->GetMapped()) + Slice.Offset);
		ASSERT_LE(Slice.Offset + Size, Slice.Buffer->GetDesc().Size);
		Slices.emplace_back(Slice.Address, Slice.Address + Size);
	}
	std::sort(Slices.begin(), Slices.end());
	for (size_t I = 1; I < Slices.size(); ++I) { EXPECT_LE(Slices[I - 1].second, Slices[I].first); }
}

TEST_F(FUploadTest, PagesAreUsedAgainOnlyAfterTheirFence)
{
	Mock().SetManualFences(true);
	std::set<uint64_t> InFlight;
	std::vector<std::pair<FRTFence, uint64_t>> Order;
	const auto OneFrame = [&] {
		FUploadSlice Slice;
		ASSERT_TRUE(Uploads->Allocate(100, Slice));
		EXPECT_FALSE(InFlight.count(Slice.Address)) << "memory that the GPU may still read was given out again";
		const FRTFence Fence = SubmitNothing();
		Uploads->EndFrame(Fence);
		InFlight.insert(Slice.Address);
		Order.emplace_back(Fence, Slice.Address);
	};
	for (int I = 0; I < 3; ++I) { OneFrame(); }
	EXPECT_EQ(InFlight.size(), 3u);
	Mock().CompleteUpTo(Order[0].first);
	InFlight.erase(Order[0].second);
	OneFrame();
	EXPECT_EQ(Order.back().second, Order[0].second) << "the finished page was not used again";
	for (const auto& [Fence, Address] : Order) { Mock().CompleteUpTo(Fence); }
	InFlight.clear();
	Mock().ClearCalls();
	for (int I = 0; I < 3; ++I) { OneFrame(); }
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateBuffer), 0u) << "a steady state allocates nothing";
	Mock().SetManualFences(false);
}

TEST_F(FUploadTest, CopyReadsWhatWasPushedEvenWhereTheCpuRunsAhead)
{
	Mock().SetManualFences(true);
	const TRTRef<IRTBuffer> Target = MakeBuffer("Target", 64 * 4);
	for (uint32_t Value = 0; Value < 64; ++Value)
	{
		const TRTRef<IRTCommandList> List = BeginList();
		FUploadSlice Slice;
		ASSERT_TRUE(Uploads->Push(&Value, sizeof(Value), Slice));
		List->CopyBuffer(Target.Get(), Value * 4, Slice.Buffer, Slice.Offset, 4);
		const FRTFence Fence = Submit(*List);
		Uploads->EndFrame(Fence);
		if (Fence > 2) { Mock().CompleteUpTo(Fence - 2); }
	}
	Mock().SetManualFences(false);
	for (uint32_t Value = 0; Value < 64; ++Value) { EXPECT_EQ(reinterpret_cast<uint32_t*>(Mock().GetBytes(Target.Get()))[Value], Value); }
}

// ---------------------------------------------------------------------------------------------------- FUploader

TEST_F(FUploadTest, UploaderFillsBuffersOfAnySize)
{
	FUploader Uploader(*Device);
	std::vector<std::pair<TRTRef<IRTBuffer>, std::vector<uint8_t>>> Buffers;
	for (const uint64_t Size : {1ull, 255ull, 257ull, 20ull << 20, 20ull << 20, 40ull << 20, 3ull})
	{
		std::vector<uint8_t> Bytes(Size);
		std::iota(Bytes.begin(), Bytes.end(), static_cast<uint8_t>(Buffers.size()));
		TRTRef<IRTBuffer> Buffer;
		ASSERT_TRUE(Uploader.CreateBuffer("Data", ERTBufferUsage::Storage, Bytes.data(), Size, Buffer));
		Buffers.emplace_back(std::move(Buffer), std::move(Bytes));
	}
	ASSERT_TRUE(Uploader.Flush());
	for (const auto& [Buffer, Bytes] : Buffers)
	{
		EXPECT_EQ(std::memcmp(Mock().GetBytes(Buffer.Get()), Bytes.data(), Bytes.size()), 0) << Bytes.size();
	}
}

TEST_F(FUploadTest, UploaderOutlivesALostDevice)
{
	for (const ERTMockCall Kind : {ERTMockCall::CreateBuffer, ERTMockCall::CreateCommandList, ERTMockCall::Begin, ERTMockCall::CopyBuffer,
	         ERTMockCall::End, ERTMockCall::Submit, ERTMockCall::WaitFor})
	{
		Open({});
		Mock().LoseDeviceAt(Kind);
		FUploader Uploader(*Device);
		TRTRef<IRTBuffer> Buffer;
		FRTStatus Status = Uploader.CreateBuffer("Data", ERTBufferUsage::Storage, "abcd", 4, Buffer);
		if (Status) { Status = Uploader.Flush(); }
		EXPECT_EQ(Status.Code, ERTResult::DeviceLost) << static_cast<int>(Kind);
		EXPECT_EQ(Uploader.CreateBuffer("More", ERTBufferUsage::Storage, "abcd", 4, Buffer).Code, ERTResult::DeviceLost);
	}
}

} // namespace
} // namespace Lantern
